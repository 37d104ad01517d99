#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/lattice/square/family/fold_angles.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Exact motion of nets: panels of cells joined by creases along x and along y, all folded by one theta
/// (family F4 of kinematics.md section 2).
///
/// Each body has a panel frame Q, the orientation its panel has as a whole, and turns in it about the panel's
/// normal by +theta (class A) or -theta (class B): R = Q Rz(+-theta). A wall of tilt beta with t = 1/2 and
/// alpha = 90 deg joins two frames by a turn about the line across it, Q' = Q Rot(y, phi) for x-walls,
/// Q' = Q Rot(x, -phi) for y-walls, tan(phi / 2) = +-tan(beta) sin(theta), + from a body of class A. Where
/// creases that bend cross, each has a fold angle theta_k of its own (model/lattice/square/family/fold_angles.hpp),
/// which stands in for theta: tan(phi / 2) = +-tan(beta) sin(theta_k), and the frames are turned about their
/// normals by +-(theta - theta_k) before and after it. So the pose of every body follows from that of a root
/// along a tree of walls; what closes the rest of the hinges are the rules of check_net
/// (model/lattice/square/family/net_rules.hpp).

/// Walls that lead from a root to every other body by as few walls as can be.
struct NetTree {
  struct Link {
    int body = 0;    ///< that the wall leads to
    int parent = 0;  ///< body it comes from
    int hinge = 0;
    int crease = 0;  ///< of the hinge, index in find_creases()
    int end = 0;     ///< the links behind this one are those from the next to before links[end]
  };
  int root = 0;             ///< body
  std::vector<Link> links;  ///< a parent before its children, what lies behind a link right after it
  FoldAngleTree angles;     ///< of the creases
};

/// @pre every body can be reached over walls, as make_structure has it
NetTree make_net_tree(const Structure& structure, int root = 0);

/// State at theta, rad: the root at its rest position, its panel unturned.
/// @pre the tree is of this structure; check_net(structure) finds nothing: otherwise hinges off the tree do
/// not close
State fold_net(const NetTree& tree, const Structure& structure, double theta);

/// How everything behind a link turns, as one rigid body, with the tilt of the link's wall and with the fold
/// angle of its crease.
struct NetTurn {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();     ///< rad per rad of the wall's tilt, theta_k as it is
  Eigen::Vector3d by_angle = Eigen::Vector3d::Zero();  ///< rad per rad of theta_k, theta as it is
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< on the fold line, mm
};

/// A state with its derivatives.
struct NetMotion {
  State state;
  std::vector<Twist> by_theta;   ///< of each body, rad and mm per rad
  std::vector<NetTurn> by_tilt;  ///< of each link; with the tilt of a crease that crosses none that bends, a
                                 ///< body turns about every link of the crease before it, by omega times
                                 ///< alternation of the link's wall (of any crease: twists_by_tilt)
};

/// fold_net() with its derivatives, at theta, rad.
NetMotion fold_net_with_jacobian(const NetTree& tree, const Structure& structure, double theta);

/// Twist of each body by the tilt of a crease (by alternation, as set_tilt takes it), rad and mm per rad:
/// what fold_net does, whether or not the structure still is a net with that tilt changed alone.
/// @param motion fold_net_with_jacobian of the same structure at theta   @param crease index in find_creases()
std::vector<Twist> twists_by_tilt(const NetTree& tree, const Structure& structure, const NetMotion& motion,
                                  double theta, int crease);

}  // namespace kinetix::model
