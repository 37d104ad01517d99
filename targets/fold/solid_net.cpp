#include "targets/fold/solid_net.hpp"

#include <limits>
#include <set>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/hinge/crease_law.hpp"
#include "model/lattice/planar/planar_crease.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<Vector2d>;

constexpr double one_point = 1e-9;  // cell edges: bodies are farther apart
constexpr double min_gap = 0.3;     // cell edges, between faces that no crease joins: room for their walls

Vector2d left_of(const Vector2d& v) { return {-v.y(), v.x()}; }

/// Plane of a face: x along its first side, z towards the inside of the solid.
struct FaceFrame {
  Vector3d origin, x, y;

  Vector2d flat(const Vector3d& p) const { return {x.dot(p - origin), y.dot(p - origin)}; }
  Vector3d space(const Vector2d& p) const { return origin + p.x() * x + p.y() * y; }
};

FaceFrame frame_of(const Solid& solid, int face) {
  const auto corner = [&](int k) { return solid.corners[solid.faces[face][k]]; };
  FaceFrame frame{corner(0), (corner(1) - corner(0)).normalized(), {}};
  const Vector3d inwards = frame.x.cross(corner(2) - corner(1)).normalized();
  frame.y = inwards.cross(frame.x);
  return frame;
}

/// Returns a face in its plane, with sides of length 1.
Points polygon_of(const Solid& solid, int face) {
  const FaceFrame frame = frame_of(solid, face);
  Points out;
  for (const int corner : solid.faces[face]) out.push_back(frame.flat(solid.corners[corner]));
  return out;
}

double interior_angle(const Points& polygon, std::size_t corner) {
  const std::size_t n = polygon.size();
  const Vector2d next = polygon[(corner + 1) % n] - polygon[corner],
                 before = polygon[(corner + n - 1) % n] - polygon[corner];
  return std::acos(next.dot(before) / (next.norm() * before.norm()));
}

/// Distances of a face's cells from its sides, cell edges, due to the folds there.
using Insets = std::vector<std::vector<double>>;

Insets insets_of(const Solid& solid, const std::vector<SolidEdge>& edges, int columns) {
  Insets out;
  for (const auto& face : solid.faces) out.emplace_back(face.size(), 0.0);
  for (const SolidEdge& e : edges)
    out[e.first][e.first_side] = out[e.second][e.second_side] = edge_inset(e.turn, columns);
  return out;
}

/// Returns the distance from a corner, along the second of two sides, to the foot of the point where lines inside both
/// sides meet.
double foot_of_corner(double angle, double before, double own) {
  return (before + own * std::cos(angle)) / std::sin(angle);
}

/// Returns the longest foot of all corners of all faces, along both sides of a corner.
double longest_foot(const Solid& solid, const Insets& insets) {
  double longest = 0;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Points polygon = polygon_of(solid, static_cast<int>(f));
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const double own = insets[f][k], before = insets[f][(k + polygon.size() - 1) % polygon.size()];
      const double angle = interior_angle(polygon, k);
      longest = std::max({longest, foot_of_corner(angle, before, own), foot_of_corner(angle, own, before)});
    }
  }
  return longest;
}

/// The cells of one face, flat in its own plane.
class FaceCells {
 public:
  /// @param foot along each side, from which on its cells are equally long: one edge on the shortest sides
  FaceCells(const Points& polygon, const std::vector<double>& insets, double foot, int cells)
      : cells_(cells), count_(polygon.size()) {
    for (std::size_t k = 0; k < count_; ++k) corners_.push_back(inner_corner(polygon, insets, k));
    for (const Vector2d& c : corners_) middle_ += c / static_cast<double>(count_);
    add(middle_);
    for (std::size_t k = 0; k < count_; ++k) sides_.push_back(side(polygon, insets, foot, k));
    for (std::size_t k = 0; k < count_; ++k) add_corner(k);
  }

  const Points& points() const { return points_; }
  const std::set<std::pair<int, int>>& walls() const { return walls_; }
  std::vector<int> crossing(std::size_t side) {
    std::vector<int> out;
    for (int j = 1; j < 2 * cells_; ++j) out.push_back(add(sides_[side][j]));
    return out;
  }

 private:
  static Vector2d inner_corner(const Points& polygon, const std::vector<double>& insets, std::size_t k) {
    const std::size_t n = polygon.size();
    const Vector2d along = (polygon[(k + 1) % n] - polygon[k]).normalized();
    const double foot = foot_of_corner(interior_angle(polygon, k), insets[(k + n - 1) % n], insets[k]);
    return polygon[k] + foot * along + insets[k] * left_of(along);
  }

