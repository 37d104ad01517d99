#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "model/base/geometry.hpp"
#include "model/solids/body_solid.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Indices = std::vector<int>;

/// Returns the heights at which a lug or the wall begins or ends, upwards.
std::vector<double> levels_of(const ArmSolid& arm) {
  std::vector<double> levels{-arm.size.height_mm / 2, arm.size.height_mm / 2};
  for (const HingeEnd::Lug& lug : arm.end.lugs) {
    levels.push_back(lug.from);
    levels.push_back(lug.to);
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

Indices reversed(Indices face) {
  std::reverse(face.begin(), face.end());
  return face;
}

/// Surface of an arm, from the corners where it leaves the junction.
class ArmMesh {
 public:
  ArmMesh(const ArmSolid& arm, const Indices& start, Polyhedron& mesh)
      : arm_(arm), end_(arm.end), start_(start), mesh_(mesh), levels_(levels_of(arm)) {}

  void add() {
    const double half = arm_.size.thickness_mm / 2;
    for (const double s : levels_) {
      low_.push_back(mesh_.add_point(arm_.point({-end_.wall_end, -half}, s)));
      high_.push_back(mesh_.add_point(arm_.point({-end_.wall_end, half}, s)));
    }
    add_plate();
    add_wall_end();
    for (const HingeEnd::Lug& lug : end_.lugs) add_lug(lug);
    if (!end_.rod.empty()) add_sides(reversed(rings_[1]), reversed(rings_[2]));
  }

 private:
  int level(double s) const {
    return static_cast<int>(std::find(levels_.begin(), levels_.end(), s) - levels_.begin());
  }
  bool is_lug(double from) const {
    return std::any_of(end_.lugs.begin(), end_.lugs.end(),
                       [&](const HingeEnd::Lug& lug) { return lug.from <= from && from < lug.to; });
  }

  void add_plate() {
    mesh_.add_face({start_[0], start_[1], high_.front(), low_.front()});
    mesh_.add_face({start_[2], low_.back(), high_.back(), start_[3]});
    Indices low{start_[2], start_[0]}, high{start_[1], start_[3]};
    low.insert(low.end(), low_.begin(), low_.end());
    high.insert(high.end(), high_.rbegin(), high_.rend());
    add_side(low);
    add_side(high);
  }

  /// Starts the triangles at the junction's corner that is farther behind the plane of the plate's end. The other
  /// corner may be beyond it if the hinge leans, and the triangles would turn over.
  void add_side(Indices side) {
    if (ahead(side[0]) > ahead(side[1])) std::rotate(side.begin(), side.begin() + 1, side.end());
    mesh_.add_face(side);
  }
  double ahead(int point) const { return arm_.towards_axis.dot(mesh_.points[point]); }

  void add_wall_end() {
    for (std::size_t k = 0; k + 1 < levels_.size(); ++k)
      if (!is_lug(levels_[k])) mesh_.add_face({low_[k], high_[k], high_[k + 1], low_[k + 1]});
  }

  Indices section_at(double s) {
    Indices out{low_[level(s)]};
    for (std::size_t k = 1; k + 1 < end_.section.size(); ++k)
      out.push_back(mesh_.add_point(arm_.point(end_.section[k], s)));
    out.push_back(high_[level(s)]);
    return out;
  }
  Indices ring_at(const std::vector<Vector2d>& ring, double s) {
    Indices out;
    for (const Vector2d& p : ring) out.push_back(mesh_.add_point(arm_.point(p, s)));
    return out;
  }

  void add_lug(const HingeEnd::Lug& lug) {
    const Indices below = section_at(lug.from), above = section_at(lug.to);
    for (std::size_t k = 0; k + 1 < below.size(); ++k)
      mesh_.add_face({below[k], below[k + 1], above[k + 1], above[k]});
    const bool is_first = &lug == &end_.lugs.front();
    const bool holed_below = !end_.bore.empty() || (!end_.rod.empty() && !is_first),
               holed_above = !end_.bore.empty() || (!end_.rod.empty() && is_first);
    rings_.push_back(add_end(below, holed_below, lug.from, false));
    rings_.push_back(add_end(above, holed_above, lug.to, true));
    if (!end_.bore.empty()) add_sides(rings_[rings_.size() - 2], rings_.back());
  }

  /// Adds a lug's face, with a cone if the end has cones. @return the ring of rod or bore, or empty
  Indices add_end(const Indices& section, bool holed, double s, bool upwards) {
    const auto& inner = end_.rod.empty() ? end_.bore : end_.rod;
    if (!holed || end_.rim.empty()) {
      const Indices ring = holed ? ring_at(inner, s) : Indices{};
      add_cap(section, ring, s, upwards);
      return ring;
    }
    const bool goes_up = upwards == !end_.rod.empty();
    const Indices rim = ring_at(end_.rim, s), ring = ring_at(inner, goes_up ? s + end_.cone : s - end_.cone);
    add_cap(section, rim, s, upwards);
    if (upwards)
      add_sides(ring, rim);
    else
      add_sides(rim, ring);
    return ring;
  }

  /// Adds the wall of a hole whose two edges are counter-clockwise seen from above.
  void add_sides(const Indices& below, const Indices& above) {
    const std::size_t n = below.size();
    for (std::size_t k = 0; k < n; ++k)
      mesh_.add_face({below[(k + 1) % n], below[k], above[k], above[(k + 1) % n]});
  }

  void add_cap(const Indices& section, const Indices& ring, double s, bool upwards) {
    std::vector<std::array<int, 3>> triangles = ring.empty() ? fan(section, s) : between(section, ring);
    for (auto& t : triangles) {
      if (!upwards) std::swap(t[0], t[1]);
      mesh_.triangles.push_back(t);
    }
  }

  std::vector<std::array<int, 3>> fan(const Indices& section, double s) {
    if (section.size() == 4)
      return {{section[0], section[1], section[2]}, {section[0], section[2], section[3]}};
    Vector2d mean = Vector2d::Zero();
    for (const Vector2d& p : end_.section) mean += p / static_cast<double>(end_.section.size());
    const int middle = mesh_.add_point(arm_.point(mean, s));
    std::vector<std::array<int, 3>> out;
    for (std::size_t k = 0; k < section.size(); ++k)
      out.push_back({middle, section[k], section[(k + 1) % section.size()]});
    return out;
  }

  double angle_of(int point) const {
    const Vector3d d = mesh_.points[point] - arm_.origin;
    return std::atan2(arm_.normal.dot(d) - end_.axis_across, arm_.towards_axis.dot(d));
  }

  /// Rotates a line about the axis so that it starts at -pi.
  Indices by_angle(const Indices& line) const {
    Indices out(line);
    const auto first =
        std::min_element(out.begin(), out.end(), [&](int a, int b) { return angle_of(a) < angle_of(b); });
    std::rotate(out.begin(), first, out.end());
    return out;
  }

  /// Returns the strip between a ring and the section around it. Both are fully visible from the axis, so triangles
  /// in the order of the corners' angles do not overlap.
  std::vector<std::array<int, 3>> between(const Indices& section, const Indices& ring) const {
    const Indices out = by_angle(section), in = by_angle(ring);
    const std::size_t n = out.size(), m = in.size();
    const auto angle = [&](const Indices& line, std::size_t k) {
      return k < line.size() ? angle_of(line[k]) : angle_of(line.front()) + 2 * pi;
    };
    std::vector<std::array<int, 3>> triangles;
    std::size_t i = 0, j = 0;
    while (i < n || j < m) {
      const bool outer = j == m || (i < n && angle(out, i + 1) <= angle(in, j + 1));
      triangles.push_back({in[j % m], out[i % n], outer ? out[(i + 1) % n] : in[(j + 1) % m]});
      ++(outer ? i : j);
    }
    return triangles;
  }

  const ArmSolid& arm_;
  const HingeEnd& end_;
  const Indices& start_;
  Polyhedron& mesh_;
  const std::vector<double> levels_;
  Indices low_, high_;          // corners of the plate's end, one per level
  std::vector<Indices> rings_;  // below and above each lug; may be empty
};

/// Returns the index of the junction's corner at a point.
int corner_at(const std::vector<Vector3d>& corners, const Vector3d& point) {
  const auto nearer = [&](const Vector3d& a, const Vector3d& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return static_cast<int>(std::min_element(corners.begin(), corners.end(), nearer) - corners.begin());
}

Indices start_of(const ArmSolid& arm, const std::vector<Vector3d>& corners) {
  Indices start;
  for (const Vector3d& corner : arm.start_corners()) start.push_back(corner_at(corners, corner));
  return start;
}

bool same_corners(Indices a, Indices b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

}  // namespace

namespace {

/// Adds an upright face with a hole under a gable. @param outer corners of the face, @param hole those of the hole,
/// both counter-clockwise from outside from the lower left; the hole's fourth corner is the ridge
void add_pierced(const std::array<int, 4>& outer, const std::array<int, 5>& hole, Polyhedron& mesh) {
  mesh.add_face({outer[0], outer[1], hole[1], hole[0]});
  mesh.add_face({outer[1], outer[2], hole[2], hole[1]});
  mesh.add_face({outer[2], outer[3], hole[3]});
  mesh.add_face({outer[2], hole[3], hole[2]});
  mesh.add_face({outer[3], hole[4], hole[3]});
  mesh.add_face({outer[3], outer[0], hole[0], hole[4]});
}

/// Adds a post above the foot in place of the foot's upper face. @param foot corners of that face
void add_post(const Post& post, const Indices& foot, Polyhedron& mesh) {
  Indices top;
  for (const Vector3d& corner : post.corners(post.height_mm)) top.push_back(mesh.add_point(corner));
  mesh.add_face(top);
  const auto side = [&](int k) {
    const int next = (k + 1) % 4;
    return std::array{foot[k], foot[next], top[next], top[k]};
  };
  const auto add_side = [&](int k) {
    const auto corners = side(k);
    mesh.add_face({corners.begin(), corners.end()});
  };
  add_side(0);
  add_side(2);
  if (post.hole_mm == 0) {
    add_side(1);
    add_side(3);
    return;
  }
  const double half = post.hole_mm / 2;
  const auto hole = [&](double along, double turn) {
    const auto at = [&](double across, double up) {
      return mesh.add_point(post.point(along, turn * across, up));
    };
    return std::array{at(-half, post.hole_from_mm), at(half, post.hole_from_mm), at(half, post.hole_to_mm),
                      at(0, post.ridge_mm()), at(-half, post.hole_to_mm)};
  };
  const std::array<int, 5> front = hole(post.half_mm, 1), back = hole(-post.half_mm, -1);
  add_pierced(side(1), front, mesh);
  add_pierced(side(3), back, mesh);
  constexpr std::array behind = {1, 0, 4, 3, 2};  // corner of the back behind each corner of the front
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t next = (k + 1) % 5;
    mesh.add_face({front[k], front[next], back[behind[next]], back[behind[k]]});
  }
}

}  // namespace

Polyhedron body_mesh(const BodySolid& body) {
  Polyhedron mesh;
  mesh.points = body.junction.corners;
  std::vector<Indices> starts, faces = body.junction.faces;
  for (const ArmSolid& arm : body.arms) starts.push_back(start_of(arm, body.junction.corners));
  for (const Indices& start : starts)
    std::erase_if(faces, [&](const Indices& face) { return same_corners(face, start); });
  Indices foot;
  if (body.post) {
    for (const Vector3d& corner : body.post->corners(0)) foot.push_back(corner_at(mesh.points, corner));
    std::erase_if(faces, [&](const Indices& face) { return same_corners(face, foot); });
  }
  if (faces.size() + starts.size() + (body.post ? 1 : 0) != body.junction.faces.size()) {
    if (body.post) throw InvalidInput("a post has no room on its junction, from which walls rise");
    throw std::logic_error("a wall does not leave its junction through a face of it");
  }
  for (const Indices& face : faces) mesh.add_face(face);
  for (std::size_t k = 0; k < body.arms.size(); ++k) ArmMesh(body.arms[k], starts[k], mesh).add();
  if (body.post) add_post(*body.post, foot, mesh);
  return mesh;
}

}  // namespace kinetix::model
