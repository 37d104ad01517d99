#include "model/lattice/planar/crease_pattern.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/base/polygon.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Vertex of the pattern: a body at the boundary, the hinge at which a crease reaches the boundary, or the face in
/// which creases meet.
struct Corner {
  enum class Kind { body, hinge, face };
  Kind kind = Kind::body;
  int index = 0;
  auto operator<=>(const Corner&) const = default;
};

[[noreturn]] void refuse(const PlanarStructure& s, int hinge) {
  throw InvalidInput("the facets beside wall " + to_string(s.graph.edges[hinge]) + " are no polygons");
}

/// Returns the intersection of the lines of two creases at theta, in the plane of the sheet without its folds.
Vector2d meeting(const PlanarStructure& s, const Redrawing& y, const PlanarCrease& a, const PlanarCrease& b,
                 double theta) {
  const Vector2d p = hinge_path(s, y, a.hinges.front()).at(theta).head<2>(),
                 q = hinge_path(s, y, b.hinges.front()).at(theta).head<2>();
  Eigen::Matrix2d lines;
  lines << a.line.normalized(), -b.line.normalized();
  return p + a.line.normalized() * (lines.inverse() * (q - p)).x();
}

class CreaseDrawing {
 public:
  CreaseDrawing(const PlanarStructure& s, const Redrawing& y) : s_(s), y_(y), creases_(find_creases(s)) {
    walk_rim();
    add_creases();
  }