  /// Returns the points of a side from its first corner to the next.
  Points side(const Points& polygon, const std::vector<double>& insets, double foot, std::size_t k) const {
    const Vector2d along = (polygon[(k + 1) % count_] - polygon[k]).normalized();
    Points out = {corners_[k]};
    const double pitch = ((polygon[(k + 1) % count_] - polygon[k]).norm() - 2 * foot) / (2 * cells_);
    for (int j = 1; j < 2 * cells_; ++j)
      out.push_back(polygon[k] + (foot + j * pitch) * along + insets[k] * left_of(along));
    out.push_back(corners_[(k + 1) % count_]);
    return out;
  }

  /// Returns a point on the line from the middle of a side to the middle of the face.
  Vector2d spoke(std::size_t side, int step) const {
    const double part = static_cast<double>(step) / cells_;
    return (1 - part) * sides_[side][cells_] + part * middle_;
  }

  /// Returns a point between the boundary lines, each of which is kept (Coons).
  Vector2d between(std::size_t k, int s, int t) const {
    const std::size_t before = (k + count_ - 1) % count_;
    const double a = static_cast<double>(s) / cells_, b = static_cast<double>(t) / cells_;
    const auto own = [&](int step) { return sides_[k][step]; };
    const auto other = [&](int step) { return sides_[before][2 * cells_ - step]; };
    const Vector2d lines = (1 - b) * own(s) + b * spoke(before, s) + (1 - a) * other(t) + a * spoke(k, t);
    const Vector2d ends =
        (1 - a) * ((1 - b) * corners_[k] + b * other(cells_)) + a * ((1 - b) * own(cells_) + b * middle_);
    return lines - ends;
  }

  void add_corner(std::size_t k) {
    for (int s = 0; s <= cells_; ++s)
      for (int t = 0; t <= cells_; ++t) {
        const int here = add(between(k, s, t));
        if (s > 0) join(here, add(between(k, s - 1, t)));
        if (t > 0) join(here, add(between(k, s, t - 1)));
      }
  }

  int add(const Vector2d& p) {
    for (std::size_t k = 0; k < points_.size(); ++k)
      if ((points_[k] - p).norm() < one_point) return static_cast<int>(k);
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  void join(int a, int b) { walls_.insert(std::minmax(a, b)); }

  int cells_;
  std::size_t count_;
  Points corners_, points_;
  Vector2d middle_ = Vector2d::Zero();
  std::vector<Points> sides_;
  std::set<std::pair<int, int>> walls_;
};

/// Proper motion of the plane.
struct Motion {
  Eigen::Matrix2d R = Eigen::Matrix2d::Identity();
  Vector2d p = Vector2d::Zero();
  Vector2d operator()(const Vector2d& at) const { return R * at + p; }
};

/// Returns the motion that puts point a on b and direction `from` on `to`, both unit vectors.
Motion onto(const Vector2d& a, const Vector2d& from, const Vector2d& b, const Vector2d& to) {
  const double c = from.dot(to), s = left_of(from).dot(to);
  Motion m;
  m.R << c, -s, s, c;
  m.p = b - m.R * a;
  return m;
}

/// Whether a line parts two convex polygons by at least the gap.
bool are_apart(const Points& a, const Points& b, double gap) {
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (std::size_t k = 0; k < one->size(); ++k) {
      const Vector2d outwards = -left_of((*one)[(k + 1) % one->size()] - (*one)[k]).normalized();
      double least = std::numeric_limits<double>::infinity();
      for (const Vector2d& p : *other) least = std::min(least, outwards.dot(p - (*one)[k]));
      if (least >= gap) return true;
    }
  return false;
}

/// Faces laid flat along a tree of edges.
class Unfolding {
 public:
  Unfolding(const Solid& solid, const std::vector<SolidEdge>& edges, const Insets& insets, double length,
            int columns)
      : edges_(edges), insets_(insets), columns_(columns) {
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      polygons_.push_back(polygon_of(solid, static_cast<int>(f)));
      for (Vector2d& p : polygons_.back()) p *= length;
    }
  }

  /// Lays the faces out from a root face: each as near to it as possible, or in a strip as long as possible.
  bool lay(int root, bool strip) {
    placed_.assign(polygons_.size(), Motion());
    is_placed_.assign(polygons_.size(), false);
    creases_.clear();
    is_placed_[root] = true;
    std::vector<int> open = {root};
    while (!open.empty()) {
      const int at = strip ? open.back() : open.front();
      if (!grow(at, open)) open.erase(strip ? open.end() - 1 : open.begin());
    }
    return std::all_of(is_placed_.begin(), is_placed_.end(), [](bool is) { return is; });
  }

  const std::vector<int>& creases() const { return creases_; }
  const Points& polygon(int face) const { return polygons_[face]; }
  const Motion& motion(int face) const { return placed_[face]; }

