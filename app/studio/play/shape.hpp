#pragma once

#include "app/files/design_file.hpp"
#include "app/studio/play/page_updates.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/deployment.hpp"
#include "model/elastic/contact/piece_contact.hpp"
#include "model/lattice/nearest_design.hpp"
#include "model/linkage/exact_motion.hpp"
#include "sim/live_sheet.hpp"
#include "sim/physics_options.hpp"

namespace kinetix::app::studio {

/// Two bodies that collide during the motion.
struct Collision {
  double turn = 0;  ///< turn of the driven hinge, rad, in the first known state where they collide
  std::array<int, 2> bodies = {};
};

/// Motion of bodies while one hinge turns, in both directions from rest, with all hinges closed.
struct BodiesMotion {
  int hinge = 0;                        ///< that turns
  int sense = 1;                        ///< sense of the hinge's lower body
  std::vector<model::State> states;     ///< with closed hinges, mm
  std::vector<double> turns;            ///< turn of the hinge in each state, rad, increasing
  int rest = 0;                         ///< index of the state at rest
  std::array<int, 2> opens = {-1, -1};  ///< hinges that open beyond the first and the last state; -1: none
  bool pulled = false;                  ///< bodies are pulled; turns are then fractions of the path
  bool followed = false;                ///< the whole motion is known; otherwise rest only
  /// First collisions in the negative and positive direction; empty until they are computed.
  std::optional<std::array<std::optional<Collision>, 2>> meets = {};
};

/// Returns the motion of bodies known only at rest.
BodiesMotion motion_at_rest(const model::Linkage& linkage, int hinge);

/// Computes the motion until one angle no longer defines it, or until a hinge opens.
/// @param pull pulls the bodies instead of turning a hinge: turns are then the path's fraction times twice
/// mean_half_turn at the end
/// @param stop called between steps
BodiesMotion motion_of(const model::Linkage& linkage, int hinge, const std::optional<model::Pull>& pull,
                       const std::function<bool()>& stop = {});

/// Finds the first collision in the negative (-1) or positive (1) direction. Surfaces must cross by more than
/// 0.01 mm; walls of one height cross some hundredths later. Bodies that cross at rest do not count.
/// @param stop called between states
std::optional<Collision> first_collision(const model::Assembly& assembly, const BodiesMotion& motion,
                                         int direction, const std::function<bool()>& stop = {});

/// Returns the state with this turn of the hinge, rad, limited to the known motion. Closes the hinges anew.
model::State state_at(const model::Linkage& linkage, const BodiesMotion& motion, double turn);

/// Finds the turn, rad, near `from`, at which the point `at` of a body (rest place, mm) is nearest to `to`
/// (mm). Points move straight between known states.
double nearest_turn(const model::Linkage& linkage, const BodiesMotion& motion, double from, int body,
                    const Eigen::Vector3d& at, const Eigen::Vector3d& to);

/// Design with the known part of its motion.
struct Moving {
  /// Puts bodies at rest. The turned hinge is the drive's, or the one that turns most in the first motion.
  explicit Moving(const Design& design);

  /// Sets the known motion of bodies as their exact motion.
  void take(std::shared_ptr<const BodiesMotion> found);
  /// Keeps the pieces for collisions of a design with the same shape, and its motion if the same hinge or
  /// pull drives it.
  void keep(const Moving& before);
  /// Limits theta, rad, of bodies to their known motion.
  double within(double theta) const;
  /// Returns the fold of the shape, rad: the mean of a sheet; for bodies half the turn of the driven hinge.
  double theta_of(const model::State& state) const;
  /// Returns the drive that turns the hinge of bodies to theta, limited to their known motion.
  model::LinkageDrive turned(double theta) const;

  model::Linkage linkage;
  model::ExactMotion exact;
  std::optional<model::NearestDesign> nearest;  ///< set only without exact motion, if one is known.
  /// Range in rad without contact between walls on the exact path; of bodies the known motion.
  double min_theta = 0, max_theta = 0;
  std::shared_ptr<const Design> bodies;                 ///< null for sheets, and so are the members below
  std::shared_ptr<const BodiesMotion> motion;           ///< as far as it is known
  std::shared_ptr<const sim::ContactParts> parts;       ///< for collisions; null until they are cut
  std::shared_ptr<const model::ConvexBodies> pressing;  ///< convex pieces for contact in equilibrium
};

/// Returns whether both are designs of bodies with equal shape and hinges. Stiffness and drive may differ.
/// Null: a sheet.
bool have_same_shape(const Design* a, const Design* b);

/// Returns the theta that the design requests, rad; for bodies half the turn of the hinge that its drive
/// turns.
double requested_theta(const Design& design, const Moving& moving);

/// Finds the theta, rad, near `from` and within the range, at which the point `at` of a body (rest place, mm)
/// is nearest to `to` (mm) on the exact path. @pre moving.exact
double nearest_theta(const Moving& moving, double from, int body, const Eigen::Vector3d& at,
                     const Eigen::Vector3d& to);

/// Returns the design's drive, or the default drive if it has none, up to theta, rad, in (-pi/2, pi/2).
model::LinkageDrive drive_to(const Design& design, double theta);

/// Returns the design at the shown fold, for export and simulation. With a closed form theta alone sets the
/// fold and the drive is removed; otherwise the drive ends there. A flat sheet keeps the design's fold.
/// Bodies turn their hinge as shown.
/// @param moving belongs to the design   @throws InvalidInput for bodies that are pulled
/// @param sheet_theta rad, of the sheet   @param drive_theta rad, of its drive (LinkageDrive::theta)
Design design_at_shown_fold(Design design, const Moving& moving, double sheet_theta, double drive_theta);

/// Returns the design at the shown fold for its file. The drive is kept and ends at that fold.
Design design_for_saving(Design design, const Moving& moving, double sheet_theta, double drive_theta);

/// Returns a flat design in the interactive engine.
/// @param springs hinges are as elastic as the design says; not for bodies
/// @param moving belongs to the design; must outlive the result
std::unique_ptr<sim::LiveSheet> live_sheet(const Design& design, const Moving& moving, bool springs);

}  // namespace kinetix::app::studio
