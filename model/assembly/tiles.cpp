#include "model/assembly/tiles.hpp"

#include <cstdio>

#include "model/base/algorithms.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Corners = std::vector<Vector3d>;

// Ratio to a tile's size: a corner farther off its plane is not part of a tile
constexpr double flat_share = 0.01;
constexpr double joined_share = 0.05;  // ratio to the median edge: corners farther apart are not one joint
// Rad, between the normals of tiles that turn about them
constexpr double one_plane = 1 * radians_per_degree;
// Half distance of the points that support a hinge, ratio to the distance of two bodies, as in sheets
constexpr double reach_share = 0.18;

/// Returns twice the area along the normal, by Newell's method.
Vector3d area_vector(const Corners& corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) sum += corners[k].cross(corners[(k + 1) % corners.size()]);
  return sum;
}

Vector3d mean(const Corners& corners) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& c : corners) sum += c;
  return sum / static_cast<double>(corners.size());
}

std::string short_text(double x) {
  char out[32];
  std::snprintf(out, sizeof out, "%.3g", x);
  return out;
}

std::string joint_label(std::size_t joint) { return "joint " + std::to_string(joint + 1) + ": "; }

[[noreturn]] void refuse_tile(std::size_t tile, const std::string& why) {
  throw InvalidInput("tile " + std::to_string(tile + 1) + " " + why);
}

/// Returns the part of a convex polygon on the inner side of a line through `on`.
Corners cut_off(const Corners& corners, const Vector3d& on, const Vector3d& inwards) {
  Corners out;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector3d &here = corners[k], &next = corners[(k + 1) % corners.size()];
    const double in = inwards.dot(here - on), in_next = inwards.dot(next - on);
    if (in >= 0) out.push_back(here);
    if ((in > 0 && in_next < 0) || (in < 0 && in_next > 0))
      out.push_back(here + in / (in - in_next) * (next - here));
  }
  return out;
}

/// A tile of the sheet after the cut.
class TileShape {
 public:
  TileShape(const Corners& corners, std::size_t tile, const TileMake& make) : tile_(tile), make_(make) {
    if (corners.size() < 3) refuse_tile(tile, "has fewer than three corners");
    for (const Vector3d& c : corners)
      if (!c.allFinite()) refuse_tile(tile, "has a coordinate that is not a finite number");
    const Vector3d area = area_vector(corners);
    if (!(area.norm() > 0)) refuse_tile(tile, "has no area");
    normal_ = area.normalized();
    flatten(corners, std::sqrt(area.norm()));
    check_convex();
    cut();
  }

  const Vector3d& normal() const { return normal_; }

  Polyhedron prism() const {
    Polyhedron out;
    const int n = static_cast<int>(corners_.size());
    for (const double side : {-0.5, 0.5})
      for (const Vector3d& c : corners_) out.add_point(c + side * make_.thickness_mm * normal_);
    std::vector<int> bottom, top;
    for (int k = 0; k < n; ++k) {
      bottom.push_back(n - 1 - k);
      top.push_back(n + k);
      const int next = (k + 1) % n;
      out.add_face({k, next, n + next, n + k});
    }
    out.add_face(bottom);
    out.add_face(top);
    return out;
  }

 private:
  void flatten(const Corners& corners, double size) {
    const Vector3d middle = mean(corners);
    for (const Vector3d& c : corners) {
      const double off = normal_.dot(c - middle);
      if (!(std::abs(off) <= flat_share * size)) refuse_tile(tile_, "is not flat");
      corners_.push_back(c - off * normal_);
    }
  }

  void check_convex() const {
    const std::size_t n = corners_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Vector3d before = corners_[k] - corners_[(k + n - 1) % n],
                     after = corners_[(k + 1) % n] - corners_[k];
      if (!(before.norm() > 0)) refuse_tile(tile_, "has corner " + std::to_string(k + 1) + " twice");
      if (!(normal_.dot(before.cross(after)) > 0))
        refuse_tile(tile_, "is not convex at corner " + std::to_string(k + 1) + ". Cut it into convex ones");
    }
  }

  /// Removes half of each cut from this tile. An edge that is shorter than the cuts next to it may vanish.
  void cut() {
    const Corners whole = corners_;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      const Vector3d inwards = normal_.cross(whole[(k + 1) % whole.size()] - whole[k]).normalized();
      corners_ = cut_off(corners_, whole[k] + make_.kerf_mm / 2 * inwards, inwards);
    }
    if (corners_.size() < 3)
      refuse_tile(tile_, "is narrower than the cuts, " + short_text(make_.kerf_mm) + " mm");
  }

  std::size_t tile_;
  const TileMake& make_;
  Vector3d normal_;
  Corners corners_;
};

class TileBuilder {
 public:
  TileBuilder(const TileSheet& sheet, const TileMake& make)
      : sheet_(sheet), make_(make), edge_(median_edge(sheet)) {}