 private:
  /// Adds one more face next to `at`, if one fits.
  bool grow(int at, std::vector<int>& open) {
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      const SolidEdge& edge = edges_[e];
      if (edge.first != at && edge.second != at) continue;
      const int next = edge.first == at ? edge.second : edge.first;
      if (is_placed_[next]) continue;
      placed_[next] = beside(edge, at);
      if (!is_free(next, at)) continue;
      is_placed_[next] = true;
      creases_.push_back(e);
      open.push_back(next);
      return true;
    }
    return false;
  }

  Motion beside(const SolidEdge& edge, int at) const {
    const bool forth = edge.first == at;
    const int other = forth ? edge.second : edge.first;
    const std::size_t local_side = forth ? edge.first_side : edge.second_side,
                      other_side = forth ? edge.second_side : edge.first_side;
    const Points &own = polygons_[at], &far = polygons_[other];
    const Vector2d along =
                       placed_[at].R * (own[(local_side + 1) % own.size()] - own[local_side]).normalized(),
                   back = (far[(other_side + 1) % far.size()] - far[other_side]).normalized();
    const double apart = columns_ - 2 * insets_[at][local_side];
    const Vector2d corner = placed_[at](own[local_side]) - apart * left_of(along);
    return onto(far[(other_side + 1) % far.size()], back, corner, -along);
  }

  bool is_free(int face, int neighbour) const {
    for (int f = 0; f < static_cast<int>(polygons_.size()); ++f) {
      if (f == face || f == neighbour || !is_placed_[f]) continue;
      if (!are_apart(inner(face), inner(f), min_gap)) return false;
    }
    return true;
  }

  Points inner(int face) const {
    Points out;
    const Points& p = polygons_[face];
    const std::size_t n = p.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Vector2d along = (p[(k + 1) % n] - p[k]).normalized();
      const auto& inset = insets_[face];
      const double foot = foot_of_corner(interior_angle(p, k), inset[(k + n - 1) % n], inset[k]);
      out.push_back(placed_[face](p[k] + foot * along + inset[k] * left_of(along)));
    }
    return out;
  }

  const std::vector<SolidEdge>& edges_;
  const Insets& insets_;
  int columns_;
  std::vector<Points> polygons_;
  std::vector<Motion> placed_;
  std::vector<bool> is_placed_;
  std::vector<int> creases_;
};

/// The drawing of a net while it grows.
class Drawing {
 public:
  model::PlanarGraph graph;

  int vertex(const Vector2d& p) {
    graph.vertices.push_back(p);
    return static_cast<int>(graph.vertices.size()) - 1;
  }
  int wall(int a, int b) {
    graph.edges.push_back({a, b});
    return static_cast<int>(graph.edges.size()) - 1;
  }
};

SolidFace drawn_face(Drawing& drawing, FaceCells cells, const Motion& motion, std::size_t sides) {
  SolidFace face;
  face.ideal = cells.points();
  for (const Vector2d& p : face.ideal) face.bodies.push_back(drawing.vertex(motion(p)));
  for (const auto& [a, b] : cells.walls()) drawing.wall(face.bodies[a], face.bodies[b]);
  for (std::size_t k = 0; k < sides; ++k) {
    std::vector<int> crossing = cells.crossing(k);
    for (int& body : crossing) body = face.bodies[body];
    face.sides.push_back(std::move(crossing));
  }
  return face;
}

SolidCrease drawn_crease(Drawing& drawing, const SolidEdge& edge, const std::vector<SolidFace>& faces,
                         int columns) {
  const std::vector<int>& near = faces[edge.first].sides[edge.first_side];
  std::vector<int> far = faces[edge.second].sides[edge.second_side];
  std::reverse(far.begin(), far.end());
  SolidCrease crease{edge.first, edge.second, edge.turn, {}, {}};
  const auto at = [&](int body) { return drawing.graph.vertices[body]; };
  crease.line = -(at(near.back()) - at(near.front())).normalized();
  std::vector<int> before = near;
  for (int c = 1; c <= columns; ++c) {
    std::vector<int> next = far, walls;
    for (std::size_t j = 0; c < columns && j < near.size(); ++j)
      next[j] = drawing.vertex(at(near[j]) + (at(far[j]) - at(near[j])) * c / columns);
    for (std::size_t j = 0; j < near.size(); ++j) {
      walls.push_back(drawing.wall(before[j], next[j]));
      if (c < columns && j > 0) drawing.wall(next[j - 1], next[j]);
    }
    crease.hinges.push_back(std::move(walls));
    before = std::move(next);
  }
  return crease;
}

