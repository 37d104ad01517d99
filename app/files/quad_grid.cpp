#include "app/files/crease_pattern.hpp"

#include <fmt/format.h>
#include <map>

#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

/// Counts of what a mesh of quadrilaterals cannot have.
struct Misfits {
  std::map<std::size_t, std::size_t> faces;     ///< by number of corners, without those of 4
  std::map<std::size_t, std::size_t> vertices;  ///< inner ones by number of creases, without those of 4
  std::size_t cuts = 0;                         ///< cuts and lines of the boundary with faces on both sides
  int cut = -1;                                 ///< one of them

  bool is_empty() const { return faces.empty() && vertices.empty() && cuts == 0; }
};

Misfits find_misfits(const CreaseMesh& p) {
  Misfits out;
  for (const model::GraphFace& face : p.faces)
    if (face.vertices.size() != 4) ++out.faces[face.vertices.size()];
  const std::vector<int> faces = p.faces_of_edges();
  std::vector<std::size_t> creases(p.graph.vertices.size(), 0);
  std::vector<bool> is_inner(p.graph.vertices.size(), true);
  for (std::size_t e = 0; e < faces.size(); ++e) {
    for (const int v : {p.graph.edges[e].from, p.graph.edges[e].to}) {
      ++creases[v];
      if (faces[e] == 1) is_inner[v] = false;
    }
    if (faces[e] == 2 && (p.letters[e] == 'B' || p.letters[e] == 'C')) {
      ++out.cuts;
      out.cut = static_cast<int>(e);
    }
  }
  for (std::size_t v = 0; v < creases.size(); ++v)
    if (is_inner[v] && creases[v] != 4) ++out.vertices[creases[v]];
  return out;
}

/// Noun of a count.
struct CountedNoun {
  const char *one, *several, *parts;
};

/// Formats counts by number, such as "3 faces of 5 corners, 1 face of 6 corners".
std::string counts_text(const std::map<std::size_t, std::size_t>& counts, const CountedNoun& noun) {
  constexpr int most_kinds = 4;
  std::string text;
  int kinds = 0;
  for (const auto& [number, count] : counts) {
    if (++kinds > most_kinds) return text + ", and others";
    text += fmt::format("{}{} {} of {} {}", text.empty() ? "" : ", ", count,
                        count == 1 ? noun.one : noun.several, number, noun.parts);
  }
  return text;
}

/// Refuses a pattern in one message about all of it.
[[noreturn]] void refuse_misfits(const CreaseMesh& p, const Misfits& misfits) {
  std::vector<std::string> parts = {
      counts_text(misfits.faces, {"face", "faces", "corners"}),
      counts_text(misfits.vertices, {"inner vertex", "inner vertices", "creases"})};
  if (misfits.cuts > 0)
    parts.push_back(fmt::format("{} with faces on both sides, such as {}",
                                targets::counted(misfits.cuts, "cut or boundary line"),
                                p.edge_name(misfits.cut)));
  std::erase(parts, "");
  const bool has_triangles_only = misfits.faces.size() == 1 && misfits.faces.begin()->first == 3;
  const char* advice =
      misfits.cuts > 0 ? "Remove cuts, or assign \"M\" or \"V\" to them"
      : has_triangles_only
          ? "If its triangles are halves of flat quadrilaterals, assign \"F\" to their common edges (yellow "
            "in "
            "drawings)"
          : "Give quadrilaterals with four creases at each inner vertex, such as a Miura sheet";
  throw InvalidInput(
      fmt::format("the pattern is not a mesh of quadrilaterals that fold flat: of {} it has {}. {}",
                  targets::counted(p.faces.size(), "face"), fmt::join(parts, ", "), advice));
}

[[noreturn]] void refuse_grid() {
  throw InvalidInput(
      "the faces are not a grid of equally long columns and rows. Give a pattern with such a grid");
}

/// Vertices in columns and rows, from a corner of the pattern.
class GridWalk {
 public:
  explicit GridWalk(const CreaseMesh& p) : p_(p) {
    for (std::size_t f = 0; f < p.faces.size(); ++f)
      for (int k = 0; k < 4; ++k) beyond_[{corner(f, k), corner(f, k + 1)}] = f;
    std::vector<int> face = corner_face();
    for (bool more = true; more;) {
      add_row(face);
      more = step(face, face[3], face[2]);
    }
    if ((rows_.size() - 1) * (rows_[0].size() - 1) != p.faces.size()) refuse_grid();
  }

