#pragma once

#include <functional>
#include <vector>

#include "app/run/forecast.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "optim/matter/tilt_ties.hpp"
#include "optim/solvers/variables.hpp"

namespace kinetix::app {

/// What the physics engine is to run, and what its last state is compared with.
struct PhysicsTask {
  model::State reference;  ///< of the same drive by the run's model; empty where no model knows one
  model::LinkageDrive drive;
  sim::PhysicsOptions options;
};

/// What a file allows tilts and theta to be.
struct TurnBounds {
  double tilt = 75 * radians_per_degree;  ///< of either sign, rad, (0, pi/2)
  optim::AngleRange theta{2 * radians_per_degree, 44 * radians_per_degree};  ///< rad, (0, pi/2)
  /// Of a sheet that its search has found: which tilts it keeps alike, and within what.
  std::function<std::vector<optim::TiltTie>(const model::Sheet&)> ties = optim::tilt_ties;
};

/// What the pipeline runs: the goal of a target, or a design. Each stage adds what it finds to the run.
class Scene {
 public:
  virtual ~Scene() = default;

  /// Names folders of results.
  virtual std::string name() const = 0;
  /// The model that the states come from. Nothing: exact where a family fits, else bullet.
  virtual std::optional<Model> model() const { return {}; }

  /// What can be said without a search.
  virtual Forecast forecast() const = 0;

  /// Sets the structure, theta, and what the file asks of hinges, drive and physics. Searches for them
  /// where there is a goal, and sets run.goal. @throws InvalidInput for a target that leaves nothing to
  /// search
  virtual void solve(Run& run, const RunOptions& options) const = 0;
  /// Adds the state in which the model holds the structure. @pre planned
  virtual void add_state(Run& run, const RunOptions& options) const = 0;
  /// Says what the state lacks of the goal.
  virtual void judge(Run&, const RunOptions&) const {}
  /// The points by which the goal is judged, and what their rms may be.
  struct Judged {
    std::vector<model::ObservedPoint> points;
    double tolerance_mm = 0;
  };
  /// How far a state is from the goal. Nothing of goals that are not judged by distances.
  /// @param sheet that the state is of: the run's, or one with other hinges
  /// @param state anywhere in space; points are in its own frame. @pre solved
  virtual std::optional<Judged> judged(const Run&, const model::Sheet& /*sheet*/,
                                       const model::State& /*state*/) const {
    return std::nullopt;
  }
  /// Of scenes with a goal: whether judged() may have something.
  virtual bool is_judged_by_distances() const { return true; }
  /// How far tilts and theta may go to make up for elastic hinges: what the file allows its search.
  virtual TurnBounds turn_bounds() const { return {}; }
  /// Says what the equilibrium of elastic hinges lacks of a goal that was searched for exactly, in place of what
  /// the exact state lacks.
  virtual void judge_matter(Run&, const model::State&) const {}
  /// The same state where results show it.
  virtual model::State shown(const Run&, const model::State& state) const { return state; }
  /// The state in which the model holds the structure, not yet where results show it. @pre state added
  virtual model::State own_state(const Run& run) const { return run.states.front().poses; }
  /// Nothing where a physics run is not worth its time.
  virtual std::optional<PhysicsTask> physics_task(const Run& run) const = 0;
  /// Says what the settled physics run lacks of the goal.
  virtual void judge_physics(Run&) const {}
  /// Adds states that show the motion.
  virtual void add_frames(Run&) const {}
};

}  // namespace kinetix::app
