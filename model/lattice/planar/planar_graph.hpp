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

/// A drawing of walls in the plane: vertices, and straight edges between them. Lengths are in cell edges.
struct PlanarGraph {
  std::vector<Eigen::Vector2d> vertices;
  std::vector<GraphEdge> edges;

  Eigen::Vector2d along(int edge) const { return vertices[edges[edge].to] - vertices[edges[edge].from]; }
};

/// A bounded face: the loop of walls around it, counter-clockwise.
struct GraphFace {
  std::vector<int> vertices;
  std::vector<int> edges;  ///< edge k joins vertices k and k + 1, the last edge the last vertex to the first
};

/// Returns +1 if the loop traverses its wall k from that wall's first vertex to its second, -1 in reverse.
inline int walked(const PlanarGraph& graph, const GraphFace& face, std::size_t k) {
  return graph.edges[face.edges[k]].from == face.vertices[k] ? 1 : -1;
}

/// Returns "[from, to]", the name of a wall in messages.
std::string to_string(const GraphEdge& edge);
/// Returns the name of a face in messages: its vertices.
std::string to_string(const GraphFace& face);

/// Returns the bounded faces of a drawing, each once. A wall that ends inside a face is traversed in both directions,
/// and is omitted.
/// @pre no edges cross, none has length zero
std::vector<GraphFace> bounded_faces(const PlanarGraph& graph);

/// Returns the walk around the outside, counter-clockwise, with the vertices and edges of a face: edge k joins
/// vertices k and k + 1. A single projecting wall is traversed in both directions.
GraphFace outer_boundary(const PlanarGraph& graph);

/// Returns +1 (sublattice A) or -1 for each vertex, different at both ends of every edge; the first vertex has +1.
/// @throws InvalidInput for a loop of an odd number of walls, naming the face and its vertices
std::vector<int> senses(const PlanarGraph& graph, const std::vector<GraphFace>& faces);

/// Checks a graph. @throws InvalidInput, naming edges and vertices. It needs two vertices or more, distinct and
/// finite, in one connected piece. Edges must have a positive length, existing ends and no duplicates, and may meet
/// only at their ends
void validate(const PlanarGraph& graph);

}  // namespace kinetix::model
