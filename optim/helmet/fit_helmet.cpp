#include "optim/helmet/fit_helmet.hpp"

#include <cmath>

#include "optim/solvers/arrow_solver.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// One tilt for all: x = (turn, place, theta, tilt), of the arrow problem's own residuals.
class UniformProblem final : public LeastSquaresProblem {
 public:
  UniformProblem(const RibsProblem& problem, const model::Fishbone& fishbone) : problem_(problem) {
    const auto sign = [&](const model::Crease& crease) {
      return turn_sense(fishbone.structure.hinges[crease.hinges[0]].wall);
    };
    for (const model::Crease& crease : fishbone.spine) signs_.push_back(sign(crease));
    for (const auto& sides : fishbone.ribs)
      for (const auto& side : sides)
        for (const model::Crease& crease : side) signs_.push_back(sign(crease));
    std::vector<ResidualBlock> blocks;
    for (const int count : problem.residuals()) residuals_ += count;
    lower_ = problem.lower().head(fixed + 1);
    upper_ = problem.upper().head(fixed + 1);
    lower_[fixed] = 0;
  }

  int variables() const override { return fixed + 1; }
  int residuals() const override { return residuals_; }
  const VectorXd& lower() const override { return lower_; }
  const VectorXd& upper() const override { return upper_; }

  VectorXd expand(const VectorXd& x) const {
    VectorXd all(fixed + static_cast<Eigen::Index>(signs_.size()));
    all.head(fixed) = x.head(fixed);
    for (std::size_t k = 0; k < signs_.size(); ++k)
      all[fixed + static_cast<Eigen::Index>(k)] = signs_[k] * x[fixed];
    return all;
  }

  bool evaluate(const VectorXd& x, VectorXd& r, Eigen::MatrixXd* J) const override {
    std::vector<ResidualBlock> blocks;
    if (!problem_.evaluate(expand(x), true, blocks)) return false;
    const StackedResiduals all = stacked(problem_, blocks);
    r = all.r;
    if (!J) return true;
    J->resize(residuals_, fixed + 1);
    J->leftCols(fixed) = all.J.leftCols(fixed);
    J->col(fixed).setZero();
    for (std::size_t k = 0; k < signs_.size(); ++k)
      J->col(fixed) += signs_[k] * all.J.col(fixed + static_cast<Eigen::Index>(k));
    return true;
  }

 private:
  static constexpr int fixed = 7;  // variables before the tilts: turn (3), place (3), theta

  const RibsProblem& problem_;
  std::vector<int> signs_;
  int residuals_ = 0;
  VectorXd lower_, upper_;
};

double mean_size(const RibsShape& shape) {
  double sum = 0;
  std::size_t count = 0;
  const auto add = [&](const std::vector<double>& tilts) {
    for (const double tilt : tilts) sum += std::abs(tilt);
    count += tilts.size();
  };
  add(shape.spine);
  for (const auto& sides : shape.ribs)
    for (const auto& side : sides) add(side);
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

RibsDesign fit_helmet(const targets::MeshDistance& head, const Vector3d& crown, const HelmetSpec& spec,
                      const SolverOptions& options) {
  return fit_layout(plan_helmet(head, crown, spec), head, crown, spec, options);
}

UniformHelmet fit_uniform_helmet(const RibsDesign& design, const targets::MeshDistance& head,
                                 const Vector3d& crown, const HelmetSpec& spec,
                                 const SolverOptions& options) {
  const model::Fishbone& fishbone = design.fishbone;
  const RibsProblem problem(fishbone, ribs_goal(design.layout, head, crown, spec), spec.tilt, spec.theta);
  const UniformProblem uniform(problem, fishbone);
  VectorXd x(uniform.variables());
  x << design.search.x.head(7), mean_size(problem.unpack(design.search.x));
  UniformHelmet out;
  const auto error = [&](const VectorXd& at) {
    return ribs_error(fishbone, problem.state(uniform.expand(at)), head, spec.clearance_mm);
  };
  out.before = error(x);
  const SolveResult found = solve(uniform, x, options);
  out.after = error(found.x);
  out.theta = found.x[6];
  out.tilt = found.x[7];
  return out;
}

}  // namespace kinetix::optim
