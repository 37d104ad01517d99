#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/files/design_file.hpp"
#include "app/studio/play/frame.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/deployment.hpp"
#include "model/contact/convex_bodies.hpp"
#include "model/lattice/nearest_design.hpp"
#include "model/linkage/exact_motion.hpp"
#include "sim/contact_parts.hpp"
#include "sim/live_sheet.hpp"

namespace kinetix::app::studio {

/// Two bodies that run into each other.
struct Meeting {
  double turn = 0;  ///< of the driven hinge, rad: the first known state at which they do
  std::array<int, 2> bodies = {};
};

/// How bodies move while one of their hinges is turned, both ways from rest, all hinges closed.
struct BodiesWay {
  int hinge = 0;                        ///< that is turned
  int sense = 1;                        ///< of its lower body
  std::vector<model::State> states;     ///< closed ones, mm
  std::vector<double> turns;            ///< of the hinge in each, rad, rising
  int rest = 0;                         ///< the index of the one at rest
  std::array<int, 2> opens = {-1, -1};  ///< hinges that open behind the first state and the last; -1: none
  bool pulled = false;    ///< bodies are pulled and no hinge is turned: turns stand for shares of the way
  bool followed = false;  ///< as far as it goes; else rest alone is known
  /// On the way back and forth; nothing while it was not looked through.
  std::optional<std::array<std::optional<Meeting>, 2>> meets = {};
};

/// The way of bodies that are only known at rest.
BodiesWay way_at_rest(const model::Linkage& linkage, int hinge);

/// As far as one angle can tell, or until a hinge opens.
/// @param pull of the bodies, instead of a turned hinge: the turn is that share of twice mean_half_turn at its end
/// @param stop asked between steps
BodiesWay way_of(const model::Linkage& linkage, int hinge, const std::optional<model::Pull>& pull,
                 const std::function<bool()>& stop = {});

/// The first meeting on the way back (-1) or forth (1): surfaces cross by more than 0.01 mm, which walls of one height do some
/// hundredths later. Bodies that already do at rest do not count.
/// @param stop asked between states
std::optional<Meeting> first_meeting(const model::Assembly& assembly, const BodiesWay& way, int direction,
                                     const std::function<bool()>& stop = {});

/// Where the hinge has that turn, rad, or as near to it as the way goes: closed anew from the nearest known state.
model::State state_at(const model::Linkage& linkage, const BodiesWay& way, double turn);

/// The turn, rad, within reach of a hand from another one, at which the point `at` of a body (rest place, mm) comes nearest to
/// `to` (mm). Between known states points go straight.
double nearest_turn(const model::Linkage& linkage, const BodiesWay& way, double from, int body,
                    const Eigen::Vector3d& at, const Eigen::Vector3d& to);

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
