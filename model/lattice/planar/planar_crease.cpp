#include "model/lattice/planar/planar_crease.hpp"

#include <map>
#include <utility>

#include "model/base/algorithms.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

int class_a(const PlanarStructure& s, int hinge) {
  const auto [from, to] = s.graph.edges[hinge];
  return s.senses[from] > 0 ? from : to;
}

/// Returns the edge from sublattice A to sublattice B.
Vector2d from_sublattice_a(const PlanarStructure& s, int hinge) {
  return s.senses[s.graph.edges[hinge].from] * s.graph.along(hinge);
}

bool leans(const PlanarStructure& s, int hinge) {
  return !is_vertical(hinge_axis(hinged_wall(s, hinge).edge, s.hinges[hinge]));
}

/// Finds facets: bodies that are connected by upright hinges, numbered in the order of the bodies.
void find_facets(const PlanarStructure& s, const std::vector<bool>& leaning, PlanarCreases& out) {
  UnionFind pieces(s.graph.vertices.size());
  for (std::size_t h = 0; h < s.hinges.size(); ++h)
    if (!leaning[h]) pieces.unite(s.graph.edges[h].from, s.graph.edges[h].to);
  std::map<int, int> facets;
  for (int v = 0; v < static_cast<int>(s.graph.vertices.size()); ++v)
    out.facet_of.push_back(facets.try_emplace(pieces.find(v), static_cast<int>(facets.size())).first->second);
  out.facets = static_cast<int>(facets.size());
}

void sort_along(const PlanarStructure& s, PlanarCrease& crease) {
  const auto place = [&](int hinge) {
    const auto [from, to] = s.graph.edges[hinge];
    return crease.line.dot(s.graph.vertices[from] + s.graph.vertices[to]);
  };
  std::stable_sort(crease.hinges.begin(), crease.hinges.end(),
                   [&](int a, int b) { return place(a) < place(b); });
}

/// Walls of a shortest path from one vertex to another, +1 for walls traversed from their first vertex.
class ShortestPaths {
 public:
  explicit ShortestPaths(const PlanarGraph& graph) : graph_(graph), edges_at_(graph.vertices.size()) {
    for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e)
      for (const int end : {graph.edges[e].from, graph.edges[e].to}) edges_at_[end].push_back(e);
  }

  std::vector<std::pair<int, int>> between(int start, int goal) const {
    std::map<int, int> came_by = {{start, -1}};
    std::vector<int> open = {start};
    for (std::size_t k = 0; k < open.size() && !came_by.count(goal); ++k)
      for (const int e : edges_at_[open[k]])
        if (came_by.try_emplace(other_end(e, open[k]), e).second) open.push_back(other_end(e, open[k]));
    std::vector<std::pair<int, int>> walls;
    for (int at = goal; at != start; at = other_end(walls.back().first, at))
      walls.emplace_back(came_by.at(at), graph_.edges[came_by.at(at)].to == at ? 1 : -1);
    return walls;
  }

 private:
  int other_end(int edge, int vertex) const {
    return graph_.edges[edge].from + graph_.edges[edge].to - vertex;
  }

  const PlanarGraph& graph_;
  std::vector<std::vector<int>> edges_at_;
};

/// Returns the condition that a hinge is on the line through the one before: rates by s of both.
WallCondition on_line(const PlanarStructure& s, int before, int hinge, const Vector2d& across) {
  const auto point = [&](int h) {
    const auto [from, to] = s.graph.edges[h];
    return Vector2d((s.graph.vertices[from] + s.graph.vertices[to] + s.senses[from] * parallel_edge(s, h)) /
                    2);
  };
  return {{{hinge, across.dot(from_sublattice_a(s, hinge)) / 2},
           {before, -across.dot(from_sublattice_a(s, before)) / 2}},
          -across.dot(point(hinge) - point(before))};
}

/// Returns the condition that a hinge stays on the line in motion, by the difference of the q of both hinges along
/// the line. The y of their vertices follow from the walls between them.
WallCondition stays_on_line(const PlanarStructure& s, const ShortestPaths& ways, int before, int hinge,
                            const Vector2d& along) {
  const auto half = [&](int h) {
    return Vector2d((from_sublattice_a(s, h) + s.senses[s.graph.edges[h].from] * parallel_edge(s, h)) / 2);
  };
  WallCondition out{{{hinge, along.dot(from_sublattice_a(s, hinge)) / 2},
                     {before, -along.dot(from_sublattice_a(s, before)) / 2}},
                    -along.dot(half(hinge) - half(before))};
  for (const auto& [wall, walked] : ways.between(class_a(s, before), class_a(s, hinge))) {
    out.parts.push_back({wall, walked * along.dot(s.graph.along(wall))});
    out.missing -= walked * along.dot(parallel_edge(s, wall));
  }
  return out;
}

}  // namespace

