#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "model/assembly/assembly.hpp"
#include "model/assembly/deployment.hpp"

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

}  // namespace kinetix::app::studio
