#pragma once

#include <array>
#include <vector>

#include "model/linkage/linkage.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Unknowns of an equilibrium among the six coordinates of each body (rad and cell edges, ordered as in
/// model/closure/closure.hpp).
struct DofMap {
  std::vector<std::array<int, 6>> unknown;  ///< of each body; -1 if the coordinate is held or driven
  int count = 0;

  Eigen::Index coordinates() const { return 6 * static_cast<Eigen::Index>(unknown.size()); }
  /// Returns the entries of a vector over all coordinates that are unknowns.
  Eigen::VectorXd restrict(const Eigen::VectorXd& all) const;
  /// Returns the vector over all coordinates with the given unknowns, zero elsewhere.
  Eigen::VectorXd extend(const Eigen::VectorXd& unknowns) const;
};

/// Numbers the unknowns. Planar bodies have one turn and two shifts. Plates prescribe one coordinate of the
/// bodies they grip. The middle body of each gripped row is keyed to z = 0, as in the simulation. The
/// remaining rigid motion is held at the first of these two, without reaction force. For other drives, or
/// none, it is held at LinkageDrive::held_body().
DofMap make_dof_map(const Linkage& structure, const LinkageDrive& drive, bool planar);

}  // namespace kinetix::model
