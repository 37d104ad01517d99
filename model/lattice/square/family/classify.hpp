#pragma once

#include <string>

#include "model/lattice/square/family/exact_family.hpp"
#include "model/lattice/square/family/family_rules.hpp"
#include "model/lattice/square/family/net.hpp"
#include "model/lattice/square/family/planar_sheet.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

std::string to_string(Family family);

/// The exact family of a structure.
struct Classification {
  Family family = Family::none;
  /// The sheet folds along y instead of x: `design` describes its mirror image with x and y exchanged.
  bool transposed = false;
  ExactDesign<double> design;  ///< for F1, F2 and F3, with theta 0; empty otherwise
  NetTree tree;                ///< for F4
  Redrawing redrawing;         ///< for planar sheets that are not F1, per body
  int breaking_hinge = -1;     ///< for Family::none: index of the first hinge that breaks the rule
  std::string why;             ///< one sentence: the family's rule or the hinge that breaks it
};

/// Tests the rules of kinematics.md section 2 hinge by hinge: F1, F2 and F3 along x, then along y, then F4. If all
/// hinges are upright, it then tests if every face closes as on any planar graph (section 5). The design of columns
/// and rows follows most of their hinges. For Family::none the breaking hinge is that of the family with the fewest
/// broken hinges.
/// A family means that the structure moves exactly. Its degrees of freedom are given by mobility(): panels joined
/// only at one vertex also move separately.
/// @param tolerance on fractions (absolute) and angles (rad)
Classification classify(const Structure& structure, double tolerance = 1e-9);

/// Returns the state of an exactly mobile structure at fold angle theta, rad. @pre family != none
State fold(const Classification& classification, const Structure& structure, double theta);

/// Returns the closed form as an ExactMotion, independent of the lattice. It is empty for Family::none.
ExactMotion exact_motion(const Structure& structure, const Classification& classification);
ExactMotion exact_motion(const Structure& structure);

}  // namespace kinetix::model