  CreasePattern at(double theta) {
    CreasePattern out;
    out.edges = edges_;
    for (int facet = 0; facet < creases_.facets; ++facet) out.facets.push_back(polygon(facet));
    const auto frames = facet_frames(s_, y_, creases_, facet_tree(creases_), theta);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Vector2d flat = place(corners_[k], 0), now = place(corners_[k], theta);
      out.flat.push_back(s_.size.edge_mm * flat);
      out.folded.push_back(frames[facet_of_[k]] * (s_.size.edge_mm * Vector3d(now.x(), now.y(), 0)));
    }
    return out;
  }

 private:
  int number(const Corner& corner, int facet) {
    const auto [found, is_new] = known_.try_emplace(corner, static_cast<int>(corners_.size()));
    if (is_new) {
      corners_.push_back(corner);
      facet_of_.push_back(facet);
    }
    return found->second;
  }

  void join(int from, int to, int facet) {
    sides_[facet].push_back({from, to});
    edges_.push_back({from, to, -1, 0});
  }

  void walk_rim() {
    sides_.resize(creases_.facets);
    const GraphFace rim = outer_rim(s_.graph);
    for (std::size_t k = 0; k < rim.edges.size(); ++k) {
      const int here = rim.vertices[k], next = rim.vertices[(k + 1) % rim.vertices.size()],
                hinge = rim.edges[k];
      const int facet = creases_.facet_of[here], beyond = creases_.facet_of[next];
      const int from = number({Corner::Kind::body, here}, facet),
                to = number({Corner::Kind::body, next}, beyond);
      if (creases_.of_hinge[hinge] < 0) {
        join(from, to, facet);
        continue;
      }
      if (!at_rim_.insert(hinge).second) refuse(s_, hinge);
      const int between = number({Corner::Kind::hinge, hinge}, facet);
      join(from, between, facet);
      join(between, to, beyond);
    }
  }

  /// Adds the ends of creases: faces where they meet others, and hinges where they reach the boundary.
  void add_creases() {
    std::vector<std::vector<int>> ends(creases_.list.size());
    const auto end = [&](int crease, const Corner& corner) {
      ends[crease].push_back(number(corner, creases_.list[crease].from));
    };
    for (const int hinge : at_rim_) end(creases_.of_hinge[hinge], {Corner::Kind::hinge, hinge});
    for (int f = 0; f < static_cast<int>(s_.faces.size()); ++f) {
      std::set<int> here;
      for (const int e : s_.faces[f].edges)
        if (creases_.of_hinge[e] >= 0) here.insert(creases_.of_hinge[e]);
      if (here.size() < 2) continue;
      meets_[f] = {here.begin(), here.end()};
      for (const int crease : here) end(crease, {Corner::Kind::face, f});
    }
    for (std::size_t c = 0; c < ends.size(); ++c) {
      const PlanarCrease& crease = creases_.list[c];
      if (ends[c].size() != 2) refuse(s_, crease.hinges.front());
      edges_.push_back({ends[c][0], ends[c][1], static_cast<int>(c), fold_of(crease)});
      for (const int facet : {crease.from, crease.to}) sides_[facet].push_back({ends[c][0], ends[c][1]});
    }
  }

  /// Returns the fold multiplier by the sign rule of set_fold(): positive if the facet to the left of the line rises.
  double fold_of(const PlanarCrease& crease) const {
    const auto [from, to] = s_.graph.edges[crease.hinges.front()];
    const int near = creases_.facet_of[from] == crease.from ? from : to, far = from + to - near;
    const Vector2d across = s_.graph.vertices[near] - s_.graph.vertices[far];
    const Vector2d left(-crease.line.y(), crease.line.x());
    return (left.dot(across) > 0 ? 1 : -1) * crease.line.norm();
  }

  std::vector<int> polygon(int facet) const {
    std::map<int, std::vector<int>> beside;
    for (const auto& [a, b] : sides_[facet]) {
      beside[a].push_back(b);
      beside[b].push_back(a);
    }
    const auto fits = [](const auto& entry) { return entry.second.size() == 2; };
    if (beside.size() < 3 || !std::all_of(beside.begin(), beside.end(), fits)) refuse(s_, hinge_of(facet));
    std::vector<int> loop = {beside.begin()->first};
    for (int before = -1, here = loop[0];;) {
      const std::vector<int>& two = beside.at(here);
      const int next = two[0] == before ? two[1] : two[0];
      if (next == loop[0]) break;
      loop.push_back(next);
      before = here;
      here = next;
    }
    if (loop.size() != beside.size()) refuse(s_, hinge_of(facet));
    if (signed_area(loop.size(), [&](std::size_t k) { return place(corners_[loop[k]], 0); }) < 0)
      std::reverse(loop.begin(), loop.end());
    return loop;
  }

  int hinge_of(int facet) const {
    for (int h = 0; h < static_cast<int>(s_.hinges.size()); ++h)
      if (creases_.facet_of[s_.graph.edges[h].from] == facet) return h;
    return 0;
  }

  /// Returns the position of a corner at theta in the unfolded plane, cell edges.
  Vector2d place(const Corner& corner, double theta) const {
    if (corner.kind == Corner::Kind::hinge) return hinge_path(s_, y_, corner.index).at(theta).head<2>();
    if (corner.kind == Corner::Kind::body)
      return redrawn_pose(s_.graph.vertices[corner.index], y_[corner.index], s_.senses[corner.index], theta)
          .p.head<2>();
    const std::vector<int>& here = meets_.at(corner.index);
    const PlanarCrease &first = creases_.list[here[0]], *other = &creases_.list[here[1]];
    const auto steep = [&](const PlanarCrease& c) {
      const Vector2d a = first.line.normalized(), b = c.line.normalized();
      return std::abs(a.x() * b.y() - a.y() * b.x());
    };
    for (const int c : here)
      if (steep(creases_.list[c]) > steep(*other)) other = &creases_.list[c];
    return meeting(s_, y_, first, *other, theta);
  }

  const PlanarStructure& s_;
  const Redrawing& y_;
  PlanarCreases creases_;
  std::map<Corner, int> known_;
  std::vector<Corner> corners_;
  std::vector<int> facet_of_;  ///< one of the facets at each corner
  std::set<int> at_rim_;
  std::map<int, std::vector<int>> meets_;
  std::vector<std::vector<std::pair<int, int>>> sides_;
  std::vector<CreasePattern::Edge> edges_;
};

}  // namespace

CreasePattern crease_pattern(const PlanarStructure& structure, const Redrawing& y, double theta) {
  return CreaseDrawing(structure, y).at(theta);
}

}  // namespace kinetix::model
