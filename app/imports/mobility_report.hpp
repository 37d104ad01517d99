#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "model/assembly/assembly.hpp"

namespace kinetix::app {

/// How an imported assembly moves.
struct AssemblyMobility {
  int gruebler = 0;            ///< degrees of freedom by counting bodies and hinges
  std::optional<int> at_rest;  ///< first-order motions at rest; nothing: too many bodies to count
  int hinge = -1;              ///< that is turned to see; -1: nothing turns
  double sense = 1;            ///< sign of its turn, 1 or -1, dimensionless
  double turn = 0;             ///< up to which all hinges stay closed, rad
  int broken =
      -1;  ///< the hinge that breaks it: with which nothing moves any more, or which opens first beyond `turn`
  std::string why;  ///< in a sentence
};

/// Turns the hinge that turns most in the first motion by up to 60 degrees, with all others rigid rotary ones.
AssemblyMobility examine(const model::Assembly& assembly);

nlohmann::ordered_json mobility_json(const AssemblyMobility& mobility, const model::Assembly& assembly);

}  // namespace kinetix::app
