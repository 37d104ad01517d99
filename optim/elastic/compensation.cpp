#include "optim/elastic/compensation.hpp"

#include "model/base/decompositions.hpp"
#include "model/elastic/path/near_equilibrium.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::optim {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Over the largest diagonal entry of the normal equations: the first step is nearly a Gauss-Newton step.
constexpr double first_damping = 1e-4, min_damping = 1e-12, max_damping = 1e6;
constexpr double easier = 0.1,
                 harder = 10;            // factors of the damping after a step that helps, or does not
constexpr double longest_change = 0.08;  // rad, of any variable: derivatives are inaccurate further away
constexpr double min_gain = 0.02;        // fraction of the rms: a step that gains less ends the search

/// Tilts of all ties, then theta. rad
class Variables {
 public:
  Variables(const model::Lattice& sheet, const CompensationOptions& options)
      : sheet_(sheet), ties_(options.ties(sheet)), options_(options) {}

  const std::vector<TiltTie>& ties() const { return ties_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(ties_.size()) + 1; }
  VectorXd start(double theta) const {
    VectorXd x(size());
    for (std::size_t k = 0; k < ties_.size(); ++k) x[static_cast<Eigen::Index>(k)] = ties_[k].tilt;
    x[size() - 1] = theta;
    return x;
  }
  model::Lattice sheet(const VectorXd& x) const {
    return with_tilts(sheet_, ties_, std::vector<double>(x.data(), x.data() + ties_.size()));
  }
  double theta(const VectorXd& x) const { return x[size() - 1]; }

  /// Returns the nearest allowed x; theta keeps its sign.
  VectorXd within(VectorXd x, double theta) const {
    for (Eigen::Index k = 0; k + 1 < size(); ++k) {
      const AngleRange& range = ties_[static_cast<std::size_t>(k)].range;
      x[k] = std::clamp(x[k], std::max(range.lower, -options_.tilt), std::min(range.upper, options_.tilt));
    }
    const double sign = theta < 0 ? -1 : 1;
    double& last = x[size() - 1];
    last = sign * std::clamp(sign * last, options_.min_theta, options_.max_theta);
    return x;
  }

 private:
  const model::Lattice sheet_;
  const std::vector<TiltTie> ties_;
  const CompensationOptions options_;
};

/// Returns the derivative of a function of the state by the tilts of all ties and by theta.
VectorXd by_variables(const std::vector<TiltTie>& ties, const model::DesignSensitivity& by) {
  VectorXd out(static_cast<Eigen::Index>(ties.size()) + 1);
  for (std::size_t k = 0; k < ties.size(); ++k) {
    double sum = 0;
    for (std::size_t h = 0; h < ties[k].hinges.size(); ++h)
      sum += ties[k].signs[h] * by.hinges(2, ties[k].hinges[h]);
    out[static_cast<Eigen::Index>(k)] = sum;
  }
  out[out.size() - 1] = by.theta;
  return out;
}

class CompensationSearch {
 public:
  CompensationSearch(const ElasticFit& start, const model::Elasticity& elasticity, const ElasticGoal& goal,
                     const CompensationOptions& options)
      : elasticity_(elasticity), goal_(goal), options_(options), variables_(start.sheet, options) {
    path_.contact = options.contact;
  }

  Compensation run(ElasticFit at) {
    Compensation out;
    at.rms_mm = rms(at);
    out.before = at;
    VectorXd x = variables_.start(at.theta);
    const VectorXd first = x;
    double damping = first_damping;
    while (out.why.empty()) {
      if (at.rms_mm <= options_.enough_mm)
        out.why = "it meets the goal";
      else if (options_.stop.stop_requested())
        out.why = "stopped";
      else if (out.rounds >= options_.rounds)
        out.why = "as many steps as are allowed";
      else
        step(at, x, damping, out);
    }
    out.largest_change =
        variables_.size() > 1 ? (x - first).head(variables_.size() - 1).cwiseAbs().maxCoeff() : 0;
    out.after = std::move(at);
    return out;
  }

