#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace kinetix::model {

/// A wall as an edge of a graph, from one vertex to the other.
struct GraphEdge {
  int from = 0, to = 0;
  bool operator==(const GraphEdge&) const = default;
};

/// A drawing of walls in the plane: vertices, and straight edges between them. Lengths in cell edges.
struct PlanarGraph {
  std::vector<Eigen::Vector2d> vertices;
  std::vector<GraphEdge> edges;

  Eigen::Vector2d along(int edge) const { return vertices[edges[edge].to] - vertices[edges[edge].from]; }
};

/// A bounded face: the loop of walls round it, counter-clockwise.
struct GraphFace {
  std::vector<int> vertices;
  std::vector<int> edges;  ///< edge k joins vertices k and k + 1, the last edge the last vertex to the first
};

/// +1 where the loop takes its wall k from that wall's first vertex to its second, -1 where the other way.
inline int walked(const PlanarGraph& graph, const GraphFace& face, std::size_t k) {
  return graph.edges[face.edges[k]].from == face.vertices[k] ? 1 : -1;
}

/// "[from, to]", as messages name a wall.
std::string to_string(const GraphEdge& edge);
/// As messages name it: by its vertices.
std::string to_string(const GraphFace& face);

/// The bounded faces of a drawing, each once. A wall that ends in the face is walked there and back, and left
/// out.
/// @pre no edges cross, none has length zero
std::vector<GraphFace> bounded_faces(const PlanarGraph& graph);

/// The walk round the outside, counter-clockwise, by vertices and edges as of a face: edge k joins vertices k and
/// k + 1. What stands out as a single wall is walked there and back.
GraphFace outer_rim(const PlanarGraph& graph);

/// +1 (class A) or -1 for each vertex, different at both ends of every edge; the first vertex has +1.
/// @throws InvalidInput for a loop of an odd number of walls, naming the face and its vertices
std::vector<int> senses(const PlanarGraph& graph, const std::vector<GraphFace>& faces);

/// @throws InvalidInput, naming edges and vertices, for fewer than two vertices, an edge of length zero or to one
/// that does not exist, one that is listed twice, edges that cross or touch other than at their ends,
/// vertices that coincide, coordinates that are not finite, or a graph in more than one piece
void validate(const PlanarGraph& graph);

}  // namespace kinetix::model
