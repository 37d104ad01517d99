#pragma once

#include <fmt/format.h>

#include "model/lattice/origami/quad_mesh.hpp"

/// Crease patterns as files, for tests.
namespace kinetix::testing {

/// Content of a crease pattern, to be changed and written as FOLD, SVG or `.cp`.
struct CreaseText {
  struct Edge {
    int from, to;
    std::string letter;
  };
  std::vector<std::string> points;  ///< of vertices_coords
  std::vector<Eigen::Vector2d> vertices;
  std::vector<Edge> edges;
  std::vector<std::vector<int>> faces = {};
  std::string more = {};  ///< keys of the file, each with a comma behind it

  std::string fold() const {
    std::string ends, letters, corners;
    for (const Edge& edge : edges) {
      ends += fmt::format("{}[{}, {}]", ends.empty() ? "" : ", ", edge.from, edge.to);
      letters += fmt::format("{}\"{}\"", letters.empty() ? "" : ", ", edge.letter);
    }
    for (const auto& face : faces)
      corners += fmt::format("{}[{}]", corners.empty() ? "" : ", ", fmt::join(face, ", "));
    const std::string listed = faces.empty() ? "" : fmt::format(", \"faces_vertices\": [{}]", corners);
    return fmt::format(
        "{{{}\"vertices_coords\": [{}], \"edges_vertices\": [{}], \"edges_assignment\": [{}]{}}}", more,
        fmt::join(points, ", "), ends, letters, listed);
  }

  /// Writes y downwards, one line per crease. @param size attributes of the page
  std::string svg(const std::string& size = "viewBox='0 0 10 10'") const {
    std::string lines;
    for (const Edge& edge : edges) {
      const Eigen::Vector2d &a = vertices[edge.from], &b = vertices[edge.to];
      const char* colour = edge.letter == "M"   ? "red"
                           : edge.letter == "V" ? "#00f"
                           : edge.letter == "F" ? "rgb(255, 255, 0)"
                           : edge.letter == "U" ? "magenta"
                           : edge.letter == "C" ? "green"
                                                : "#000000";
      lines += fmt::format("<line x1='{:.9g}' y1='{:.9g}' x2='{:.9g}' y2='{:.9g}' stroke='{}'/>\n", a.x(),
                           -a.y(), b.x(), -b.y(), colour);
    }
    return fmt::format("<svg xmlns='http://www.w3.org/2000/svg' {}>\n{}</svg>\n", size, lines);
  }

  std::string cp() const {
    std::string lines;
    for (const Edge& edge : edges) {
      const Eigen::Vector2d &a = vertices[edge.from], &b = vertices[edge.to];
      const int kind = edge.letter == "B" ? 1 : edge.letter == "M" ? 2 : edge.letter == "V" ? 3 : 0;
      lines += fmt::format("{} {:.12g} {:.12g} {:.12g} {:.12g}\n", kind, a.x(), -a.y(), b.x(), -b.y());
    }
    return lines;
  }

  /// Writes the letter in place of those of all edges for which `is_changed` of the edge is true.
  template <class Choice>
  void letter(const std::string& by, const Choice& is_changed) {
    for (Edge& edge : edges)
      if (is_changed(edge)) edge.letter = by;
  }
};

/// Writes the points of a mesh with `digits` digits after the point. Vertices are numbered row by row.
inline CreaseText crease_text(const model::QuadMesh& m, int digits = 9) {
  CreaseText out;
  const auto number = [&](int i, int j) { return static_cast<int>(m.vertex(i, j)); };
  const auto letter = [](double c) { return c > 0 ? "V" : c < 0 ? "M" : "B"; };
  for (const Eigen::Vector2d& p : m.vertices) {
    out.points.push_back(fmt::format("[{:.{}f}, {:.{}f}]", p.x(), digits, p.y(), digits));
    out.vertices.push_back(p);
  }
  for (int j = 0; j <= m.rows; ++j)
    for (int i = 0; i <= m.columns; ++i) {
      if (i < m.columns)
        out.edges.push_back({number(i, j), number(i + 1, j),
                             letter(j > 0 && j < m.rows ? m.level[m.level_crease(i, j)] : 0)});
      if (j < m.rows)
        out.edges.push_back({number(i, j), number(i, j + 1),
                             letter(i > 0 && i < m.columns ? m.rising[m.rising_crease(i, j)] : 0)});
      if (i < m.columns && j < m.rows)
        out.faces.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return out;
}

}  // namespace kinetix::testing
