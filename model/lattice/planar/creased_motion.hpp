#pragma once

#include <string>
#include <vector>

#include "model/lattice/planar/planar_crease.hpp"

namespace kinetix::model {

/// The exact motion of a planar structure with creases (kinematics.md section 6): each facet moves in its plane as
/// the structure without creases would, and is turned as a whole about the lines of the creases that lead to it.

/// As ExactMotion::name has it.
inline constexpr const char* creased_family = "creased";

/// Creases that lead from the facet of body 0 to every other, a facet after the one it comes from.
struct FacetTree {
  struct Link {
    int facet = 0, parent = 0;
    int crease = 0;  ///< index in PlanarCreases::list
    int side = 1;    ///< 1 where it leads from the crease's `from` to its `to`, -1 back
  };
  std::vector<Link> links;
};
FacetTree facet_tree(const PlanarCreases& creases);

/// State at theta, mm. The facet of body 0 stays in the plane z = 0.
/// @pre why_not_creased() finds nothing: otherwise hinges off the tree do not close
State fold(const PlanarStructure& structure, const Redrawing& y, const PlanarCreases& creases,
           const FacetTree& tree, double theta);

/// Why the creases of a structure that moves exactly in its plane do not fold it exactly, in a sentence with walls or
/// faces and amounts; empty where they do. They fold it when each runs from rim to rim, or to where it meets others, its
/// hinges lean alike and stay on its line, and creases meet only where turning about all of them in turn leads back:
/// four of a flat-foldable vertex do (kinematics.md section 6).
std::string why_not_creased(const PlanarStructure& structure, const Redrawing& y,
                            const PlanarCreases& creases);

/// Of structures with hinges that lean. @pre y is that of redrawing_of(structure), and closes
ExactMotion creased_motion(const PlanarStructure& structure, const Redrawing& y);

}  // namespace kinetix::model
