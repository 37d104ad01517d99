#include "app/pipeline/as_made.hpp"

#include <cmath>

#include "app/pipeline/physics_settings.hpp"
#include "app/run/stopwatch.hpp"

namespace kinetix::app {
namespace {

/// A pin rests anywhere in its bore: evenly within the clearance, along the wall as across it.
double play_sd(const HingeSection& hinge) { return hinge.made ? play_mm(*hinge.made) / std::sqrt(3.0) : 0; }

model::HingeScatter scatter_of(const Run& run) {
  const double edge = run.structure.size().edge_mm, play = play_sd(run.hinge) / edge;
  model::HingeScatter scatter;
  scatter.t = std::hypot(run.process.sd.t_mm / edge, play);
  scatter.beta = run.process.sd.tilt_deg * radians_per_degree;
  scatter.offset = play;
  return scatter;
}

}  // namespace

std::optional<PrintedGoal> as_made(const Run& run, const model::LinkageDrive& drive,
                                   const std::vector<model::ObservedPoint>& points) {
  if (points.empty() || run.states.empty()) return std::nullopt;
  Stopwatch watch;
  const model::State& state = run.states.front().poses;
  const model::Elasticity elasticity = elasticity_of(run.hinge, run.physics, run.structure.size().edge_mm);
  const model::ElasticSystem system(run.structure, elasticity, drive, false, false);
  model::TangentStiffness tangent(system.dofs());
  system.linearise(state, drive.theta(), tangent);
  if (!tangent.factorise(0)) return std::nullopt;
  PrintedGoal out;
  out.made = as_made(system, elasticity, state, drive.theta(), tangent, points, scatter_of(run));
  out.seconds = watch.lap();
  return out;
}

}  // namespace kinetix::app
