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
  double radius = 0;  // largest distance of a point from its body's rest position, mm
  std::map<int, Eigen::AlignedBox3d> boxes;  // around the points of each body, relative to its rest position, mm
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
    for (Part& part : out) {
      part.bodies.insert(part.body.begin(), part.body.end());
      for (const Vector3d& p : part.points) part.radius = std::max(part.radius, p.norm());
      for (std::size_t k = 0; k < part.points.size(); ++k) part.boxes[part.body[k]].extend(part.points[k]);
    }
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

class Folding {
 public:
  Folding(std::vector<Part> parts, int steps, const std::function<model::State(int)>& state)
      : parts_(std::move(parts)), steps_(steps), largest_step_(parts_.size()) {
    for (int k = 0; k < steps; ++k) {
      states_.push_back(state(k));
      if (k > 0) note_step(states_[k - 1], states_[k]);
    }
    for (const Part& part : parts_)
      models_.push_back(part.bodies.size() == 1 ? model_of(part.points, part) : nullptr);
  }

  Crossing deepest(double enough_mm) {
    Crossing worst;
    worst.parts = static_cast<int>(parts_.size());
    for (std::size_t a = 0; a < parts_.size(); ++a)
      for (std::size_t b = a + 1; b < parts_.size(); ++b) {
        if (belong(parts_[a], parts_[b])) continue;
        follow(a, b, enough_mm, worst);
        if (worst.mm > enough_mm) return worst;
      }
    return worst;
  }

 private:
  /// Checks whether a block is paired with one of its bodies.
  static bool belong(const Part& a, const Part& b) {
    return a.bodies.size() != b.bodies.size() &&
           std::includes(b.bodies.begin(), b.bodies.end(), a.bodies.begin(), a.bodies.end());
  }

  void note_step(const model::State& from, const model::State& to) {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (const int body : parts_[p].bodies) {
        const double turned = (to[body].R - from[body].R).norm(), moved = (to[body].p - from[body].p).norm();
        largest_step_[p] = std::max(largest_step_[p], moved + turned * parts_[p].radius);
      }
  }

  static std::shared_ptr<Model> model_of(const std::vector<Vector3d>& points, const Part& part) {
    auto model = std::make_shared<Model>();
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : part.triangles) triangles.emplace_back(a, b, c);
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    return model;
  }

  /// Returns the FCL model and pose of a part in one state.
  std::pair<std::shared_ptr<Model>, fcl::Transform3d> at(std::size_t p, int step) const {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    if (!models_[p]) return {model_of(placed(parts_[p], states_[step]).points, parts_[p]), pose};
    const model::Pose& there = states_[step][*parts_[p].bodies.begin()];
    pose.linear() = there.R;
    pose.translation() = there.p;
    return {models_[p], pose};
  }

  double gap_of_spheres(std::size_t a, std::size_t b, int step) const {
    const auto& one = states_[step][*parts_[a].bodies.begin()].p;
    const auto& other = states_[step][*parts_[b].bodies.begin()].p;
    return (one - other).norm() - reach(a, step) - reach(b, step);
  }
  /// Bounds the distance of a part's points from its first body, mm.
  double reach(std::size_t p, int step) const {
    double most = parts_[p].radius;
    for (const int body : parts_[p].bodies)
      most = std::max(most, parts_[p].radius +
                                (states_[step][body].p - states_[step][*parts_[p].bodies.begin()].p).norm());
    return most;
  }

  void follow(std::size_t a, std::size_t b, double enough_mm, Crossing& worst) {
    const double each = largest_step_[a] + largest_step_[b];
    for (int step = 0; step < steps_;) {
      double gap = gap_of_spheres(a, b, step);
      if (!(gap > each)) gap = distance(a, b, step);
      ++worst.tests;
      if (!(gap > 0)) {
        const Mesh one = placed(parts_[a], states_[step]), other = placed(parts_[b], states_[step]);
        const double deep = std::max(depth_in(one, other), depth_in(other, one));
        if (deep > worst.mm) {
          worst.mm = deep;
          worst.first = parts_[a].name;
          worst.second = parts_[b].name;
          worst.step = step;
        }
        if (worst.mm > enough_mm) return;
      }
      step = next_step(a, b, step, gap);
    }
  }

  /// Returns the next step at which the parts may touch: until then they move by less than their gap.
  int next_step(std::size_t a, std::size_t b, int step, double gap) const {
    const double each = largest_step_[a] + largest_step_[b];
    double left = gap;
    int next = step;
    do {
      next += std::max(1, each > 0 ? static_cast<int>(std::min(1e6, std::floor(left / each))) : steps_);
      if (next < steps_) left = gap - relative_motion(a, b, step, next);
    } while (next < steps_ && left > 0);
    return next;
  }

  /// Bounds how much two parts approach each other between two steps, mm: the sum of the largest displacements of their
  /// points in the frame of a body. A displacement is affine in the point, so it is largest at a corner of a box.
  double relative_motion(std::size_t a, std::size_t b, int from, int to) const {
    const int frame = *parts_[a].bodies.begin();
    double sum = 0;
    for (const Part* part : {&parts_[a], &parts_[b]}) {
      double most = 0;
      for (const auto& [body, box] : part->boxes) {
        if (body == frame) continue;
        const model::Pose before = seen_from(frame, body, from), after = seen_from(frame, body, to);
        const Eigen::Matrix3d turned = after.R - before.R;
        const Vector3d moved = after.p - before.p;
        for (int corner = 0; corner < 8; ++corner)
          most = std::max(most,
                          (turned * box.corner(Eigen::AlignedBox3d::CornerType(corner)) + moved).norm());
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

  double distance(std::size_t a, std::size_t b, int step) const {
    const auto [one, at_one] = at(a, step);
    const auto [other, at_other] = at(b, step);
    fcl::DistanceResultd result;
    return fcl::distance(one.get(), at_one, other.get(), at_other, fcl::DistanceRequestd(), result);
  }

  const std::vector<Part> parts_;
  const int steps_;
  std::vector<model::State> states_;
  std::vector<double> largest_step_;  // largest motion of each part between two states, mm
  std::vector<std::shared_ptr<Model>> models_;
};

}  // namespace

Crossing fold_and_compare(const std::string& glb, int steps, const std::function<model::State(int)>& state,
                          double enough_mm) {
  return Folding(File(glb).parts(), steps, state).deepest(enough_mm);
}

}  // namespace kinetix::testing
