#include "tests/app/print/folding_judge.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr int block_corners = 8;  // corners of the box that replaces a hinge's solid

/// Points that move with bodies, and the triangles between them.
struct Part {
  std::string name;
  std::vector<int> body;         // body of each point
  std::vector<Vector3d> points;  // relative to the body's rest position, mm
  std::vector<std::array<int, 3>> triangles;
  std::set<int> bodies;
};

class File {
 public:
  explicit File(const std::string& glb) : glb_(glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    json_ = Json::parse(glb.substr(20, length));
    binary_ = 20 + length + 8;
  }

  std::vector<Part> parts() {
    std::vector<Part> out;
    std::vector<int> joints;
    for (const Json& node : json_["nodes"]) {
      const bool is_body = std::string(node.value("name", "")).starts_with("body ");
      if (!is_body) continue;
      const int body = static_cast<int>(rest_.size());
      const Json& at = node["translation"];
      rest_.emplace_back(at[0], at[1], at[2]);
      if (node.contains("mesh")) out.push_back(rigid(node, body));
    }
    for (const Json& node : json_["nodes"])
      if (node.contains("skin")) add_blocks(node, out);
    for (Part& part : out) part.bodies.insert(part.body.begin(), part.body.end());
    return out;
  }

 private:
  const char* data(int accessor, int& count) const {
    const Json &a = json_["accessors"][accessor], &view = json_["bufferViews"][int(a["bufferView"])];
    count = a["count"];
    return glb_.data() + binary_ + std::size_t(view["byteOffset"]) + a.value("byteOffset", std::size_t{0});
  }
  template <class T>
  std::vector<T> numbers(int accessor, int width) const {
    int count = 0;
    const char* from = data(accessor, count);
    std::vector<T> out(static_cast<std::size_t>(count) * width);
    std::memcpy(out.data(), from, out.size() * sizeof(T));
    return out;
  }
  std::vector<Vector3d> points(const Json& primitive) const {
    std::vector<Vector3d> out;
    const auto all = numbers<float>(primitive["attributes"]["POSITION"], 3);
    for (std::size_t k = 0; k < all.size(); k += 3) out.emplace_back(all[k], all[k + 1], all[k + 2]);
    return out;
  }
  std::vector<std::array<int, 3>> triangles(const Json& primitive) const {
    std::vector<std::array<int, 3>> out;
    const auto all = numbers<std::uint32_t>(primitive["indices"], 1);
    for (std::size_t k = 0; k < all.size(); k += 3)
      out.push_back({int(all[k]), int(all[k + 1]), int(all[k + 2])});
    return out;
  }

  Part rigid(const Json& node, int body) const {
    const Json& primitive = json_["meshes"][int(node["mesh"])]["primitives"][0];
    Part part{node["name"], {}, points(primitive), triangles(primitive), {}};
    part.body.assign(part.points.size(), body);
    return part;
  }

  void add_blocks(const Json& node, std::vector<Part>& out) const {
    const Json& primitive = json_["meshes"][int(node["mesh"])]["primitives"][0];
    const std::vector<Vector3d> all = points(primitive);
    const auto joints = numbers<std::uint16_t>(primitive["attributes"]["JOINTS_0"], 4);
    const std::size_t blocks = all.size() / block_corners;
    std::vector<Part> parts(blocks);
    for (std::size_t k = 0; k < all.size(); ++k) {
      Part& part = parts[k / block_corners];
      part.body.push_back(joints[4 * k]);
      part.points.push_back(all[k] - rest_[joints[4 * k]]);
    }
    for (const auto& t : triangles(primitive)) {
      const int first = t[0] / block_corners;
      parts.at(first).triangles.push_back({t[0] % block_corners, t[1] % block_corners, t[2] % block_corners});
    }
    for (std::size_t k = 0; k < blocks; ++k) parts[k].name = "block " + std::to_string(k);
    out.insert(out.end(), parts.begin(), parts.end());
  }

  const std::string& glb_;
  Json json_;
  std::size_t binary_ = 0;
  std::vector<Vector3d> rest_;
};

// ---- penetration depth of two meshes

struct Mesh {
  std::vector<Vector3d> points;
  const std::vector<std::array<int, 3>>& triangles;
};