  Assembly run() {
    for (std::size_t t = 0; t < sheet_.tiles.size(); ++t) add_tile(t);
    if (sheet_.joints.empty()) throw InvalidInput("has no joints: its tiles hang on nothing");
    for (std::size_t j = 0; j < sheet_.joints.size(); ++j) add_joint(j);
    if (const auto tile = first_apart(out_))
      throw InvalidInput("tile " + std::to_string(*tile + 1) + " hangs on no chain of joints with tile 1");
    out_.edge_mm = hinge_distance(out_);
    for (AssemblyHinge& h : out_.hinges) h.reach_mm = reach_share * out_.edge_mm;
    return std::move(out_);
  }

 private:
  void add_tile(std::size_t tile) {
    Corners corners;
    for (const Vector3d& c : sheet_.tiles[tile]) corners.push_back(make_.scale_mm * c);
    const TileShape shape(corners, tile, make_);
    Polyhedron prism = shape.prism();
    const Vector3d center = mass_properties(prism).center;
    normals_.push_back(shape.normal());
    out_.bodies.push_back({"tile_" + std::to_string(tile + 1), center, std::move(prism)});
  }

  Vector3d corner(std::size_t joint, int tile, int corner) const {
    const std::string what = joint_label(joint);
    const int tiles = static_cast<int>(sheet_.tiles.size());
    if (tile < 0 || tile >= tiles)
      throw InvalidInput(what + "the file has no tile " + std::to_string(tile) + ". Give 0 to " +
                         std::to_string(tiles - 1));
    const int corners = static_cast<int>(sheet_.tiles[tile].size());
    if (corner < 0 || corner >= corners)
      throw InvalidInput(what + "tile " + std::to_string(tile) + " has no corner " + std::to_string(corner) +
                         ". Give 0 to " + std::to_string(corners - 1));
    return sheet_.tiles[tile][corner];
  }

  void add_joint(std::size_t number) {
    const TileJoint& joint = sheet_.joints[number];
    const Vector3d a = corner(number, joint.first, joint.first_corner),
                   b = corner(number, joint.second, joint.second_corner);
    if (joint.first == joint.second)
      throw InvalidInput(joint_label(number) + "joins tile " + std::to_string(joint.first) + " with itself");
    if (!((a - b).norm() <= joined_share * edge_))
      throw InvalidInput(joint_label(number) + "corners that it joins are " +
                         short_text((a - b).norm() / edge_) + " of an edge apart");
    AssemblyHinge hinge{"joint_" + std::to_string(number + 1), std::min(joint.first, joint.second),
                        std::max(joint.first, joint.second), HingeKind::pin, make_.scale_mm * (a + b) / 2};
    const Vector3d &n = normals_[hinge.lower], &m = normals_[hinge.upper];
    hinge.axis = n;
    hinge.ball = !joint.both_faces || !(std::abs(n.dot(m)) >= std::cos(one_plane));
    if (!hinge.ball) hinge.axis = (n + (n.dot(m) < 0 ? -m : m)).normalized();
    hinge.along =
        direction_across(out_.bodies[hinge.upper].position - out_.bodies[hinge.lower].position, hinge.axis);
    out_.hinges.push_back(std::move(hinge));
  }

  const TileSheet& sheet_;
  const TileMake& make_;
  const double edge_;
  std::vector<Vector3d> normals_;
  Assembly out_;
};

Eigen::Matrix3Xd as_columns(const Corners& corners, double scale) {
  Eigen::Matrix3Xd out(3, corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = scale * corners[k];
  return out;
}

}  // namespace

double median_edge(const TileSheet& sheet) {
  std::vector<double> all;
  for (const Corners& tile : sheet.tiles)
    for (std::size_t k = 0; k < tile.size(); ++k)
      all.push_back((tile[(k + 1) % tile.size()] - tile[k]).norm());
  return all.empty() ? 0 : lower_median(std::move(all));
}

Assembly assembly_of_tiles(const TileSheet& sheet, const TileMake& make) {
  return TileBuilder(sheet, make).run();
}

TileTarget target_of_tiles(const TileSheet& sheet, const Assembly& assembly, double scale_mm) {
  TileTarget out;
  for (std::size_t t = 0; t < sheet.tiles.size(); ++t) {
    const Eigen::Matrix3Xd from = as_columns(sheet.tiles[t], scale_mm),
                           to = as_columns(sheet.target[t], scale_mm);
    const Eigen::Matrix4d motion = rigid_fit(from, to);
    const Eigen::Matrix3d R = motion.topLeftCorner<3, 3>();
    const Vector3d p = motion.topRightCorner<3, 1>();
    const double off = (((R * from).colwise() + p) - to).colwise().norm().maxCoeff();
    out.off_max = std::max(out.off_max, off / (scale_mm * median_edge(sheet)));
    out.poses.push_back({R, R * assembly.bodies[t].position + p});
  }
  return out;
}

}  // namespace kinetix::model
