#pragma once

#include "app/files/goal_settings.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// Model that computes a scene's state.
enum class Model { exact, equilibrium, bullet };

std::string to_string(Model model);

/// Decisions on how to compute a scene, made before anything is computed.
struct Plan {
  model::ExactMotion exact;  ///< motion of its family; without a motion outside the exact families
  Model model = Model::exact;
  bool planar = false;  ///< all hinges stand upright: an equilibrium stays in the plane z = 0
  std::optional<model::Mobility> mobility;  ///< empty if not computed, as for large structures
  std::optional<model::ContactRange>
      free_range;                ///< theta without contact of walls; empty outside the exact families
  std::vector<std::string> why;  ///< one sentence per decision
  std::size_t decided = 0;       ///< number of sentences in `why` by make_plan; a scene adds the others

  /// Whether it is known to have several degrees of freedom.
  bool is_floppy() const { return mobility && mobility->dofs_along > 1; }
};

/// Plans a scene. @param model empty: exact if a family fits, otherwise bullet
/// @param exact motion of the sheet, if known
Plan make_plan(const model::Lattice& sheet, std::optional<Model> model = {}, model::ExactMotion exact = {});
/// Plans only what computes the state: no mobility, range or sentences.
Plan make_brief_plan(const model::Lattice& sheet, std::optional<Model> model = {},
                     model::ExactMotion exact = {});

/// Estimates of a run, known before it starts.
struct Forecast {
  model::Lattice sheet;                           ///< expected sheet; its hinges are still to be found
  std::optional<Eigen::Vector3d> folded_mm = {};  ///< edges of the box around the folded sheet, if known
  double search_s = 0;  ///< estimate, s, within a factor of three on one core of 2020
  bool has_physics = true;
  std::vector<std::string> notes = {};  ///< likely problems, with advice
};

/// Estimates the time of compensation for elastic hinges, s, measured on folds of 30 to 170 bodies; 0 for other
/// hinges.
double compensation_seconds(const GoalSettings& settings, const model::Lattice& sheet);

/// Adds time and risks of the settings that every goal has: compensation_seconds(), and what the process cannot print.
void add_settings(const GoalSettings& settings, Forecast& forecast);

/// Returns the edges of the box around all half walls of the flat sheet, mm. Walls that lean reach beyond its cells.
Eigen::Vector3d flat_size(const model::Linkage& linkage);

/// Returns the edges of the box around all half walls in a state, along the axes of its frame, mm.
Eigen::Vector3d size_of(const model::Linkage& linkage, const model::State& state);

/// Returns the edges of a small box round points in any orientation, longest first, in the unit of the points. The
/// orientation is the best one found by turning boxes about their edges, so it does not depend on the frame of the
/// points by more than about 0.1 %. @pre all finite
Eigen::Vector3d smallest_box(const std::vector<Eigen::Vector3d>& points);

/// Returns the edges of a small box around all half walls in a state, longest first, mm. It turns with the sheet, so runs
/// whose frames differ report one size.
Eigen::Vector3d folded_size(const model::Linkage& linkage, const model::State& state);

/// Estimates the time of a simulation, s, on one core of 2020, within a factor of two. Measured on sheets of 80 to
/// 900 bodies, whose cost grows with loops of hinges, one per cell. Also measured on blocks of 384 to 5000 bodies,
/// whose matrix factors fill.
double physics_seconds(const model::Lattice& sheet);

/// Estimates the time that the collision-free range takes, s, on one core of 2020; measured on sheets of 4000 to 63 000 bodies.
double contact_seconds(const model::Lattice& sheet);

/// Estimates the memory of a run, bytes, from measurements: a constant plus an amount per body.
double memory_needed(const model::Linkage& linkage);

/// Returns "about 2 s", "about 5 minutes": one significant digit, since it is an estimate. @param seconds >= 0
std::string about(double seconds);

}  // namespace kinetix::app
