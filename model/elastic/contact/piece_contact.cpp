#include "model/elastic/contact/piece_contact.hpp"

#include <algorithm>
#include <cmath>

#include "model/elastic/contact/point_gap.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Cell edges: a wider margin lists more pairs, a narrower one needs new searches more often.
constexpr double listed_margin = 0.3;
// Cell edges: the chord of a point's path may cut a corner by this much although the path itself goes around
// it.
constexpr double cut_corner = 0.02;

bool has_same_poses(const State& a, const State& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pose& x, const Pose& y) { return x.p == y.p && x.R == y.R; });
}

Vector3d carried(const Pose& pose, const Vector3d& p) { return pose.R * p + pose.p; }

/// Part of a straight path inside a piece, as fractions of the path, and the face by which it enters.
struct WayInside {
  double from = 0, to = 1;  // dimensionless, [0, 1]
  int entry = -1;

  WayInside(const PieceSurface& piece, const Vector3d& start, const Vector3d& end) {
    for (int f = 0; f < piece.faces.rows(); ++f) {
      const double a = piece.gap(f, start), b = piece.gap(f, end);
      if (a >= 0 && b >= 0) to = -1;
      if (a >= 0 && b < 0 && a / (a - b) > from) {
        from = a / (a - b);
        entry = f;
      }
      if (a < 0 && b >= 0) to = std::min(to, a / (a - b));
    }
  }
};

}  // namespace

PieceContact::PieceContact(const ConvexBodies& bodies, double edge_mm)
    : edge_mm_(edge_mm), surfaces_(piece_surfaces(bodies, edge_mm)), passing_(bodies.passing) {
  for (const PieceSurface& piece : surfaces_) {
    largest_ = std::max(largest_, piece.radius);
    if (static_cast<int>(reach_.size()) <= piece.body) reach_.resize(piece.body + 1, 0);
    for (const Vector3d& corner : piece.corners)
      reach_[piece.body] = std::max(reach_[piece.body], corner.norm());
  }
}

bool PieceContact::may_touch(const PiecePair& pair) const {
  return surfaces_[pair.first].body != surfaces_[pair.second].body &&
         !std::binary_search(passing_.begin(), passing_.end(), pair);
}

std::vector<double> PieceContact::moved(const State& from, const State& to) const {
  std::vector<double> out;
  for (std::size_t b = 0; b < reach_.size(); ++b)
    out.push_back((to[b].p - from[b].p).norm() / edge_mm_ +
                  reach_[b] * (to[b].R - from[b].R).norm() / std::sqrt(2.0));
  return out;
}

bool PieceContact::has_left(const State& state) const {
  if (near_state_.size() != state.size()) return true;
  const std::vector<double> by = moved(near_state_, state);
  return !std::all_of(by.begin(), by.end(), [](double m) { return m <= listed_margin / 2; });
}

std::vector<PieceContact::PiecePair> PieceContact::pairs_within(const State& state,
                                                                const std::vector<double>& margins) {
  const double most = *std::max_element(margins.begin(), margins.end());
  Eigen::Matrix3Xd centers(3, surfaces_.size());
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    const Pose& pose = state[surfaces_[k].body];
    centers.col(static_cast<Eigen::Index>(k)) = pose.p / edge_mm_ + pose.R * surfaces_[k].center;
  }
  std::vector<PiecePair> out;
  for (const auto& [i, k] : finder_.find(centers, 2 * (largest_ + most))) {
    const PieceSurface &a = surfaces_[i], &b = surfaces_[k];
    const double near = a.radius + b.radius + margins[a.body] + margins[b.body];
    if ((centers.col(i) - centers.col(k)).squaredNorm() < near * near && may_touch({i, k}))
      out.emplace_back(i, k);
  }
  std::sort(out.begin(), out.end());
  return out;
}

Pose PieceContact::seen_from(int other, int piece, const State& state) const {
  const Pose &own = state[surfaces_[piece].body], &frame = state[surfaces_[other].body];
  Pose out;
  out.R = frame.R.transpose() * own.R;
  out.p = frame.R.transpose() * (own.p - frame.p) / edge_mm_;
  return out;
}

