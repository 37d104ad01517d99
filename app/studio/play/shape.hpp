#pragma once

#include <memory>
#include <optional>

#include "app/files/design_file.hpp"
#include "app/studio/play/bodies_way.hpp"
#include "app/studio/play/frame.hpp"
#include "model/contact/convex_bodies.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/sheet/nearest_design.hpp"
#include "sim/contact_parts.hpp"
#include "sim/live_sheet.hpp"

namespace kinetix::app::studio {

/// A design with what is known of its motion.
struct Moving {
  /// Bodies at rest, with the hinge that is turned, or that turns most in the first motion.
  explicit Moving(const Design& design);

  /// What is known of the way of bodies from now on: it is their exact motion.
  void take(std::shared_ptr<const BodiesWay> found);
  /// What is known of bodies of the same shape: what they collide with, and their way where the same moves them.
  void keep(const Moving& before);
  /// theta, rad, of bodies as far as their way goes.
  double within(double theta) const;
  /// As far as the shape is folded, rad: the mean of a sheet; of bodies half the turn of the driven hinge.
  double theta_of(const model::State& state) const;
  /// Bodies by their hinge, as far as their way goes.
  model::LinkageDrive turned(double theta) const;

  model::Linkage linkage;
  model::ExactMotion exact;
  std::optional<model::NearestDesign> nearest;  ///< where it does not move exactly, and one is known
  /// rad, where no walls touch on the exact way; of bodies as far as it goes
  double least_theta = 0, most_theta = 0;
  std::shared_ptr<const Design> bodies;                 ///< null: a sheet; and the rest is null
  std::shared_ptr<const BodiesWay> way;                 ///< as far as it is known
  std::shared_ptr<const sim::ContactParts> parts;       ///< what they collide with; null until they are cut
  std::shared_ptr<const model::ConvexBodies> pressing;  ///< the same in equilibrium
};

/// Whether both are designs of bodies that look and move alike, whatever their stiffness and drive. Null: a sheet.
bool have_one_shape(const Design* a, const Design* b);

/// Theta that the design asks for, rad: of bodies half the turn of the hinge that its drive turns.
double asked_theta(const Design& design, const Moving& moving);

/// theta, rad, within the range, at which the point `at` of a body (rest place, mm) comes nearest to `to` (mm) on the
/// exact way, found from a theta near to it. @pre moving.exact
double nearest_theta(const Moving& moving, double from, int body, const Eigen::Vector3d& at,
                     const Eigen::Vector3d& to);

/// The design's own drive, or else the usual one, as far as theta, rad, in (-pi/2, pi/2).
model::LinkageDrive drive_to(const Design& design, double theta);

/// The design as far as it is shown, for what is made of it: along its closed form by theta alone, whatever drives it,
/// else by its own drive. A flat sheet goes as far as the design says. Bodies turn their hinge as it is turned.
/// @param moving of the design   @throws InvalidInput for bodies that are pulled
/// @param sheet_theta rad, of the sheet   @param drive_theta rad, of its drive (LinkageDrive::theta)
Design as_far_as_shown(Design design, const Moving& moving, double sheet_theta, double drive_theta);

/// The same for its file, which keeps its drive: that ends where it is shown.
Design saved_as_shown(Design design, const Moving& moving, double sheet_theta, double drive_theta);

/// A design in the engine, ready to be played with, flat. @param springs hinges as elastic as the design says; not of bodies
/// @param moving of the design; must outlive it
std::unique_ptr<sim::LiveSheet> live_sheet(const Design& design, const Moving& moving, bool springs);

}  // namespace kinetix::app::studio
