#include "optim/outline/panel_symmetry.hpp"

#include <cmath>
#include <map>

namespace kinetix::optim {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double same_outline = 2e-3;  // of the diagonal: drawings are not more symmetric
constexpr double same_vertex = 1e-6;   // cell edges: rounding
constexpr double vertex_bin = 0.1;     // cell edges: below half the distance of vertices

/// Finds vertices by their place.
class PlaceFinder {
 public:
  explicit PlaceFinder(const std::vector<Vector2d>& places) : places_(places) {
    for (int v = 0; v < static_cast<int>(places.size()); ++v) bins_.emplace(find_bin(places[v]), v);
  }

  /// Returns the vertex at a place, or -1.
  int at(const Vector2d& place) const {
    const auto [x, y] = find_bin(place);
    for (long i = x - 1; i <= x + 1; ++i)
      for (long j = y - 1; j <= y + 1; ++j) {
        const auto found = bins_.find({i, j});
        if (found != bins_.end() && (places_[found->second] - place).norm() < same_vertex)
          return found->second;
      }
    return -1;
  }

 private:
  static std::pair<long, long> find_bin(const Vector2d& place) {
    return {std::lround(place.x() / vertex_bin), std::lround(place.y() / vertex_bin)};
  }

  const std::vector<Vector2d>& places_;
  std::map<std::pair<long, long>, int> bins_;
};

bool maps_onto_itself(const targets::Outline& outline, const Matrix2d& map) {
  for (const Vector2d& p : outline.points()) {
    const Vector2d image = outline.middle() + map * (p - outline.middle());
    if (outline.nearest(image).distance > same_outline * outline.diagonal()) return false;
  }
  return true;
}

/// Returns the images of vertices and walls, or no vertices if the panel does not have the symmetry.
PanelSymmetry find_images(const model::PlanarGraph& graph, const PlaceFinder& finder, const Matrix2d& map) {
  PanelSymmetry out{map, {}, {}};
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& p : graph.vertices) middle += p / static_cast<double>(graph.vertices.size());
  std::vector<int> vertices;
  for (const Vector2d& p : graph.vertices) {
    vertices.push_back(finder.at(middle + map * (p - middle)));
    if (vertices.back() < 0) return out;
  }
  std::map<std::pair<int, int>, int> walls;
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e)
    walls[std::minmax({graph.edges[e].from, graph.edges[e].to})] = e;
  for (const model::GraphEdge& e : graph.edges) {
    const auto image = walls.find(std::minmax({vertices[e.from], vertices[e.to]}));
    if (image == walls.end()) return out;
    out.edges.push_back(image->second);
  }
  out.vertices = std::move(vertices);
  return out;
}

bool contains(const std::vector<PanelSymmetry>& all, const Matrix2d& map) {
  return map.isIdentity(same_vertex) || std::any_of(all.begin(), all.end(), [&](const PanelSymmetry& s) {
           return s.map.isApprox(map, same_vertex);
         });
}

/// Removes symmetries until products of the rest are among them. Products of nearly symmetric outlines may be missing.
void keep_group(std::vector<PanelSymmetry>& all) {
  const auto is_open = [&](const PanelSymmetry& s) {
    return std::any_of(all.begin(), all.end(),
                       [&](const PanelSymmetry& other) { return !contains(all, s.map * other.map); });
  };
  for (auto open = std::find_if(all.rbegin(), all.rend(), is_open); open != all.rend();
       open = std::find_if(all.rbegin(), all.rend(), is_open))
    all.erase(std::next(open).base());
}

}  // namespace

std::vector<PanelSymmetry> find_symmetries(const model::PlanarStructure& panel,
                                           const targets::Outline& folded, const targets::Outline* flat) {
  constexpr int turns = 12;
  const PlaceFinder finder(panel.graph.vertices);
  std::vector<PanelSymmetry> all;
  const auto add = [&](const Matrix2d& map) {
    PanelSymmetry found = find_images(panel.graph, finder, map);
    if (found.vertices.empty() || !maps_onto_itself(folded, map) || (flat && !maps_onto_itself(*flat, map)))
      return;
    all.push_back(std::move(found));
  };
  const Matrix2d mirror = Vector2d(1, -1).asDiagonal();
  for (int k = 0; k < turns; ++k) {
    const Matrix2d turn = Eigen::Rotation2Dd(2 * pi * k / turns).toRotationMatrix();
    if (k > 0) add(turn);
    add(turn * mirror);
  }
  keep_group(all);
  return all;
}

void symmetrise(const std::vector<PanelSymmetry>& symmetries, const Vector2d& middle,
                std::vector<Vector2d>& places) {
  if (symmetries.empty()) return;
  const std::vector<Vector2d> before = places;
  for (std::size_t v = 0; v < places.size(); ++v) {
    Vector2d sum = before[v] - middle;
    for (const PanelSymmetry& s : symmetries) sum += s.map.transpose() * (before[s.vertices[v]] - middle);
    places[v] = middle + sum / static_cast<double>(symmetries.size() + 1);
  }
}

}  // namespace kinetix::optim
