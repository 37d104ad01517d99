#pragma once

#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "model/lattice/square/family/net.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Exact families of square lattices (kinematics.md section 2), and `planar`: upright hinges that close every face of
/// the sheet as on any planar graph (section 5).
enum class Family { F1, F2, F3, F4, planar, none };

/// Rule on offsets that F1 to F4 share, as a sentence.
inline constexpr const char* off_the_wall =
    "hinges off the middle of their walls (offset) need upright hinges";

/// Tests one wall against the rules of the sheet families F1, F2 and F3 (folding along x). Returns the rule that its
/// fraction and tilt break, as a sentence, or nullptr. It does not check if the walls of a column or a row agree.
/// @param t, beta of the wall, in either direction   @param tolerance on the fraction (absolute) and the tilt (rad)
const char* broken_rule(Family family, Axis axis, double t, double beta, double tolerance);

/// Returns a sheet of squares as a structure on a planar graph. Its vertices are the bodies and its edges are the
/// hinges, in the same order. Its faces are the cells, in the same order, then the holes between them.
PlanarStructure planar_structure(const Structure& sheet);

/// Planar motion of a sheet (kinematics.md section 5).
struct PlanarSheet {
  ParallelDrawing y;  ///< per body, if it moves exactly; otherwise empty
  int hinge = -1;     ///< if it does not move exactly: one around the face with the worst misfit
  std::string why;    ///< one sentence
};

/// Computes the planar motion of a sheet. @pre all hinges are upright
PlanarSheet planar_motion(const Structure& sheet);

/// Places the hinges of a sheet by y, given for each body; alpha and beta do not change.
void place_hinges(const ParallelDrawing& y, Structure& sheet);

/// Returns the state at theta, mm. @param y per body
State fold(const ParallelDrawing& y, const Structure& sheet, double theta);

std::string to_string(Family family);

/// The exact family of a structure.
struct Classification {
  Family family = Family::none;
  /// The sheet folds along y instead of x: `design` describes its mirror image with x and y exchanged.
  bool transposed = false;
  ExactDesign<double> design;        ///< for F1, F2 and F3, with theta 0; empty otherwise
  NetTree tree;                      ///< for F4
  ParallelDrawing parallel_drawing;  ///< for planar sheets that are not F1, per body
  int breaking_hinge = -1;           ///< for Family::none: index of the first hinge that breaks the rule
  std::string why;                   ///< one sentence: the family's rule or the hinge that breaks it
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

/// Returns the theta, rad, at which a sheet of an exact family reaches a drive's target.
/// @throws InvalidInput if there is no such theta, if rows between plates do not stay straight, and if a bending
/// sheet would roll between the plates
double theta_of(const LinkageDrive& drive, const Classification& kind, const Structure& structure);

}  // namespace kinetix::model
