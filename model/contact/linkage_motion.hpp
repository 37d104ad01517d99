#pragma once

#include <vector>

#include "model/contact/hinge_chains.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

/// How the hinges of a linkage turn along its closed form: the part of a proof that stays the same from state to state.
struct LinkageMotion {
  /// @param structure kept by reference   @param turns one a hinge
  LinkageMotion(const Linkage& structure, const std::vector<TurnLaw>& turns);

  double edge() const { return structure.size.edge_mm; }
  /// A body that no chain of hinges joins to the others, -1 where there is none.
  int loose_body() const;
  /// Bound of how far a body is from where its hinges put it, seen from another one, mm.
  /// @param hinges on the way between them   @param gap cell edges, @param off rad: LawDeviation
  double margin_mm(std::size_t hinges, double gap, double off) const;

  const Linkage& structure;
  std::vector<TurnLaw> laws;  ///< each once
  std::vector<int> law_of;    ///< each hinge
  std::vector<int> senses;    ///< of each hinge, as hinge_sense has them
  double longest_arm = 0;     ///< of a hinge, cell edges
  HingeChains chains;
  int middle = 0;                        ///< body
  std::vector<HingeChains::Link> links;  ///< from the middle body outwards
};

}  // namespace kinetix::model