Mesh placed(const Part& part, const model::State& state) {
  Mesh out{{}, part.triangles};
  for (std::size_t k = 0; k < part.points.size(); ++k)
    out.points.push_back(state[part.body[k]].R * part.points[k] + state[part.body[k]].p);
  return out;
}

Vector3d nearest_on(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto on_edge = [&](const Vector3d& u, const Vector3d& v) -> Vector3d {
    const Vector3d d = v - u;
    return u + std::clamp((p - u).dot(d) / d.squaredNorm(), 0.0, 1.0) * d;
  };
  const Vector3d n = (b - a).cross(c - a);
  if (n.squaredNorm() > 0) {
    const Vector3d foot = p - (p - a).dot(n) / n.squaredNorm() * n;
    if ((b - a).cross(foot - a).dot(n) >= 0 && (c - b).cross(foot - b).dot(n) >= 0 &&
        (a - c).cross(foot - c).dot(n) >= 0)
      return foot;
  }
  Vector3d best = on_edge(a, b);
  for (const Vector3d& q : {on_edge(b, c), on_edge(c, a)})
    if ((q - p).norm() < (best - p).norm()) best = q;
  return best;
}

double distance_to(const Mesh& mesh, const Vector3d& p) {
  double least = INFINITY;
  for (const auto& [a, b, c] : mesh.triangles)
    least = std::min(least, (nearest_on(p, mesh.points[a], mesh.points[b], mesh.points[c]) - p).norm());
  return least;
}

/// Sums the solid angles of the triangles seen from the point: 4 pi inside, 0 outside.
bool is_inside(const Mesh& mesh, const Vector3d& p) {
  double angle = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d a = mesh.points[i] - p, b = mesh.points[j] - p, c = mesh.points[k] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle > 2 * M_PI;
}

