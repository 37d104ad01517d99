#include "model/lattice/square/family/net.hpp"

#include "model/base/algorithms.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Neighbour {
  int body, hinge;
};

std::vector<std::vector<Neighbour>> neighbours(const Structure& structure) {
  std::vector<std::vector<Neighbour>> out(structure.bodies.size());
  for (std::size_t h = 0; h < structure.hinges.size(); ++h) {
    const Hinge& hinge = structure.hinges[h];
    out[hinge.lower].push_back({hinge.upper, static_cast<int>(h)});
    out[hinge.upper].push_back({hinge.lower, static_cast<int>(h)});
  }
  return out;
}

/// Returns the links from each body to its children, breadth first.
std::vector<std::vector<NetTree::Link>> children(const Structure& structure, const Creases& creases,
                                                 int root) {
  const auto near = neighbours(structure);
  std::vector<std::vector<NetTree::Link>> out(near.size());
  std::vector<bool> found(near.size(), false);
  std::vector<int> queue = {root};
  found[root] = true;
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (const Neighbour& n : near[queue[k]]) {
      if (found[n.body]) continue;
      found[n.body] = true;
      queue.push_back(n.body);
      out[queue[k]].push_back({n.body, queue[k], n.hinge, creases.of_hinge[n.hinge], 0});
    }
  return out;
}

/// Turn about x or y: the fold line of a crease in panel frames.
struct FoldLine {
  Vector3d axis;  ///< in the panel frame
  double turn;    ///< rad, about it
  double by_tilt, by_theta;
};

FoldLine fold_line(const Structure& structure, const NetTree::Link& link, double theta) {
  const Hinge& hinge = structure.hinges[link.hinge];
  const bool along_x = hinge.wall.axis == Axis::x;
  const double sense = structure.bodies[link.parent].sense() * (along_x ? 1.0 : -1.0);
  const double tilt = hinge.parameters.beta;
  const CreaseDerivatives derivatives = crease_derivatives(tilt, theta);
  return {along_x ? Vector3d::UnitY() : Vector3d::UnitX(), sense * crease_turn(tilt, theta),
          sense * derivatives.by_tilt, sense * derivatives.by_theta};
}

Matrix3d turned_about(const Vector3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d turn;
  if (axis.x() != 0)
    turn << 1, 0, 0, 0, c, -s, 0, s, c;
  else
    turn << c, 0, s, 0, 1, 0, -s, 0, c;
  return turn;
}

Matrix3d in_panel(Vertex v, double theta) {
  const double c = std::cos(theta), s = v.sense() * std::sin(theta);
  Matrix3d turn;
  turn << c, -s, 0, s, c, 0, 0, 0, 1;
  return turn;
}

/// Vectors from the parent's position to the hinge, and from there to the body, in rest directions, mm.
struct Arms {
  Vector3d parent, body;
};

Arms arms(const Structure& structure, const NetTree::Link& link) {
  const Hinge& hinge = structure.hinges[link.hinge];
  const bool forward = hinge.lower == link.parent;
  const double t = forward ? hinge.parameters.t : 1 - hinge.parameters.t;
  const Vector3d edge = (forward ? 1 : -1) * structure.size.edge_mm * edge_direction(hinge.wall.axis);
  return {t * edge, (1 - t) * edge};
}

std::vector<FoldAngle> fold_angles(const NetTree& tree, const Structure& structure, double theta) {
  std::vector<FoldAngle> angles;
  for (const double shift : fold_shifts(tree.angles, structure)) angles.push_back(fold_angle(theta, shift));
  return angles;
}

/// Returns a frame turned by the difference of theta and a crease's fold angle. @param v vertex of the body before
/// the fold
Matrix3d with_lead(const Matrix3d& frame, Vertex v, double theta, double own) {
  return own == theta ? frame : Matrix3d(frame * in_panel(v, theta - own));
}

std::vector<Matrix3d> panel_frames(const NetTree& tree, const Structure& structure, double theta,
                                   const std::vector<FoldAngle>& angles) {
  std::vector<Matrix3d> Q(structure.bodies.size(), Matrix3d::Identity());
  for (const NetTree::Link& link : tree.links) {
    const double own = angles[link.crease].value;
    const FoldLine line = fold_line(structure, link, own);
    Matrix3d& frame = Q[link.body] = with_lead(Q[link.parent], structure.bodies[link.parent], theta, own);
    if (line.turn != 0) frame = frame * turned_about(line.axis, line.turn);
    frame = with_lead(frame, structure.bodies[link.parent], theta, own);
  }
  return Q;
}

State fold_frames(const NetTree& tree, const Structure& structure, double theta,
                  const std::vector<Matrix3d>& Q) {
  State state(structure.bodies.size());
  for (std::size_t b = 0; b < state.size(); ++b) state[b].R = Q[b] * in_panel(structure.bodies[b], theta);
  state[tree.root].p = structure.rest_position(tree.root);
  for (const NetTree::Link& link : tree.links) {
    const Arms arm = arms(structure, link);
    state[link.body].p =
        state[link.parent].p + state[link.parent].R * arm.parent + state[link.body].R * arm.body;
  }
  return state;
}

}  // namespace

