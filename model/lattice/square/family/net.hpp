#pragma once

#include "model/lattice/square/family/fold_angles.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Exact motion of nets: panels of cells joined by creases along x and along y, all folded by one theta
/// (family F4 of kinematics.md section 2).
///
/// Each body has a panel frame Q, the orientation of its panel as a whole. It turns in the frame about the panel's
/// normal by +theta (sublattice A) or -theta (B): R = Q Rz(+-theta). A wall of tilt beta with t = 1/2 and alpha = 90
/// deg joins two frames. The joint is a turn about the line across the wall:
///     Q' = Q Rot(y, phi) for x-walls, Q' = Q Rot(x, -phi) for y-walls, tan(phi / 2) = +-tan(beta) sin(theta).
/// The sign is + from a body of sublattice A.
///
/// If creases that bend cross, each has a fold angle theta_k (model/lattice/square/family/fold_angles.hpp), which
/// replaces theta: tan(phi / 2) = +-tan(beta) sin(theta_k). The frames then turn about their normals by +-(theta -
/// theta_k) before and after it.
///
/// The pose of every body follows from that of a root along a tree of walls. The rules of check_net
/// (model/lattice/square/family/net.hpp) close the other hinges.

/// Tree of walls from a root to every other body, with the fewest walls to each.
struct NetTree {
  struct Link {
    int body = 0;    ///< body that the wall leads to
    int parent = 0;  ///< body at the start of the wall
    int hinge = 0;
    int crease = 0;  ///< crease of the hinge, index in find_creases()
    int end = 0;     ///< the links behind this one are from the next one to before links[end]
  };
  int root = 0;             ///< body
  std::vector<Link> links;  ///< a parent before its children; links behind a link follow it directly
  FoldAngleTree angles;     ///< fold angles of the creases
};

/// Creates the tree. @pre every body can be reached over walls, as in a result of make_structure
NetTree make_net_tree(const Structure& structure, int root = 0);

/// Returns the state at theta, rad: the root at its rest position, its panel unturned.
/// @pre the tree is of this structure; check_net(structure) finds no broken rule: otherwise hinges off the tree do
/// not close
State fold_net(const NetTree& tree, const Structure& structure, double theta);

/// Turn of everything behind a link, as one rigid body, by the tilt of the link's wall and by the fold angle of its
/// crease.
struct NetTurn {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();     ///< rad per rad of the wall's tilt at constant theta_k
  Eigen::Vector3d by_angle = Eigen::Vector3d::Zero();  ///< rad per rad of theta_k at constant theta
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< point on the fold line, mm
};

/// A state with its derivatives.
struct NetMotion {
  State state;
  std::vector<Twist> by_theta;   ///< per body, rad and mm per rad
  std::vector<NetTurn> by_tilt;  ///< per link; see twists_by_tilt()
};

/// Computes fold_net() with its derivatives, at theta, rad.
NetMotion fold_net_with_jacobian(const NetTree& tree, const Structure& structure, double theta);

/// Returns the twist of each body by the tilt of a crease, rad and mm per rad. The tilt alternates as in set_tilt. It
/// is the derivative of fold_net, even if the structure is not a net after a change of only that tilt. For a crease
/// that crosses none that bends, a body turns about every link of the crease before it: by omega times alternation of
/// the link's wall.
/// @param motion fold_net_with_jacobian of the same structure at theta   @param crease index in find_creases()
std::vector<Twist> twists_by_tilt(const NetTree& tree, const Structure& structure, const NetMotion& motion,
                                  double theta, int crease);

/// Result of the test for a net (model/lattice/square/family/net.hpp).
struct NetCheck {
  std::size_t broken = 0;   ///< number of hinges that break a rule; 0 for a net
  int breaking_hinge = -1;  ///< the first of them
  std::string rule;         ///< rule that this hinge breaks
};

/// Tests the rules of family F4:
/// - Every hinge has alpha = 90 deg.
/// - The walls of a crease have one tilt of alternating sign, and one fraction at their vertices of sublattice A.
/// - A crease with a tilt has t = 1/2, and so have the walls next to it in its cells.
/// - Creases with a tilt may cross if in every block of 2 x 2 cells the columns or the rows have one tilt
/// (model/lattice/square/family/fold_angles.hpp).
/// - The hinges around every hole close, as computed along the motion. Creases in line with each other need one tilt,
/// and may not cross in the hole.
///
/// The rules are also necessary for structures of alpha = 90 deg and t = 1/2 that are connected by walls. Without
/// holes, a sheet that breaks a rule is rigid or moves only to first order.
/// @param tolerance on fractions (absolute) and angles (rad)
NetCheck check_net(const Structure& structure, double tolerance = 1e-9);

}  // namespace kinetix::model
