#include "benchmarks/peers/simulated_fit.hpp"

#include "model/lattice/lattice_motion.hpp"
#include "sim/physics_run.hpp"
#include "targets/curve/curve.hpp"

namespace kinetix::bench {

using Eigen::VectorXd;

SimulatedFit::SimulatedFit(const optim::CurveFit& fit, const model::CellSize& size,
                           const sim::PhysicsOptions& options)
    : fit_(fit),
      size_(size),
      options_(options),
      lower_(fit.lower().head(fit.ties().variables() + 1)),
      upper_(fit.upper().head(fit.ties().variables() + 1)) {
  const model::State flat = rest_state(make_structure(model::rectangle(fit.ties().columns(), 1), size));
  residuals_ = static_cast<int>(curve_error(optim::midline(flat, 1), fit.goal()).distance_mm.size());
}

bool SimulatedFit::evaluate(const VectorXd& x, VectorXd& r, Eigen::MatrixXd*) const {
  VectorXd all = VectorXd::Zero(fit_.variables());
  all.head(x.size()) = x;
  const model::ExactDesign<double> design = fit_.design(all, 1);
  model::Structure structure = make_structure(model::rectangle(design.columns(), 1), size_);
  apply(design, structure);
  const sim::PhysicsResult run =
      run_compression(structure, drive_on(structure, drive_to(structure, design.theta)), options_);
  ++runs_;
  r = VectorXd::Ones(residuals_);
  if (run.status != sim::PhysicsResult::Status::settled) return true;
  const targets::CurveError error = curve_error(optim::midline(run.state, 1), fit_.goal());
  if (static_cast<int>(error.distance_mm.size()) != residuals_) return true;
  r = Eigen::Map<const VectorXd>(error.distance_mm.data(), residuals_) /
      (error.scale_mm * std::sqrt(residuals_));
  return true;
}

}  // namespace kinetix::bench
