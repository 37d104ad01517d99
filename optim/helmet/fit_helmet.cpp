#include "optim/helmet/fit_helmet.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/rotation_vector.hpp"
#include "optim/helmet/helmet_collisions.hpp"
#include "optim/solvers/arrow_solver.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int most_trims = 30;  // fits with shortened ribs: whatever collides after so many is reported
/// Parts of the limit of tilts that are tried in turn where walls meet with the whole of it.
constexpr double tilt_parts[] = {0.6, 0.4, 0.25};
// Steps of Newton's method towards the curve, each of which about squares the error.
constexpr int steps_in_plane = 6;

HelmetGoal goal_of(const HelmetLayout& layout, const targets::MeshDistance& head, const Vector3d& crown,
                   const HelmetSpec& spec) {
  return {&head, spec.clearance_mm, layout.rim_z, crown.x()};
}

/// Distance of p from the curve at the clearance in the plane through p normal to `along`.
double distance_in_plane(const targets::MeshDistance& head, const Vector3d& p, const Vector3d& along,
                         double clearance) {
  Vector3d q = p;
  for (int k = 0; k < steps_in_plane; ++k) {
    const targets::ClosestMeshPoint closest = head.closest(q);
    const Vector3d slope = closest.normal - along.dot(closest.normal) * along;
    if (!(slope.squaredNorm() > 1e-4)) break;
    q -= (closest.distance - clearance) / slope.squaredNorm() * slope;
  }
  return (q - p).norm();
}

/// Bodies of a rib's columns, row by row, from -x to +x; the spine's two columns among them.
std::vector<std::array<int, 2>> columns_of(const model::Fishbone& fishbone, const model::FishboneRib& rib) {
  std::vector<std::array<int, 2>> columns;
  const int spine = fishbone.spine_column;
  for (int i = spine - rib.cells[0]; i <= spine + 1 + rib.cells[1]; ++i)
    columns.push_back(
        {*fishbone.structure.body_at({i, rib.row}), *fishbone.structure.body_at({i, rib.row + 1})});
  return columns;
}

double rib_error(const model::Fishbone& fishbone, const model::FishboneRib& rib, const model::State& state,
                 const targets::MeshDistance& head, double clearance) {
  const auto columns = columns_of(fishbone, rib);
  double sum = 0;
  for (const auto& [lower, upper] : columns) {
    const Vector3d &a = state[lower].p, &b = state[upper].p;
    sum += std::pow(distance_in_plane(head, (a + b) / 2, (b - a).normalized(), clearance), 2);
  }
  return std::sqrt(sum / static_cast<double>(columns.size()));
}

/// The shape on a fishbone whose ribs have been cut shorter.
HelmetShape cut_to(HelmetShape shape, const model::FishboneLayout& spine_and_ribs) {
  for (std::size_t r = 0; r < spine_and_ribs.ribs.size(); ++r)
    for (const int side : {0, 1}) shape.ribs[r][side].resize(spine_and_ribs.ribs[r].cells[side]);
  return shape;
}

HelmetDesign fit_with_limit(const targets::MeshDistance& head, const Vector3d& crown, const HelmetSpec& spec,
                            const SolverOptions& options, HelmetLayout layout, double tilt) {
  HelmetShape shape = layout.start;
  for (int trims = 0, trimmed = 0;; ++trims) {
    model::Fishbone fishbone = make_fishbone(layout.spine_and_ribs, spec.size);
    const HelmetProblem problem(fishbone, goal_of(layout, head, crown, spec), tilt, spec.theta);
    SolveResult search = solve(problem, problem.pack(shape), options);
    shape = problem.unpack(search.x);
    model::State state = problem.state(search.x);
    fishbone.structure = problem.structure(search.x);
    const HelmetCollisions collisions(fishbone, shape.theta);
    const int taken = trims < most_trims ? collisions.trim(layout.spine_and_ribs) : 0;
    trimmed += taken;
    if (taken == 0) {
      HelmetError error = helmet_error(fishbone, state, head, spec.clearance_mm);
      return {std::move(layout),
              std::move(fishbone),
              std::move(shape),
              std::move(state),
              std::move(error),
              std::move(search),
              tilt,
              trimmed,
              collisions.in_words()};
    }
    shape = cut_to(std::move(shape), layout.spine_and_ribs);
  }
}

/// One tilt for all: x = (turn, place, theta, tilt), of the arrow problem's own residuals.
class UniformProblem final : public LeastSquaresProblem {
 public:
  UniformProblem(const HelmetProblem& problem, const model::Fishbone& fishbone) : problem_(problem) {
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

  const HelmetProblem& problem_;
  std::vector<int> signs_;
  int residuals_ = 0;
  VectorXd lower_, upper_;
};

double mean_size(const HelmetShape& shape) {
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

HelmetError helmet_error(const model::Fishbone& fishbone, const model::State& state,
                         const targets::MeshDistance& head, double clearance_mm) {
  HelmetError error;
  double sum = 0;
  for (const model::Pose& pose : state) {
    const double apart = head.closest(pose.p).distance - clearance_mm;
    error.of_body.push_back(apart);
    sum += apart * apart;
    if (!(std::abs(apart) <= error.max)) error.max = std::abs(apart);
  }
  error.rms = std::sqrt(sum / static_cast<double>(state.size()));
  for (const model::FishboneRib& rib : fishbone.layout.ribs)
    error.of_ribs.push_back(rib_error(fishbone, rib, state, head, clearance_mm));
  return error;
}

model::State placed_fishbone(const model::Fishbone& fishbone, const HelmetShape& shape, double theta) {
  const model::Structure& structure = fishbone.structure;
  return placed(fold_net(make_net_tree(structure, fishbone.middle), structure, theta), fishbone.middle,
                shape.turn, shape.place);
}

HelmetDesign fit_helmet(const targets::MeshDistance& head, const Vector3d& crown, const HelmetSpec& spec,
                        const SolverOptions& options) {
  return fit_layout(plan_helmet(head, crown, spec), head, crown, spec, options);
}

HelmetDesign fit_layout(const HelmetLayout& layout, const targets::MeshDistance& head, const Vector3d& crown,
                        const HelmetSpec& spec, const SolverOptions& options) {
  HelmetDesign first = fit_with_limit(head, crown, spec, options, layout, spec.tilt);
  if (first.collisions.empty()) return first;
  for (const double part : tilt_parts) {
    HelmetDesign gentler = fit_with_limit(head, crown, spec, options, layout, part * spec.tilt);
    if (gentler.collisions.empty()) return gentler;
  }
  return first;
}

UniformHelmet fit_uniform_helmet(const HelmetDesign& design, const targets::MeshDistance& head,
                                 const Vector3d& crown, const HelmetSpec& spec,
                                 const SolverOptions& options) {
  const model::Fishbone& fishbone = design.fishbone;
  const HelmetProblem problem(fishbone, goal_of(design.layout, head, crown, spec), spec.tilt, spec.theta);
  const UniformProblem uniform(problem, fishbone);
  VectorXd x(uniform.variables());
  x << design.search.x.head(7), mean_size(problem.unpack(design.search.x));
  UniformHelmet out;
  const auto error = [&](const VectorXd& at) {
    return helmet_error(fishbone, problem.state(uniform.expand(at)), head, spec.clearance_mm);
  };
  out.before = error(x);
  const SolveResult found = solve(uniform, x, options);
  out.after = error(found.x);
  out.theta = found.x[6];
  out.tilt = found.x[7];
  return out;
}

}  // namespace kinetix::optim
