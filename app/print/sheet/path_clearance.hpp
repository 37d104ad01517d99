#pragma once

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Distance of two parts that has the least spare over what is required.
struct LeastDistance {
  double mm = 0;                ///< negative: how deep they are in each other, mm
  int first = -1, second = -1;  ///< parts: bodies, then soft parts by hinge; -1: there are no two
  double theta = 0;             ///< rad
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< between them, in the state at theta, mm
  double required_mm = 0;  ///< required, mm: a pin's clearance; 0 for soft parts, which may not collide

  /// Returns `mm` less the required distance, mm; negative: too near. A pin's clearance may be short by 0.01 mm, the
  /// error of circles as polygons.
  double excess_mm() const;
};

/// Distances between the solids from flat to the fold.
struct PathClearance {
  LeastDistance in_hinges;  ///< of two bodies that share a hinge, mm
  LeastDistance elsewhere;  ///< of all other parts, mm
  LeastDistance nearest;    ///< of all, whatever is required: if pins differ, others may have less spare
  std::optional<LeastDistance> first_violation = {};  ///< along the path, to within 0.1 degrees
  double flat_mm = 0;                                 ///< least distance of any two parts in the flat state

  const LeastDistance& least() const {
    return in_hinges.excess_mm() < elsewhere.excess_mm() ? in_hinges : elsewhere;
  }
};

/// Extent of a search for clearance.
enum class ClearanceSearch {
  least,            ///< until the least distance is known
  until_violation,  ///< like `least`, but stops at any parts that are too near: first_violation need not be the first
  verdict,          ///< only whether any parts come too near: the least distance is not searched
  verdict_of_posts,  ///< like `verdict`, of bodies with posts only: the sheet without posts has clearance
};

/// Checks whether a search leaves the least distance open.
inline bool is_verdict(ClearanceSearch search) {
  return search == ClearanceSearch::verdict || search == ClearanceSearch::verdict_of_posts;
}

/// Computes distances of the solids' convex pieces from flat to the fold. The method is that of Gilbert, Johnson and
/// Keerthi, Bullet's in double precision. It checks the flat state, the fold and as many states between as the proof
/// needs. No two parts come nearer than what is returned by more than 0.005 mm (model::min_gap, PrintMotion). A rod
/// and its bore are compared by their axes, as both are round.
/// Two bodies that share a pin must keep its clearance. Two others must keep the least clearance of the pins at
/// either. They may not collide if neither has a pin. Soft parts may not collide with other parts. A soft part is the
/// convex hull of its two ends. Its own two bodies do not count.
PathClearance path_clearance(const PrintSheet& sheet, ClearanceSearch search = ClearanceSearch::least);

/// Checks whether all parts keep their required distance.
bool has_required_clearance(const PathClearance& clearance);

/// Returns a part's name for messages. @param part of a LeastDistance
std::string part_name(const PrintSheet& sheet, int part);

}  // namespace kinetix::app