Vector2d lean(const PlanarStructure& structure, int hinge) {
  const Eigen::Vector3d axis = hinge_axis(hinged_wall(structure, hinge).edge, structure.hinges[hinge]);
  return axis.head<2>() / axis.z();
}

void set_fold(PlanarStructure& s, int hinge, const Vector2d& line, double multiplier) {
  const Vector2d edge = s.graph.along(hinge), along = edge.normalized();
  const auto [from, to] = s.graph.edges[hinge];
  const int left = turned_by_90(line).dot(edge) > 0 ? to : from;
  const Vector2d leant = s.senses[left] * multiplier * line.normalized();
  s.hinges[hinge].beta = -std::atan(turned_by_90(along).dot(leant));
  s.hinges[hinge].alpha = std::atan2(1, along.dot(leant) * std::cos(s.hinges[hinge].beta));
}

Vector2d line_of(const PlanarStructure& s, const PlanarCreases& creases, int hinge) {
  const int from = s.graph.edges[hinge].from;
  const int near = creases.list[creases.of_hinge[hinge]].from;
  const int sense = creases.facet_of[from] == near ? s.senses[from] : -s.senses[from];
  return sense * lean(s, hinge);
}

PlanarCreases find_creases(const PlanarStructure& s) {
  PlanarCreases out;
  std::vector<bool> leaning;
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) leaning.push_back(leans(s, h));
  find_facets(s, leaning, out);
  out.of_hinge.assign(s.hinges.size(), -1);
  std::map<std::pair<int, int>, int> between;
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
    if (!leaning[h]) continue;
    const std::pair facets =
        std::minmax(out.facet_of[s.graph.edges[h].from], out.facet_of[s.graph.edges[h].to]);
    if (facets.first == facets.second) {
      out.loose.push_back(h);
      continue;
    }
    const auto [found, is_new] = between.try_emplace(facets, static_cast<int>(out.list.size()));
    out.of_hinge[h] = found->second;
    if (is_new) {
      PlanarCrease& crease = out.list.emplace_back();
      crease.from = facets.first;
      crease.to = facets.second;
      crease.line = line_of(s, out, h);
    }
    out.list[found->second].hinges.push_back(h);
  }
  for (PlanarCrease& crease : out.list) sort_along(s, crease);
  return out;
}

Eigen::Vector3d HingePath::at(double theta) const {
  const Vector2d now = std::cos(theta) * p + std::sin(theta) * turned_by_90(q);
  return {now.x(), now.y(), 0};
}

HingePath hinge_path(const PlanarStructure& s, const ParallelDrawing& y, int hinge) {
  const int a = class_a(s, hinge), b = s.graph.edges[hinge].from + s.graph.edges[hinge].to - a;
  const auto& x = s.graph.vertices;
  return {(x[a] + x[b] + y[b] - y[a]) / 2, (x[b] - x[a] + y[b] + y[a]) / 2};
}

double CreaseOffset::worst() const { return larger(at_rest, moving); }

CreaseOffset left_line(const PlanarStructure& s, const ParallelDrawing& y, const PlanarCrease& crease) {
  const Vector2d along = crease.line.normalized();
  const HingePath first = hinge_path(s, y, crease.hinges.front());
  CreaseOffset worst;
  for (const int h : crease.hinges) {
    const HingePath path = hinge_path(s, y, h);
    const CreaseOffset left{h, std::abs(turned_by_90(along).dot(path.p - first.p)),
                            std::abs(along.dot(path.q - first.q))};
    if (!(left.worst() <= worst.worst())) worst = left;
  }
  return worst;
}

std::vector<WallCondition> straight_lines(const PlanarStructure& s, const PlanarCreases& creases) {
  const ShortestPaths ways(s.graph);
  std::vector<WallCondition> all;
  for (const PlanarCrease& crease : creases.list) {
    const Vector2d along = crease.line.normalized();
    for (std::size_t k = 1; k < crease.hinges.size(); ++k) {
      const int before = crease.hinges[k - 1], hinge = crease.hinges[k];
      all.push_back(on_line(s, before, hinge, turned_by_90(along)));
      all.push_back(stays_on_line(s, ways, before, hinge, along));
    }
  }
  return all;
}

}  // namespace kinetix::model