 private:
  /// Tries steps with more and more damping until one helps or the limit of damping is reached.
  void step(ElasticFit& at, VectorXd& x, double& damping, Compensation& out) {
    const auto found = deviation_jacobian(at, variables_.ties(), elasticity_, goal_, options_.contact);
    if (!found) {
      out.why = "the equilibrium is at a limit: its derivatives are not known";
      return;
    }
    const VectorXd slope = found->jacobian.transpose() * found->deviations;
    const MatrixXd curvature = found->jacobian.transpose() * found->jacobian;
    const double scale = curvature.diagonal().maxCoeff();
    for (; damping <= max_damping && out.rounds < options_.rounds; damping *= harder) {
      ++out.rounds;
      MatrixXd damped = curvature;
      damped.diagonal().array() += damping * scale;
      const VectorXd full = SymmetricFactor(damped).solve(slope);
      const double part = std::min(1.0, longest_change / std::max(full.cwiseAbs().maxCoeff(), 1e-300));
      const VectorXd tried = variables_.within(x - part * full, at.theta);
      const std::optional<ElasticFit> next = follow(at, x, tried);
      if (!next || !(next->rms_mm < at.rms_mm)) continue;
      const double gain = at.rms_mm - next->rms_mm;
      const bool is_last = !(gain > min_gain * at.rms_mm);
      at = *next;
      x = tried;
      damping = std::max(damping * easier, min_damping);
      if (is_last) out.why = "steps gain little any more";
      return;
    }
    if (out.rounds < options_.rounds) out.why = "no step comes nearer";
  }

  /// Returns the equilibrium that a state changes into while tilts and theta change.
  std::optional<ElasticFit> follow(const ElasticFit& at, const VectorXd& from, const VectorXd& to) const {
    const auto changed = [&](double part) {
      const VectorXd x = from + part * (to - from);
      const model::Lattice sheet = variables_.sheet(x);
      return model::DrivenLinkage{sheet, goal_.drive(sheet, variables_.theta(x)), {}};
    };
    const model::EquilibriumPath path = follow_change(at.state, changed, elasticity_, path_);
    if (path.stop != model::EquilibriumPath::Stop::reached) return std::nullopt;
    ElasticFit out{variables_.sheet(to), variables_.theta(to), path.state};
    out.rms_mm = rms(out);
    return std::isfinite(out.rms_mm) ? std::optional(out) : std::nullopt;
  }

  double rms(const ElasticFit& at) const {
    const std::vector<model::ObservedPoint> observed = goal_.observe(at.sheet, at.state);
    return model::ObservedPoints(observed, true).rms_mm();
  }

  const model::Elasticity& elasticity_;
  const ElasticGoal& goal_;
  const CompensationOptions options_;
  const Variables variables_;
  model::EquilibriumPathOptions path_;
};

}  // namespace

std::optional<DeviationJacobian> deviation_jacobian(const ElasticFit& at, const std::vector<TiltTie>& ties,
                                                    const model::Elasticity& elasticity,
                                                    const ElasticGoal& goal, bool contact) {
  model::ElasticSystem system(at.sheet, elasticity, goal.drive(at.sheet, at.theta), false, contact);
  model::State state = at.state;
  model::TangentStiffness tangent(system.dofs());
  if (!settle(system, at.theta, state, tangent)) return std::nullopt;
  const std::vector<model::ObservedPoint> observed = goal.observe(at.sheet, state);
  const model::ObservedPoints points(observed, true);
  DeviationJacobian out{points.aligned_deviations(),
                        MatrixXd(points.size(), static_cast<Eigen::Index>(ties.size()) + 1)};
  const model::DesignSensitivities by_design(system, state, at.theta, tangent);
  for (Eigen::Index k = 0; k < points.size(); ++k) {
    const VectorXd one =
        points.by_state(VectorXd::Unit(points.size(), k), state.size(), at.sheet.size().edge_mm);
    out.jacobian.row(k) = by_variables(ties, by_design.of(one)).transpose();
  }
  const bool usable = out.deviations.allFinite() && out.jacobian.allFinite() && !out.jacobian.isZero(0);
  return usable ? std::optional(std::move(out)) : std::nullopt;
}

Compensation compensate(const ElasticFit& start, const model::Elasticity& elasticity, const ElasticGoal& goal,
                        const CompensationOptions& options) {
  return CompensationSearch(start, elasticity, goal, options).run(start);
}

}  // namespace kinetix::optim