  int columns() const { return static_cast<int>(rows_[0].size()) - 1; }
  int rows() const { return static_cast<int>(rows_.size()) - 1; }
  int at(int i, int j) const { return rows_[j][i]; }

 private:
  int corner(std::size_t face, int k) const { return p_.faces[face].vertices[k % 4]; }

  std::vector<int> face_from(std::size_t face, int k) const {
    return {corner(face, k), corner(face, k + 1), corner(face, k + 2), corner(face, k + 3)};
  }

  /// Returns the face of the vertex with the lowest number in the file that only one face has. That vertex is at its
  /// front.
  std::vector<int> corner_face() const {
    std::vector<int> count(p_.graph.vertices.size(), 0);
    for (const model::GraphFace& face : p_.faces)
      for (const int v : face.vertices) ++count[v];
    std::vector<int> first;
    for (std::size_t f = 0; f < p_.faces.size(); ++f)
      for (int k = 0; k < 4; ++k) {
        const int v = corner(f, k);
        if (count[v] == 1 && (first.empty() || p_.number[v] < p_.number[first[0]])) first = face_from(f, k);
      }
    if (first.empty()) refuse_grid();
    return first;
  }

  /// Replaces `face` by the face that has the edge from a to b counter-clockwise, and begins with it. @return false if
  /// there is none
  bool step(std::vector<int>& face, int a, int b) const {
    const auto found = beyond_.find({a, b});
    if (found == beyond_.end()) return false;
    for (int k = 0; k < 4; ++k)
      if (corner(found->second, k) == a) face = face_from(found->second, k);
    return true;
  }

  void add_row(std::vector<int> face) {
    std::vector<int> below = {face[0]}, above = {face[3]};
    std::size_t count = 0;
    while (true) {
      below.push_back(face[1]);
      above.push_back(face[2]);
      if (++count > p_.faces.size()) refuse_grid();
      if (!step_right(face)) break;
    }
    if (rows_.empty()) rows_.push_back(below);
    if (rows_.back() != below || rows_.size() > p_.faces.size()) refuse_grid();
    rows_.push_back(above);
  }

  /// Replaces `face` by the face to its right, beyond its corners [1] and [2]. The new face begins with the old [1]
  /// and ends with the old [2]. @return false if there is none
  bool step_right(std::vector<int>& face) const {
    std::vector<int> next = face;
    if (!step(next, face[2], face[1])) return false;
    face = {next[1], next[2], next[3], next[0]};
    return true;
  }

  const CreaseMesh& p_;
  std::map<std::pair<int, int>, std::size_t> beyond_;  ///< face of each directed edge
  std::vector<std::vector<int>> rows_;
};

}  // namespace

QuadGrid find_quad_grid(const CreaseMesh& pattern) {
  if (const Misfits misfits = find_misfits(pattern); !misfits.is_empty()) refuse_misfits(pattern, misfits);
  const GridWalk grid(pattern);
  if (grid.columns() < 2 || grid.rows() < 2)
    throw InvalidInput("the pattern has no inner vertex. Give at least 2 x 2 faces");
  std::map<std::pair<int, int>, double> signs;
  for (std::size_t e = 0; e < pattern.letters.size(); ++e) {
    const auto& [from, to] = pattern.graph.edges[e];
    signs[std::minmax(from, to)] = pattern.letters[e] == 'V' ? 1 : pattern.letters[e] == 'M' ? -1 : 0;
  }
  QuadGrid out;
  model::QuadMesh& mesh = out.mesh;
  mesh = model::empty_mesh<double>(grid.columns(), grid.rows());
  const auto sign = [&](int i, int j, int to_i, int to_j) {
    return signs.at(std::minmax(grid.at(i, j), grid.at(to_i, to_j)));
  };
  for (int j = 0; j <= grid.rows(); ++j)
    for (int i = 0; i <= grid.columns(); ++i) {
      out.vertex_of.push_back(grid.at(i, j));
      mesh.at(i, j) = pattern.graph.vertices[grid.at(i, j)];
      if (i > 0 && i < grid.columns() && j < grid.rows())
        mesh.rising[mesh.rising_crease(i, j)] = sign(i, j, i, j + 1);
      if (j > 0 && j < grid.rows() && i < grid.columns())
        mesh.level[mesh.level_crease(i, j)] = sign(i, j, i + 1, j);
    }
  return out;
}

}  // namespace kinetix::app
