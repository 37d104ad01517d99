#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/state.hpp"

namespace kinetix {

/// Exact motion of nets: flat panels of basic cells, joined by creases along x and along y, all folded by one
/// theta (family F4 of kinematics.md section 2).
///
/// Each body has a panel frame Q, the orientation its panel has as a whole, and turns in it about the panel's
/// normal by +theta (class A) or -theta (class B): R = Q Rz(+-theta). A wall of tilt beta with t = 1/2 and
/// alpha = 90 deg joins two frames by a turn about the line across it, Q' = Q Rot(y, phi) for x-walls,
/// Q' = Q Rot(x, -phi) for y-walls, tan(phi / 2) = +-tan(beta) sin(theta), + from a body of class A. So the
/// pose of every body follows from that of a root along a tree of walls; what closes the rest of the hinges
/// are the rules of check_net (model/net_rules.hpp).

/// Walls that lead from a root to every other body by as few walls as can be.
struct NetTree {
  struct Link {
    int body = 0;    ///< that the wall leads to
    int parent = 0;  ///< body it comes from
    int hinge = 0;
    int end = 0;  ///< the links behind this one are those from the next to before links[end]
  };
  int root = 0;             ///< body
  std::vector<Link> links;  ///< a parent before its children, what lies behind a link right after it
};

/// @pre every body can be reached over walls, as make_structure has it
NetTree make_net_tree(const Structure& structure, int root = 0);

/// State at theta, rad: the root at its rest position, its panel unturned.
/// @pre the tree is of this structure; check_net(structure) finds nothing: otherwise hinges off the tree do
/// not close
State fold_net(const NetTree& tree, const Structure& structure, double theta);

/// How everything behind a link turns, as one rigid body, with the tilt of the link's wall.
struct NetTurn {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();  ///< rad per rad of the wall's tilt
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on the fold line, mm
};

/// A state with its derivatives.
struct NetMotion {
  State state;
  std::vector<Twist> by_theta;   ///< of each body, rad and mm per rad
  std::vector<NetTurn> by_tilt;  ///< of each link; with the tilt of a crease a body turns about every link of
                                 ///< the crease before it, times alternation of the link's wall
};

NetMotion fold_net_with_rates(const NetTree& tree, const Structure& structure, double theta);

}  // namespace kinetix
