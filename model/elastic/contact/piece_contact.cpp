#include "model/elastic/contact/piece_contact.hpp"

#include <limits>
#include <set>
#include <span>

#include "model/elastic/contact/contact_plates.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double point_spacing = 0.1;    // cell edges: fine enough for contact between corners
constexpr int max_points_per_edge = 12;  // points along an edge: more would only crowd long edges
constexpr double one_plane = 1e-4;       // of the radius, and rad: same plane, for faces and corners
constexpr double just_outside = 1e-3;    // of the radius: distance at which the body's next piece is searched

/// Corners of a piece on one of its faces, in order around it; empty for slivers without a polygon.
using FacePolygon = std::vector<int>;

int points_in(double length) {
  return std::clamp(static_cast<int>(std::ceil(length / point_spacing)), 2, max_points_per_edge + 1);
}

/// Removes faces that lie in the plane of an earlier one.
Eigen::MatrixX4d distinct_faces(const Eigen::MatrixX4d& all, double radius) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < all.rows(); ++f)
    if (std::none_of(kept.begin(), kept.end(), [&](Eigen::Index k) {
          return (all.row(f) - all.row(k)).head<3>().norm() < one_plane &&
                 std::abs(all(f, 3) - all(k, 3)) < one_plane * radius;
        }))
      kept.push_back(f);
  Eigen::MatrixX4d out(kept.size(), 4);
  for (std::size_t k = 0; k < kept.size(); ++k) out.row(static_cast<Eigen::Index>(k)) = all.row(kept[k]);
  return out;
}

FacePolygon polygon_of(const PieceSurface& piece, int face) {
  FacePolygon polygon;
  Vector3d middle = Vector3d::Zero();
  for (int c = 0; c < static_cast<int>(piece.corners.size()); ++c)
    if (std::abs(piece.gap(face, piece.corners[c])) < one_plane * piece.radius) {
      polygon.push_back(c);
      middle += piece.corners[c];
    }
  if (polygon.size() < 3) return {};
  middle /= static_cast<double>(polygon.size());
  const Vector3d normal = piece.faces.row(face).head<3>();
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const auto angle = [&](int c) {
    const Vector3d arm = piece.corners[c] - middle;
    return std::atan2(v.dot(arm), u.dot(arm));
  };
  std::sort(polygon.begin(), polygon.end(), [&](int a, int b) { return angle(a) < angle(b); });
  return polygon;
}

void add_along_edge(PieceSurface& piece, const Vector3d& from, const Vector3d& to) {
  const int parts = points_in((to - from).norm());
  for (int k = 1; k < parts; ++k) piece.points.push_back({from + (to - from) * k / parts, 1.0 / (parts - 1)});
}

/// Corners of a face in its plane, along its longest edge and perpendicular to it.
struct FlatFace {
  Vector3d origin, u, v;  // cell edges; unit vectors
  std::vector<Vector2d> corners;

  FlatFace(const PieceSurface& piece, int face, const FacePolygon& polygon)
      : origin(piece.corners[polygon.front()]) {
    double longest = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector3d side = piece.corners[polygon[(k + 1) % polygon.size()]] - piece.corners[polygon[k]];
      if (side.norm() <= longest) continue;
      longest = side.norm();
      u = side.normalized();
    }
    v = Vector3d(piece.faces.row(face).head<3>()).cross(u).normalized();
    for (const int c : polygon) {
      const Vector3d arm = piece.corners[c] - origin;
      corners.emplace_back(u.dot(arm), v.dot(arm));
    }
  }

  /// Returns whether a point is inside. Corners are counter-clockwise seen from outside, as are u, v.
  bool holds(const Vector2d& p) const {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector2d side = corners[(k + 1) % corners.size()] - corners[k], arm = p - corners[k];
      if (side.x() * arm.y() - side.y() * arm.x() < 0) return false;
    }
    return true;
  }
};