/// Computes where a segment crosses a mesh, as shares of its length, with 0 and 1.
std::vector<double> cuts(const Mesh& mesh, const Vector3d& p, const Vector3d& q) {
  std::vector<double> out{0, 1};
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d& a = mesh.points[i];
    const Vector3d n = (mesh.points[j] - a).cross(mesh.points[k] - a);
    const double from = n.dot(p - a), to = n.dot(q - a);
    if (from * to >= 0) continue;
    const double at = from / (from - to);
    const Vector3d x = p + at * (q - p);
    if ((nearest_on(x, a, mesh.points[j], mesh.points[k]) - x).norm() < 1e-9) out.push_back(at);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Computes the largest depth of points on the first mesh's corners and edges inside the other mesh.
double depth_in(const Mesh& one, const Mesh& other) {
  double most = 0;
  const auto try_point = [&](const Vector3d& p) {
    if (is_inside(other, p)) most = std::max(most, distance_to(other, p));
  };
  for (const Vector3d& p : one.points) try_point(p);
  for (const auto& t : one.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (a > b) continue;
      const std::vector<double> at = cuts(other, one.points[a], one.points[b]);
      for (std::size_t c = 0; at.size() > 2 && c + 1 < at.size(); ++c)
        for (const double share : {0.25, 0.5, 0.75})
          try_point(one.points[a] + (at[c] + share * (at[c + 1] - at[c])) * (one.points[b] - one.points[a]));
    }
  return most;
}

// ---- folding

constexpr std::size_t piece_triangles =
    64;  // larger pieces are split, so that few pairs of triangles are compared

/// Triangles of a part that are near one another.
struct Piece {
  std::size_t part;
  std::vector<std::array<int, 3>> triangles;
  std::map<int, Eigen::AlignedBox3d> boxes = {};  // around the points of each body, relative to the body, mm
  Eigen::AlignedBox3d box = {};                   // around all of them
  double largest_step = 0;                        // largest motion of a point between two states, mm
  std::shared_ptr<Model> model = nullptr;         // empty for parts that change their shape
};

struct Sphere {
  Vector3d centre;
  double radius;
};

std::shared_ptr<Model> model_of(const std::vector<Vector3d>& points,
                                const std::vector<std::array<int, 3>>& triangles) {
  auto model = std::make_shared<Model>();
  std::vector<fcl::Triangle> all;
  for (const auto& [a, b, c] : triangles) all.emplace_back(a, b, c);
  model->beginModel();
  model->addSubModel(points, all);
  model->endModel();
  return model;
}

/// Halves triangles by their centroids, along the longest side of their box, until few are left in each piece.
void split(const Part& part, std::vector<std::array<int, 3>> triangles, std::size_t index,
           std::vector<Piece>& out) {
  if (triangles.size() <= piece_triangles) {
    out.push_back({index, std::move(triangles)});
    return;
  }
  const auto sum = [&](const std::array<int, 3>& t) -> Vector3d {
    return part.points[t[0]] + part.points[t[1]] + part.points[t[2]];
  };
  Eigen::AlignedBox3d box;
  for (const auto& t : triangles) box.extend(sum(t));
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
  std::nth_element(triangles.begin(), middle, triangles.end(),
                   [&](const auto& a, const auto& b) { return sum(a)[axis] < sum(b)[axis]; });
  split(part, {triangles.begin(), middle}, index, out);
  split(part, {middle, triangles.end()}, index, out);
}

class Folding {
 public:
  Folding(std::vector<Part> parts, int steps, const std::function<model::State(int)>& state)
      : parts_(std::move(parts)), steps_(steps) {
    for (int k = 0; k < steps; ++k) states_.push_back(state(k));
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const bool is_rigid = parts_[p].bodies.size() == 1;
      whole_.push_back({p, parts_[p].triangles});
      measure(whole_.back());
      std::vector<Piece>& pieces = pieces_.emplace_back();
      if (is_rigid) {
        split(parts_[p], parts_[p].triangles, p, pieces);
      } else {
        pieces = {whole_.back()};
      }
      for (Piece& piece : pieces) {
        measure(piece);
        if (is_rigid) piece.model = model_of(parts_[p].points, piece.triangles);
      }
    }
  }

  Crossing deepest(double enough_mm) {
    Crossing worst;
    worst.parts = static_cast<int>(parts_.size());
    for (std::size_t a = 0; a < parts_.size(); ++a)
      for (std::size_t b = a + 1; b < parts_.size(); ++b) {
        if (belong(parts_[a], parts_[b])) continue;
        const int from = first_near(whole_[a], whole_[b]);
        if (from >= steps_) continue;
        for (const Piece& one : pieces_[a])
          for (const Piece& other : pieces_[b]) {
            follow(one, other, from, enough_mm, worst);
            if (worst.mm > enough_mm) return worst;
          }
      }
    return worst;
  }

 private:
  /// Checks whether a block is paired with one of its bodies.
  static bool belong(const Part& a, const Part& b) {
    return a.bodies.size() != b.bodies.size() &&
           std::includes(b.bodies.begin(), b.bodies.end(), a.bodies.begin(), a.bodies.end());
  }

  /// Sets a piece's boxes and its largest step.
  void measure(Piece& piece) const {
    const Part& part = parts_[piece.part];
    for (const auto& triangle : piece.triangles)
      for (const int k : triangle) {
        piece.boxes[part.body[k]].extend(part.points[k]);
        piece.box.extend(part.points[k]);
      }
    double radius = 0;
    for (int corner = 0; corner < 8; ++corner)
      radius = std::max(radius, piece.box.corner(Eigen::AlignedBox3d::CornerType(corner)).norm());
    for (int k = 1; k < steps_; ++k)
      for (const int body : part.bodies) {
        const model::Pose &from = states_[k - 1][body], &to = states_[k][body];
        piece.largest_step =
            std::max(piece.largest_step, (to.p - from.p).norm() + (to.R - from.R).norm() * radius);
      }
  }

  /// Returns the FCL model and pose of a piece in one state.
  std::pair<std::shared_ptr<Model>, fcl::Transform3d> at(const Piece& piece, int step) const {
    const Part& part = parts_[piece.part];
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    if (!piece.model) return {model_of(placed(part, states_[step]).points, piece.triangles), pose};
    const model::Pose& there = states_[step][*part.bodies.begin()];
    pose.linear() = there.R;
    pose.translation() = there.p;
    return {piece.model, pose};
  }

  /// Returns a sphere around a piece in one state.
  Sphere sphere(const Piece& piece, int step) const {
    const Part& part = parts_[piece.part];
    if (part.bodies.size() == 1) {
      const model::Pose& there = states_[step][*part.bodies.begin()];
      return {there.R * piece.box.center() + there.p, piece.box.diagonal().norm() / 2};
    }
    Eigen::AlignedBox3d box;
    for (const Vector3d& p : placed(part, states_[step]).points) box.extend(p);
    return {box.center(), box.diagonal().norm() / 2};
  }
  double gap_of_spheres(const Piece& a, const Piece& b, int step) const {
    const Sphere one = sphere(a, step), other = sphere(b, step);
    return (one.centre - other.centre).norm() - one.radius - other.radius;
  }

  /// Returns the first step at which the spheres around two parts are near each other.
  int first_near(const Piece& a, const Piece& b) const {
    for (int step = 0; step < steps_;) {
      const double gap = gap_of_spheres(a, b, step);
      if (!(gap > a.largest_step + b.largest_step)) return step;
      step = next_step(a, b, step, gap);
    }
    return steps_;
  }

  void follow(const Piece& a, const Piece& b, int from, double enough_mm, Crossing& worst) const {
    for (int step = from; step < steps_;) {
      double gap = gap_of_spheres(a, b, step);
      if (!(gap > a.largest_step + b.largest_step)) {
        gap = distance(a, b, step);
        ++worst.tests;
      }
      if (!(gap > 0)) {
        const Part &first = parts_[a.part], &second = parts_[b.part];
        const Mesh one = placed(first, states_[step]), other = placed(second, states_[step]);
        const double deep = std::max(depth_in(one, other), depth_in(other, one));
        if (deep > worst.mm) {
          worst.mm = deep;
          worst.first = first.name;
          worst.second = second.name;
          worst.step = step;
        }
        if (worst.mm > enough_mm) return;
      }
      step = next_step(a, b, step, gap);
    }
  }

  /// Returns the next step at which two pieces may touch: until then they move by less than their gap.
  int next_step(const Piece& a, const Piece& b, int step, double gap) const {
    const double each = a.largest_step + b.largest_step;
    double left = gap;
    int next = step;
    do {
      next += std::max(1, each > 0 ? static_cast<int>(std::min(1e6, std::floor(left / each))) : steps_);
      if (next < steps_) left = gap - relative_motion(a, b, step, next);
    } while (next < steps_ && left > 0);
    return next;
  }

  /// Bounds how much two pieces approach each other between two steps, mm: the sum of the largest displacements of
  /// their points in the frame of a body. A displacement is affine in the point, so it is largest at a corner of a box.
  double relative_motion(const Piece& a, const Piece& b, int from, int to) const {
    const int frame = *parts_[a.part].bodies.begin();
    double sum = 0;
    for (const Piece* piece : {&a, &b}) {
      double most = 0;
      for (const auto& [body, box] : piece->boxes) {
        if (body == frame) continue;
        const model::Pose before = seen_from(frame, body, from), after = seen_from(frame, body, to);
        const Eigen::Matrix3d turned = after.R - before.R;
        const Vector3d moved = after.p - before.p;
        for (int corner = 0; corner < 8; ++corner) {
          const Vector3d point = box.corner(Eigen::AlignedBox3d::CornerType(corner));
          most = std::max(most, (turned * point + moved).norm());
        }
      }
      sum += most;
    }
    return sum;
  }

  /// Returns the pose of a body in the frame of another.
  model::Pose seen_from(int frame, int body, int step) const {
    const model::Pose &at = states_[step][frame], &pose = states_[step][body];
    model::Pose out;
    out.R = at.R.transpose() * pose.R;
    out.p = at.R.transpose() * (pose.p - at.p);
    return out;
  }

  double distance(const Piece& a, const Piece& b, int step) const {
    const auto [one, at_one] = at(a, step);
    const auto [other, at_other] = at(b, step);
    fcl::DistanceResultd result;
    return fcl::distance(one.get(), at_one, other.get(), at_other, fcl::DistanceRequestd(), result);
  }

  const std::vector<Part> parts_;
  const int steps_;
  std::vector<model::State> states_;
  std::vector<Piece> whole_;                // one for each part
  std::vector<std::vector<Piece>> pieces_;  // of each part
};

}  // namespace

Crossing fold_and_compare(const std::string& glb, int steps, const std::function<model::State(int)>& state,
                          double enough_mm) {
  return Folding(File(glb).parts(), steps, state).deepest(enough_mm);
}

}  // namespace kinetix::testing
