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

/// Which exact family a structure belongs to.
struct Classification {
  Family family = Family::none;
  /// The sheet folds along y instead of x: `design` describes its mirror image with x and y exchanged.
  bool transposed = false;
  ExactDesign<double> design;  ///< theta 0, of F1, F2 and F3; empty otherwise
  NetTree tree;                ///< of F4
  Redrawing redrawing;         ///< of planar sheets that are not F1, of each body
  int breaking_hinge = -1;     ///< for Family::none: index of the first hinge that breaks the rule
  std::string why;             ///< one sentence, naming the family's rule or the hinge that breaks it
};

/// Tests the rules of kinematics.md section 2 hinge by hinge, F1, F2 and F3 along x, then along y, then F4;
/// then, where all hinges stand upright, whether every face closes as on any planar graph (section 5).
/// Columns and rows are taken as most of their hinges have them. For Family::none the breaking hinge is that
/// of the family that holds for the most hinges. A family tells that the structure moves exactly; how freely,
/// is for mobility() to say: panels joined at one vertex alone also move by themselves.
/// @param tolerance on fractions (absolute) and angles (rad)
Classification classify(const Structure& structure, double tolerance = 1e-9);

/// State of an exactly mobile structure at fold angle theta, rad. @pre family != none
State fold(const Classification& classification, const Structure& structure, double theta);

/// That closed form for code that knows no lattice; without one where the family is none.
ExactMotion exact_motion(const Structure& structure, const Classification& classification);
ExactMotion exact_motion(const Structure& structure);

}  // namespace kinetix::model