/// Returns grid points over a face. They are the middles of grid cells, so that none lies on the face's
/// boundary.
std::vector<Vector3d> places_over(const FlatFace& face) {
  Eigen::AlignedBox2d box;
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& c : face.corners) {
    box.extend(c);
    middle += c / static_cast<double>(face.corners.size());
  }
  const int across = points_in(box.sizes().x()), high = points_in(box.sizes().y());
  std::vector<Vector3d> places;
  const auto add = [&](const Vector2d& p) {
    places.push_back(face.origin + p.x() * face.u + p.y() * face.v);
  };
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < high; ++k) {
      const Vector2d share((i + 0.5) / across, (k + 0.5) / high);
      if (const Vector2d p = box.min() + share.cwiseProduct(box.sizes()); face.holds(p)) add(p);
    }
  if (places.empty()) add(middle);
  return places;
}

PieceSurface surface_of(const ContactPiece& piece, double edge_mm) {
  PieceSurface out;
  out.body = piece.body;
  for (const Vector3d& corner : piece.corners) {
    out.corners.push_back(corner / edge_mm);
    out.center += out.corners.back() / static_cast<double>(piece.corners.size());
  }
  for (const Vector3d& corner : out.corners) {
    out.radius = std::max(out.radius, (corner - out.center).norm());
    out.points.push_back({corner, 1});
  }
  out.faces = piece.faces;
  out.faces.col(3) /= edge_mm;
  out.faces = distinct_faces(out.faces, out.radius);
  out.pushes.assign(out.faces.rows(), true);
  return out;
}

/// Returns whether other pieces of the body cover a face completely.
bool is_covered(std::span<const PieceSurface> of_body, const PieceSurface& piece, int face,
                const std::vector<Vector3d>& places) {
  const Vector3d off = just_outside * piece.radius * piece.faces.row(face).head<3>().transpose();
  return std::all_of(places.begin(), places.end(), [&](const Vector3d& p) {
    return std::any_of(of_body.begin(), of_body.end(), [&](const PieceSurface& other) {
      return &other != &piece && other.outside(p + off) < 0;
    });
  });
}

/// Adds points along the edges of a piece and over those of its faces that are on the body's surface.
void add_points(std::span<const PieceSurface> of_body, PieceSurface& piece) {
  std::set<std::pair<int, int>> edges;
  std::vector<SurfacePoint> over_faces;
  for (int f = 0; f < piece.faces.rows(); ++f) {
    const FacePolygon polygon = polygon_of(piece, f);
    if (polygon.empty()) continue;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      edges.insert(std::minmax(polygon[k], polygon[(k + 1) % polygon.size()]));
    const std::vector<Vector3d> places = places_over(FlatFace(piece, f, polygon));
    piece.pushes[f] = !is_covered(of_body, piece, f, places);
    if (!piece.pushes[f]) continue;
    for (const Vector3d& place : places)
      over_faces.push_back({place, 1 / static_cast<double>(places.size())});
  }
  for (const auto& [from, to] : edges) add_along_edge(piece, piece.corners[from], piece.corners[to]);
  piece.points.insert(piece.points.end(), over_faces.begin(), over_faces.end());
}

}  // namespace

double PieceSurface::outside(const Vector3d& p) const {
  return (faces.leftCols<3>() * p - faces.col(3)).maxCoeff();
}

int PieceSurface::nearest_face(const Vector3d& p) const {
  int nearest = -1;
  double most = -std::numeric_limits<double>::infinity();
  for (int f = 0; f < faces.rows(); ++f) {
    if (!pushes[f]) continue;
    const double off = gap(f, p);
    if (!(off > most)) continue;
    most = off;
    nearest = f;
  }
  return nearest;
}

std::vector<PieceSurface> piece_surfaces(const ConvexBodies& bodies, double edge_mm) {
  std::vector<PieceSurface> all;
  for (const ContactPiece& piece : bodies.pieces) all.push_back(surface_of(piece, edge_mm));
  for (auto first = all.begin(); first != all.end();) {
    const auto end =
        std::find_if(first, all.end(), [&](const PieceSurface& p) { return p.body != first->body; });
    for (auto piece = first; piece != end; ++piece) add_points({first, end}, *piece);
    first = end;
  }
  return all;
}

namespace {

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
struct SegmentInside {
  double from = 0, to = 1;  // dimensionless, [0, 1]
  int entry = -1;

  SegmentInside(const PieceSurface& piece, const Vector3d& start, const Vector3d& end) {
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
    const SegmentInside inside(in, start, end);
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
