#pragma once

#include <vector>

#include "model/contact/hinge_chains.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

/// Turns of the hinges of a linkage along its closed form: the part of a proof that is common to all states.
struct LinkageMotion {
  /// @param structure kept by reference   @param turns one per hinge
  LinkageMotion(const Linkage& structure, const std::vector<TurnLaw>& turns);

  double edge() const { return structure.size.edge_mm; }
  /// Returns a body that no chain of hinges joins to the others, or -1.
  int loose_body() const;
  /// Returns a bound of the deviation of a body from the position given by its hinges, relative to another body, mm.
  /// @param hinges number of hinges between them   @param gap cell edges, @param off rad: see LawDeviation
  double margin_mm(std::size_t hinges, double gap, double off) const;

  const Linkage& structure;
  std::vector<TurnLaw> laws;  ///< distinct laws
  std::vector<int> law_of;    ///< index in `laws`, per hinge
  std::vector<int> senses;    ///< hinge_sense of each hinge
  double longest_arm = 0;     ///< longest arm of a hinge, cell edges
  HingeChains chains;
  int middle = 0;                        ///< body
  std::vector<HingeChains::Link> links;  ///< from the middle body outwards
};

}  // namespace kinetix::model
