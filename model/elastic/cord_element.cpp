#include "model/elastic/cord_element.hpp"

#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

constexpr double together = 1e-9;  // cell edges: closer points have no meaningful direction

/// Straight piece of a tendon between two points.
struct Piece {
  Vector3d direction = Vector3d::Zero();
  Matrix3d curvature = Matrix3d::Zero();  ///< second derivative of its length by its vector, 1 / cell edges
};

Piece piece_along(const Vector3d& vector) {
  const double length = vector.norm();
  if (!(length > together)) return {};
  const Vector3d n = vector / length;
  return {n, (Matrix3d::Identity() - n * n.transpose()) / length};
}

std::vector<Piece> pieces_of(const Linkage& linkage, const std::vector<int>& through, const State& state) {
  std::vector<Piece> pieces;
  for (std::size_t k = 1; k < through.size(); ++k)
    pieces.push_back(
        piece_along((hinge_point(linkage, through[k], state) - hinge_point(linkage, through[k - 1], state)) /
                    linkage.size.edge_mm));
  return pieces;
}

/// Contribution of one body to a hinge point, which is the mean of two bodies' points.
struct Carrier {
  int body;
  double weight;  ///< 0.5, with the sign of the point in the piece's vector
  Vector3d arm;   ///< to the point, turned with the body, cell edges

  Matrix36 jacobian() const {
    Matrix36 j;
    j << -weight * cross_matrix(arm), weight * Matrix3d::Identity();
    return j;
  }
};

/// Returns the carriers of both ends of a piece: two bodies per end.
std::array<Carrier, 4> carriers_of(const Linkage& linkage, int from, int to, const State& state) {
  const RestHinge &a = linkage.hinges[from], &b = linkage.hinges[to];
  return {{{a.lower, -0.5, state[a.lower].R * a.lower_arm},
           {a.upper, -0.5, state[a.upper].R * a.upper_arm},
           {b.lower, 0.5, state[b.lower].R * b.lower_arm},
           {b.upper, 0.5, state[b.upper].R * b.upper_arm}}};
}

std::vector<int> bodies_of(const Linkage& linkage, const std::vector<int>& through) {
  std::vector<int> bodies;
  for (const int h : through) bodies.insert(bodies.end(), {linkage.hinges[h].lower, linkage.hinges[h].upper});
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

void add(const Piece& piece, const std::array<Carrier, 4>& carriers, CordElement& cord) {
  const auto at = [&](int body) {
    return 6 * (std::lower_bound(cord.bodies.begin(), cord.bodies.end(), body) - cord.bodies.begin());
  };
  for (const Carrier& a : carriers) {
    const Eigen::Index row = at(a.body);
    const Matrix36 ja = a.jacobian();
    cord.gradient.segment<6>(row) += ja.transpose() * piece.direction;
    cord.hessian.block<3, 3>(row, row) += turning_hessian(a.weight * piece.direction, a.arm);
    for (const Carrier& b : carriers)
      cord.hessian.block<6, 6>(row, at(b.body)) += ja.transpose() * piece.curvature * b.jacobian();
  }
}

/// Returns the shift of a hinge point along twists of its two bodies, cell edges.
Vector3d point_along(const RestHinge& h, const State& state, const Eigen::VectorXd& twists) {
  const auto of = [&](int body, const Vector3d& arm) -> Vector3d {
    const Vector3d omega = twists.segment<3>(6 * body), shift = twists.segment<3>(6 * body + 3);
    return shift + omega.cross(state[body].R * arm);
  };
  return (of(h.lower, h.lower_arm) + of(h.upper, h.upper_arm)) / 2;
}

/// Shift of a hinge point if both arms change by `rest`, and the derivative of that shift along twists.
struct PointChange {
  Vector3d point, along;
};

PointChange point_change(const RestHinge& h, const Vector3d& rest, const State& state,
                         const Eigen::VectorXd& twists) {
  const Vector3d lower = state[h.lower].R * rest, upper = state[h.upper].R * rest;
  const Vector3d lower_turn = twists.segment<3>(6 * h.lower), upper_turn = twists.segment<3>(6 * h.upper);
  return {(lower + upper) / 2, (lower_turn.cross(lower) + upper_turn.cross(upper)) / 2};
}

}  // namespace

CordElement cord_element(const Linkage& linkage, const std::vector<int>& through, const State& state) {
  CordElement cord;
  cord.length = cord_length(linkage, through, state) / linkage.size.edge_mm;
  cord.bodies = bodies_of(linkage, through);
  const auto size = 6 * static_cast<Eigen::Index>(cord.bodies.size());
  cord.gradient.setZero(size);
  cord.hessian.setZero(size, size);
  const std::vector<Piece> pieces = pieces_of(linkage, through, state);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    add(pieces[k], carriers_of(linkage, through[k], through[k + 1], state), cord);
  return cord;
}

Eigen::VectorXd cord_gradient(const Linkage& linkage, const std::vector<int>& through, const State& state) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(state.size()));
  const std::vector<Piece> pieces = pieces_of(linkage, through, state);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (const Carrier& c : carriers_of(linkage, through[k], through[k + 1], state))
      all.segment<6>(6 * c.body) += c.jacobian().transpose() * pieces[k].direction;
  return all;
}

CordGradients cord_gradients(const Linkage& linkage, const std::vector<int>& through, const State& state,
                             const Eigen::VectorXd& twists) {
  const auto count = static_cast<Eigen::Index>(through.size());
  const std::vector<Piece> pieces = pieces_of(linkage, through, state);
  CordGradients derivatives{PointGradients::Zero(2, count), PointGradients::Zero(2, count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const RestHinge& h = linkage.hinges[through[k]];
    const Vector3d here = point_along(h, state, twists);
    Vector3d pull = Vector3d::Zero(),
             turned = Vector3d::Zero();  // derivative of the length by the point, and its change
    const auto take = [&](const Piece& piece, double sign, int other) {
      pull += sign * piece.direction;
      turned += piece.curvature * (here - point_along(linkage.hinges[through[other]], state, twists));
    };
    if (k > 0) take(pieces[k - 1], 1, static_cast<int>(k) - 1);
    if (k + 1 < count) take(pieces[k], -1, static_cast<int>(k) + 1);
    const Vector3d rests[] = {h.edge, h.across};
    for (int p = 0; p < 2; ++p) {
      const PointChange change = point_change(h, rests[p], state, twists);
      derivatives.length(p, k) = pull.dot(change.point);
      derivatives.along(p, k) = turned.dot(change.point) + pull.dot(change.along);
    }
  }
  return derivatives;
}

}  // namespace kinetix::model
