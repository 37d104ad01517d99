#pragma once

#include <optional>
#include <string>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// The distance of two parts that leaves least over what it must be.
struct LeastDistance {
  double mm = 0;                ///< negative: how deep they are in each other, mm
  int first = -1, second = -1;  ///< parts: bodies, then blocks and films by hinge; -1: there are no two
  double theta = 0;             ///< rad
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< between them, in the state at theta, mm
  double asked_mm =
      0;  ///< what has to be left: a pin's clearance; of blocks and films 0: they may not run into others

  /// What is left over what has to be, but for 0.01 mm of the circles' polygons, mm; negative: too near.
  double spare_mm() const;
};

/// What is left between the solids from flat to the fold.
struct PathClearance {
  LeastDistance in_hinges;  ///< of two bodies that share a hinge, mm
  LeastDistance elsewhere;  ///< of all other parts, mm
  LeastDistance nearest;    ///< of all, whatever they must keep: where pins differ, others have less to spare
  std::optional<LeastDistance> first_too_near = {};  ///< on the way, to within 0.1 degrees
  double flat_mm = 0;                                ///< least distance of any two parts in the flat state

  const LeastDistance& least() const {
    return in_hinges.spare_mm() < elsewhere.spare_mm() ? in_hinges : elsewhere;
  }
};

/// How far parts are looked at.
enum class ClearanceLook {
  least,       ///< until it is known how near parts come
  until_near,  ///< the same, but stops at any two parts that come too near: first_too_near need not be the first
  verdict,     ///< until it is known whether any come too near: what is left elsewhere is not looked for
};

/// Distances of the solids' convex pieces (Gilbert, Johnson and Keerthi's method, Bullet's in double precision) from flat to the
/// fold, flat and folded and wherever between it takes to prove that no two parts come nearer than what is returned, but for
/// 0.005 mm (model::least_gap, PrintMotion). A rod and its bore are compared by their axes, as both are round. Two bodies that
/// share a pin must keep its clearance, two others the least of the pins at either; where neither has one, and of blocks and
/// films, they may not run into each other. A block or film is the convex hull of its two ends; its own two bodies do not count.
PathClearance path_clearance(const PrintSheet& sheet, ClearanceLook look = ClearanceLook::least);

/// Whether all is left that was asked.
bool is_kept(const PathClearance& clearance);

/// As messages name it. @param part of a LeastDistance
std::string part_name(const PrintSheet& sheet, int part);

}  // namespace kinetix::app
