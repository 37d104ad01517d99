#pragma once

#include <array>
#include <vector>

#include "model/linkage/linkage.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Which of the six coordinates of each body (rad and cell edges, as model/closure/closure.hpp orders them)
/// an equilibrium solves for.
struct DofMap {
  std::vector<std::array<int, 6>> unknown;  ///< of each body; -1 where the coordinate is held or driven
  int count = 0;

  Eigen::Index coordinates() const { return 6 * static_cast<Eigen::Index>(unknown.size()); }
  /// The entries of a vector over all coordinates that are unknowns, and back (zero elsewhere).
  Eigen::VectorXd restrict(const Eigen::VectorXd& all) const;
  Eigen::VectorXd extend(const Eigen::VectorXd& unknowns) const;
};

/// Planar: one turn and two shifts a body. Plates prescribe one coordinate of the bodies they grip, and the
/// middle body of each is keyed to z = 0 as in the physics run; what rigid motion is left is held at the
/// first of these two, where it meets no force. Any other drive, and none: LinkageDrive::held_body().
DofMap make_dof_map(const Linkage& structure, const LinkageDrive& drive, bool planar);

}  // namespace kinetix::model