NetTree make_net_tree(const Structure& structure, int root) {
  const Creases creases = find_creases(structure);
  const auto below = children(structure, creases, root);
  NetTree tree{root, {}, make_fold_angle_tree(structure, creases)};
  tree.links.reserve(below.size());
  // Holds links to be entered, and links to be closed as -1 - index.
  std::vector<std::pair<NetTree::Link, int>> stack;
  const auto push = [&](int body) {
    for (auto link = below[body].rbegin(); link != below[body].rend(); ++link) stack.push_back({*link, -1});
  };
  push(root);
  while (!stack.empty()) {
    const auto [link, entered] = stack.back();
    stack.pop_back();
    if (entered >= 0) {
      tree.links[entered].end = static_cast<int>(tree.links.size());
      continue;
    }
    stack.push_back({link, static_cast<int>(tree.links.size())});
    tree.links.push_back(link);
    push(link.body);
  }
  return tree;
}

State fold_net(const NetTree& tree, const Structure& structure, double theta) {
  return fold_frames(tree, structure, theta,
                     panel_frames(tree, structure, theta, fold_angles(tree, structure, theta)));
}

NetMotion fold_net_with_jacobian(const NetTree& tree, const Structure& structure, double theta) {
  const std::vector<FoldAngle> angles = fold_angles(tree, structure, theta);
  const std::vector<Matrix3d> Q = panel_frames(tree, structure, theta, angles);
  NetMotion motion{fold_frames(tree, structure, theta, Q), std::vector<Twist>(Q.size()), {}};
  motion.by_tilt.reserve(tree.links.size());
  std::vector<Vector3d> panel_rate(Q.size(), Vector3d::Zero());
  const auto spin = [&](int body) -> Vector3d {
    return panel_rate[body] + structure.bodies[body].sense() * Q[body].col(2);
  };
  motion.by_theta[tree.root].omega = spin(tree.root);
  for (const NetTree::Link& link : tree.links) {
    const FoldAngle& own = angles[link.crease];
    const FoldLine line = fold_line(structure, link, own.value);
    const Vertex from_vertex = structure.bodies[link.parent];
    const Vector3d axis = with_lead(Q[link.parent], from_vertex, theta, own.value) * line.axis;
    const Vector3d normals = from_vertex.sense() * (Q[link.parent].col(2) + Q[link.body].col(2));
    const Arms arm = arms(structure, link);
    const Vector3d from = motion.state[link.parent].R * arm.parent, to = motion.state[link.body].R * arm.body;
    panel_rate[link.body] =
        panel_rate[link.parent] + own.by_theta * line.by_theta * axis + (1 - own.by_theta) * normals;
    Twist& twist = motion.by_theta[link.body];
    const Twist& parent = motion.by_theta[link.parent];
    twist.omega = spin(link.body);
    twist.v = parent.v + parent.omega.cross(from) + twist.omega.cross(to);
    motion.by_tilt.push_back(
        {line.by_tilt * axis, line.by_theta * axis - normals, motion.state[link.parent].p + from});
  }
  return motion;
}

std::vector<Twist> twists_by_tilt(const NetTree& tree, const Structure& structure, const NetMotion& motion,
                                  double theta, int crease) {
  const std::vector<double> shifts = fold_shifts(tree.angles, structure),
                            derivatives = fold_shift_gradient(tree.angles, structure, crease);
  std::vector<Twist> twists(structure.bodies.size());
  for (std::size_t k = 0; k < tree.links.size(); ++k) {
    const NetTree::Link& link = tree.links[k];
    const NetTurn& turn = motion.by_tilt[k];
    Vector3d omega =
        fold_angle(theta, shifts[link.crease]).by_shift * derivatives[link.crease] * turn.by_angle;
    if (link.crease == crease) omega += alternation(structure.hinges[link.hinge].wall) * turn.omega;
    if (omega.isZero(0)) continue;
    for (int m = static_cast<int>(k); m < link.end; ++m) {
      const int body = tree.links[m].body;
      twists[body].omega += omega;
      twists[body].v += omega.cross(motion.state[body].p - turn.point);
    }
  }
  return twists;
}

namespace {

/// Tilt, and fraction at sublattice A, of most walls of a crease.
struct CreaseParameters {
  double tilt = 0, t = 0.5;
};

double fraction_of(const Hinge& hinge) { return fraction_from_lower(hinge.parameters.t, hinge.wall.from); }

CreaseParameters parameters_of(const Structure& structure, const Crease& crease) {
  std::vector<double> tilts, fractions;
  for (const int h : crease.hinges) {
    tilts.push_back(tilt_in_crease(structure.hinges[h]));
    fractions.push_back(fraction_of(structure.hinges[h]));
  }
  return {lower_median(std::move(tilts)), lower_median(std::move(fractions))};
}

class Rules {
 public:
  Rules(const Structure& structure, double tolerance)
      : structure_(structure), tolerance_(tolerance), creases_(find_creases(structure)) {
    for (const Crease& crease : creases_.list) parameters_.push_back(parameters_of(structure, crease));
    is_beside_bend_.resize(creases_.list.size(), false);
    is_hindered_.resize(creases_.list.size(), false);
    for (std::size_t c = 0; c < structure.cells.size(); ++c) examine(c);
  }

