#pragma once

#include <vector>

#include "model/contact/hinge_chains.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

/// What of a linkage stays the same from state to state, for proofs that its plates stay apart.
struct LinkagePlates {
  /// @param structure kept by reference   @param turns one a hinge   @param growth_mm of every plate, on all its sides
  LinkagePlates(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm);

  double edge() const { return structure.size.edge_mm; }
  /// Whether they are to be looked at: not of one wall, and not touching at rest. @pre of two bodies
  bool can_touch(const WallPair& pair) const;
  /// A body that no chain of hinges joins to the others, -1 where there is none.
  int loose_body() const;

  const Linkage& structure;
  std::vector<TurnLaw> laws;                ///< each once
  std::vector<int> law_of;                  ///< each hinge
  std::vector<int> senses;                  ///< of each hinge, as hinge_sense has them
  double longest_arm = 0;                   ///< of a hinge, cell edges
  std::vector<HalfWall> walls;              ///< grown
  WallContact at_rest;                      ///< not grown
  std::vector<std::vector<int>> plates_of;  ///< each body
  std::vector<double> reach;                ///< of each body's plates from its vertex, mm
  HingeChains chains;
  int middle = 0;                        ///< body
  std::vector<HingeChains::Link> links;  ///< from the middle body outwards
};

}  // namespace kinetix::model