/// Returns whether a face of `other` separates the pieces. Pieces that only a pair of edges separates have no
/// points in each other either.
bool PieceContact::are_apart(int piece, int other, const State& state) const {
  const PieceSurface &own = surfaces_[piece], &faces = surfaces_[other];
  const Pose pose = seen_from(other, piece, state);
  for (int f = 0; f < faces.faces.rows(); ++f) {
    const Vector3d n = pose.R.transpose() * faces.faces.row(f).head<3>().transpose();
    const double offset = -faces.gap(f, pose.p);
    if (std::all_of(own.corners.begin(), own.corners.end(),
                    [&](const Vector3d& c) { return n.dot(c) >= offset; }))
      return true;
  }
  return false;
}

void PieceContact::add_points_inside(int piece, int other, const State& state) {
  const PieceSurface &own = surfaces_[piece], &in = surfaces_[other];
  const Pose pose = seen_from(other, piece, state);
  for (std::size_t k = 0; k < own.points.size(); ++k) {
    const Vector3d p = carried(pose, own.points[k].at);
    if (!((p - in.center).squaredNorm() < in.radius * in.radius) || !(in.outside(p) < 0)) continue;
    if (const int face = in.nearest_face(p); face >= 0)
      found_.push_back({piece, static_cast<int>(k), other, face, -in.gap(face, p)});
  }
}

const std::vector<PieceTouch>& PieceContact::find(const State& state) {
  if (has_same_poses(state, found_state_)) return found_;
  found_.clear();
  found_state_ = state;
  if (!is_finite(state) || surfaces_.empty()) return found_;
  if (has_left(state)) {
    near_ = pairs_within(state, std::vector<double>(reach_.size(), listed_margin / 2));
    near_state_ = state;
  }
  for (const auto& [i, k] : near_) {
    if (are_apart(i, k, state) || are_apart(k, i, state)) continue;
    add_points_inside(i, k, state);
    add_points_inside(k, i, state);
  }
  return found_;
}

bool PieceContact::went_through(int piece, int other, const State& before, const State& after) const {
  const PieceSurface &own = surfaces_[piece], &in = surfaces_[other];
  const Pose first = seen_from(other, piece, before), last = seen_from(other, piece, after);
  return std::any_of(own.points.begin(), own.points.end(), [&](const SurfacePoint& point) {
    const Vector3d start = carried(first, point.at), end = carried(last, point.at);
    const WayInside inside(in, start, end);
    if (!(inside.from < inside.to) || inside.entry < 0) return false;
    const double deep = inside.to < 1 ? (inside.from + inside.to) / 2 : 1;
    const Vector3d p = start + deep * (end - start);
    return -in.outside(p) > cut_corner && (inside.to < 1 || in.nearest_face(p) != inside.entry);
  });
}

bool PieceContact::passed_through(const State& before, const State& after) {
  if (surfaces_.empty()) return false;
  const auto pairs = pairs_within(before, moved(before, after));
  return std::any_of(pairs.begin(), pairs.end(), [&](const PiecePair& pair) {
    return went_through(pair.first, pair.second, before, after) ||
           went_through(pair.second, pair.first, before, after);
  });
}

Element PieceContact::element(const PieceTouch& touch, double stiffness, const State& state) const {
  const PieceSurface &own = surfaces_[touch.piece], &in = surfaces_[touch.other];
  const Pose &pose = state[own.body], &frame = state[in.body];
  const SurfacePoint& point = own.points[touch.point];
  PointGap gap;
  gap.n = frame.R * in.faces.row(touch.face).head<3>().transpose();
  gap.a = pose.R * point.at;
  gap.m = (pose.p - frame.p) / edge_mm_ + gap.a;
  gap.value = gap.n.dot(gap.m) - in.faces(touch.face, 3);
  return gap.pressed(point.weight * stiffness);
}

double PieceContact::energy(const std::vector<PieceTouch>& touches, double stiffness) const {
  double sum = 0;
  for (const PieceTouch& t : touches)
    sum += 0.5 * surfaces_[t.piece].points[t.point].weight * stiffness * t.depth * t.depth;
  return sum;
}

}  // namespace kinetix::model