  std::string broken_by(const Hinge& hinge, int index) const {
    const int crease = creases_.of_hinge[index];
    const CreaseParameters& own = parameters_[crease];
    if (!same(hinge.parameters.alpha, pi / 2)) return "exact motion needs alpha = 90 deg";
    if (!same(hinge.parameters.offset, 0)) return off_the_wall;
    if (!same(tilt_in_crease(hinge), own.tilt))
      return "all tilts of a crease must be equal, with the sign alternating along it";
    if (!same(fraction_of(hinge), own.t))
      return "all hinges of a column (or row) of walls must give the same fraction to their vertex of "
             "sublattice A";
    if (folds(own) && !same(own.t, 0.5)) return "a crease that bends needs t = 1/2";
    if (is_hindered_[crease])
      return "a crease cannot cross another that bends where four cells meet, unless their two columns or "
             "their two rows have one tilt";
    if (is_beside_bend_[crease] && !same(own.t, 0.5)) return "walls beside a crease that bends need t = 1/2";
    return {};
  }

 private:
  bool same(double a, double b) const { return std::abs(a - b) <= tolerance_; }
  bool folds(const CreaseParameters& p) const { return !same(p.tilt, 0); }

  const CreaseParameters& of(int hinge) const { return parameters_[creases_.of_hinge[hinge]]; }

  void examine(std::size_t index) {
    const auto& hinges = structure_.cell_members[index].hinges;
    const bool x_folds = folds(of(hinges[0])), y_folds = folds(of(hinges[1]));
    if (y_folds) is_beside_bend_[creases_.of_hinge[hinges[0]]] = true;
    if (x_folds) is_beside_bend_[creases_.of_hinge[hinges[1]]] = true;
    if (!x_folds || !y_folds || !is_in_hindered_block(structure_.cells[index])) return;
    for (const int k : {0, 1}) is_hindered_[creases_.of_hinge[hinges[k]]] = true;
  }

  bool is_in_hindered_block(const Cell& cell) const {
    for (const int di : {-1, 1})
      for (const int dj : {-1, 1})
        if (is_hindered(cell, {cell.i + di, cell.j + dj})) return true;
    return false;
  }

  /// Returns true if the four cells between two opposite ones exist and cannot move together.
  bool is_hindered(const Cell& a, const Cell& b) const {
    const auto near = hinges_of(a), far = hinges_of(b);
    if (!near || !far || !hinges_of({a.i, b.j}) || !hinges_of({b.i, a.j})) return false;
    return !same(of((*near)[0]).tilt, of((*far)[0]).tilt) && !same(of((*near)[1]).tilt, of((*far)[1]).tilt);
  }

  std::optional<std::array<int, 4>> hinges_of(const Cell& cell) const {
    const auto at = std::lower_bound(structure_.cells.begin(), structure_.cells.end(), cell);
    if (at == structure_.cells.end() || *at != cell) return {};
    return structure_.cell_members[at - structure_.cells.begin()].hinges;
  }

  const Structure& structure_;
  double tolerance_;
  Creases creases_;
  std::vector<CreaseParameters> parameters_;
  std::vector<bool> is_beside_bend_;  ///< per crease: it runs through a cell of a crease that bends
  std::vector<bool> is_hindered_;     ///< per crease: it and one that crosses it bend, which is impossible
};

/// Returns a hinge that opens during the motion, or -1. The axes count too, because aligned fold lines keep hinge
/// points together for any tilts.
int open_hinge(const Structure& structure, double tolerance) {
  const NetTree tree = make_net_tree(structure);
  const double allowed = tolerance * static_cast<double>(structure.bodies.size());
  for (const double theta : probe_thetas) {
    const HingeGaps gaps = hinge_gaps(structure, fold_net(tree, structure, theta));
    if (!(gaps.max <= allowed)) return gaps.worst_hinge;
    if (!(gaps.axis_max <= allowed)) return gaps.worst_axis;
  }
  return -1;
}

}  // namespace

NetCheck check_net(const Structure& structure, double tolerance) {
  const Rules rules(structure, tolerance);
  NetCheck check;
  for (std::size_t h = 0; h < structure.hinges.size(); ++h) {
    std::string rule = rules.broken_by(structure.hinges[h], static_cast<int>(h));
    if (rule.empty()) continue;
    if (check.broken++ > 0) continue;
    check.breaking_hinge = static_cast<int>(h);
    check.rule = std::move(rule);
  }
  if (check.broken > 0) return check;
  const int open = open_hinge(structure, tolerance);
  if (open >= 0)
    return {1, open,
            "creases around a hole must let it close: equal if they are in line, and not crossing in it"};
  return check;
}

}  // namespace kinetix::model