SolidNet drawn(const Solid& solid, const std::vector<SolidEdge>& edges, const Insets& insets,
               const Unfolding& unfolding, double foot, int cells, int columns, const model::CellSize& size) {
  SolidNet net;
  net.solid = solid;
  net.columns = columns;
  net.edge = 2 * (cells + foot);
  Drawing drawing;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const int face = static_cast<int>(f);
    net.faces.push_back(drawn_face(drawing, FaceCells(unfolding.polygon(face), insets[f], foot, cells),
                                   unfolding.motion(face), solid.faces[f].size()));
  }
  for (const int e : unfolding.creases())
    net.creases.push_back(drawn_crease(drawing, edges[e], net.faces, columns));
  net.structure = make_planar_structure(std::move(drawing.graph), size);
  return net;
}

/// Returns the state of the given bodies alone.
model::State part_of(const model::State& state, const std::vector<int>& bodies) {
  model::State out;
  for (const int body : bodies) out.push_back(state[body]);
  return out;
}

Eigen::Matrix3d frame_in(const SolidNet& net, const model::State& state, const SolidFace& face) {
  const model::State flat = rest_state(net.structure);
  return motion_onto(part_of(flat, face.bodies), part_of(state, face.bodies)).R;
}

double fold_of(const Eigen::Matrix3d& first, const Eigen::Matrix3d& second, const Vector2d& line) {
  const Eigen::Matrix3d turn = first.transpose() * second;
  const Vector3d twice(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  return std::atan2(twice.head<2>().dot(line) / 2, (turn.trace() - 1) / 2);
}

}  // namespace

SolidNet lay_out(const Solid& solid, int cells, int columns, const model::CellSize& size) {
  const std::vector<SolidEdge> edges = edges_of(solid);
  const Insets insets = insets_of(solid, edges, columns);
  const double foot = longest_foot(solid, insets);
  Unfolding unfolding(solid, edges, insets, 2 * (cells + foot), columns);
  for (const bool strip : {false, true})
    for (int root = 0; root < static_cast<int>(solid.faces.size()); ++root)
      if (unfolding.lay(root, strip))
        return drawn(solid, edges, insets, unfolding, foot, cells, columns, size);
  throw InvalidInput("no flat net of this solid without overlap was found. Use fewer columns per crease");
}

std::vector<double> fold_solid(SolidNet& net, double theta) {
  std::vector<double> tilts;
  for (const SolidCrease& crease : net.creases) {
    const double tilt = model::tilt_of_turn(crease.angle / net.columns, theta);
    for (const auto& column : crease.hinges)
      for (const int hinge : column) set_fold(net.structure, hinge, crease.line, std::tan(tilt));
    tilts.push_back(tilt);
  }
  return tilts;
}

std::vector<IdealPoint> ideal_places(const SolidNet& net, const model::State& state, double theta) {
  const double pitch = net.structure.size.edge_mm * std::cos(theta);
  model::State ideal, real;
  std::vector<IdealPoint> out;
  for (std::size_t f = 0; f < net.faces.size(); ++f) {
    FaceFrame frame = frame_of(net.solid, static_cast<int>(f));
    frame.origin *= net.edge;
    for (std::size_t k = 0; k < net.faces[f].bodies.size(); ++k) {
      out.push_back({net.faces[f].bodies[k], pitch * frame.space(net.faces[f].ideal[k])});
      ideal.emplace_back().p = out.back().place;
      real.push_back(state[out.back().body]);
    }
  }
  const model::Pose motion = motion_onto(ideal, real);
  for (auto& [body, place] : out) place = motion.R * place + motion.p;
  return out;
}

FoldError solid_error(const SolidNet& net, const model::State& state, double theta) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  FoldError error{{}, {}, nan};
  error.fold.assign(net.creases.size(), nan);
  error.face_rms.assign(net.faces.size(), nan);
  if (!is_finite(state)) return error;
  std::vector<Eigen::Matrix3d> frames;
  for (const SolidFace& face : net.faces) frames.push_back(frame_in(net, state, face));
  for (std::size_t c = 0; c < net.creases.size(); ++c)
    error.fold[c] = fold_of(frames[net.creases[c].first], frames[net.creases[c].second], net.creases[c].line);
  const double edge = net.edge * net.structure.size.edge_mm * std::cos(theta);
  const auto places = ideal_places(net, state, theta);
  double sum = 0;
  std::size_t at = 0;
  for (std::size_t f = 0; f < net.faces.size(); ++f) {
    double own = 0;
    for (std::size_t k = 0; k < net.faces[f].bodies.size(); ++k, ++at)
      own += (places[at].place - state[places[at].body].p).squaredNorm();
    error.face_rms[f] = std::sqrt(own / static_cast<double>(net.faces[f].bodies.size())) / edge;
    sum += own;
  }
  error.rms = std::sqrt(sum / static_cast<double>(places.size())) / edge;
  return error;
}

}  // namespace kinetix::targets
