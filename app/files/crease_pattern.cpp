#include "app/files/crease_pattern.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "model/base/algorithms.hpp"
#include "model/base/geometry.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/join_lines.hpp"

namespace kinetix::app {
namespace {

constexpr const char* crease_colours =
    "red for mountains, blue for valleys, black for the boundary, yellow or grey for flat creases, green for "
    "cuts, or magenta for creases without a letter";

/// Returns the letter of a colour, 0xRRGGBB; 0 for colours without one.
char letter_of_colour(int colour) {
  constexpr int bright = 0xA0, dark = 0x60;
  const int red = colour >> 16 & 0xFF, green = colour >> 8 & 0xFF, blue = colour & 0xFF;
  const auto is = [&](bool r, bool g, bool b) {
    return (r ? red >= bright : red <= dark) && (g ? green >= bright : green <= dark) &&
           (b ? blue >= bright : blue <= dark);
  };
  constexpr int css_green = 0x008000;
  if (colour == css_green || is(false, true, false)) return 'C';
  if (is(true, false, false)) return 'M';
  if (is(false, false, true)) return 'V';
  if (is(false, false, false)) return 'B';
  // Grey lines are flat or auxiliary in files of ORIPA, Rabbit Ear and Flat-Folder.
  const bool is_grey = red == green && green == blue;
  if (is(true, true, false) || is_grey) return 'F';
  if (is(true, false, true)) return 'U';
  return 0;
}

/// Reads one line of a `.cp` file: a kind and four coordinates.
std::array<double, 5> numbers_of(std::string_view text, int line) {
  std::array<double, 5> out{};
  constexpr std::string_view blanks = " \t\r,";
  std::size_t count = 0;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;
       at = text.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(text.size(), text.find_first_of(blanks, at));
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, number);
    if (count == out.size() || error != std::errc() || stop != text.data() + end || !std::isfinite(number))
      throw InvalidInput(
          "this is not a line of a crease pattern. Give a kind and the two ends: `2 x1 y1 x2 y2`",
          {"", line, static_cast<int>(at) + 1});
    out[count++] = number;
    at = end;
  }
  if (count != out.size())
    throw InvalidInput(
        fmt::format("the line has {} numbers. Give a kind and the two ends: `2 x1 y1 x2 y2`", count),
        {"", line, 1});
  return out;
}

using Eigen::Vector2d;
using targets::JoinedLines;

// Letters from the weakest to the strongest.
constexpr std::string_view letters_by_strength = "FUBMVC";
constexpr double wide_join = 0.03;  // of the median line: as far as vertices are moved to fold flat
constexpr double straight_within =
    5e-3;  // of the shorter edge: distance of a straight vertex from its neighbours' line
constexpr double usual_area_error = 0.5;  // of the smallest face: with more, a face is missing or doubled
// Limits of coordinates, in the unit of the file: their squares and products are numbers of a computer.
constexpr double least_size = 1e-50, largest_coordinate = 1e50;

/// Finds vertices of a graph by their place.
class PlacedVertices {
 public:
  PlacedVertices(const std::vector<Vector2d>& places, double near) : places_(places), near_(near) {
    order_.resize(places.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int a, int b) { return places[a].x() < places[b].x(); });
  }

  /// Returns the nearest vertex within the distance; -1 if there is none.
  int at(const Vector2d& p) const {
    int best = -1;
    double least = near_;
    auto k = std::lower_bound(order_.begin(), order_.end(), p.x() - near_,
                              [&](int v, double x) { return places_[v].x() < x; });
    for (; k != order_.end() && places_[*k].x() <= p.x() + near_; ++k)
      if (const double distance = (places_[*k] - p).norm(); distance <= least) {
        least = distance;
        best = *k;
      }
    return best;
  }

 private:
  const std::vector<Vector2d>& places_;
  double near_;
  std::vector<int> order_;
};

/// Builds a pattern step by step.
class PatternBuilder {
 public:
  explicit PatternBuilder(const CreaseLines& file) : file_(file) {
    check_size();
    std::vector<std::size_t> order(file.lines.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return letters_by_strength.find(file.letters[a]) < letters_by_strength.find(file.letters[b]);
    });
    for (const std::size_t k : order) {
      lines_.push_back(file.lines[k]);
      line_letters_.push_back(file.letters[k]);
    }
  }

  CreaseMesh run(bool is_wide) {
    JoinedLines joined = targets::join_lines(lines_);
    if (is_wide) {
      out_.joined = joined.join * wide_join / targets::default_join;
      joined = targets::join_lines(lines_, out_.joined);
    }
    join_ = joined.join;
    out_.graph = joined.graph;
    for (const int line : joined.line_of) out_.letters.push_back(line_letters_[line]);
    number_vertices();
    check_doubles();
    out_.faces = bounded_faces(out_.graph);
    check_area();
    remove_flat_edges();
    while (remove_straight_vertices()) continue;
    compact();
    out_.faces = bounded_faces(out_.graph);
    check_pieces();
    check_ends();
    return std::move(out_);
  }

 private:
  void check_size() const {
    Eigen::AlignedBox2d box;
    for (const targets::DrawnLine& line : file_.lines) box.extend(line.from).extend(line.to);
    if (box.isEmpty() || !(box.sizes().norm() >= least_size))
      throw InvalidInput("the pattern has no lines with a length. Give each crease as one line");
    if (!(box.min().cwiseAbs().maxCoeff() <= largest_coordinate) ||
        !(box.max().cwiseAbs().maxCoeff() <= largest_coordinate))
      throw InvalidInput("a coordinate is too large. Give smaller numbers");
  }

  void number_vertices() {
    out_.number.assign(out_.graph.vertices.size(), -1);
    const PlacedVertices map(out_.graph.vertices, join_);
    for (int v = static_cast<int>(file_.vertices.size()) - 1; v >= 0; --v)
      if (const int found = map.at(file_.vertices[v]); found >= 0) out_.number[found] = v;
  }

  /// Refuses a mountain and a valley with the same ends.
  void check_doubles() const {
    const PlacedVertices map(out_.graph.vertices, join_);
    std::map<std::pair<int, int>, char> known;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const char letter = line_letters_[k];
      if (letter != 'M' && letter != 'V') continue;
      const std::pair<int, int> ends = std::minmax(map.at(lines_[k].from), map.at(lines_[k].to));
      if (ends.first < 0 || ends.first == ends.second) continue;
      if (known.try_emplace(ends, letter).first->second != letter)
        throw InvalidInput("the crease from " + out_.name(ends.first) + " to " + out_.name(ends.second) +
                               " is both mountain and valley. Remove one of them",
                           {"", lines_[k].line, 0});
    }
  }

  /// Compares the faces that the file lists with those of its edges.
  void check_area() const {
    if (file_.face_area == 0) return;
    double area = 0, least = file_.face_area;
    for (const model::GraphFace& face : out_.faces) {
      const double of_face = signed_area(
          face.vertices.size(), [&](std::size_t k) { return out_.graph.vertices[face.vertices[k]]; });
      area += of_face;
      least = std::min(least, of_face);
    }
    if (!(std::abs(file_.face_area - area) <= usual_area_error * least))
      throw InvalidInput(fmt::format(
          "faces_vertices covers {:.4g} % of the area between the edges, so faces are missing or overlap. "
          "Give each face of the flat pattern once, or remove this list",
          100 * file_.face_area / area));
  }

  void keep_edges(const std::vector<bool>& is_kept) {
    std::size_t count = 0;
    for (std::size_t e = 0; e < is_kept.size(); ++e) {
      if (!is_kept[e]) continue;
      out_.graph.edges[count] = out_.graph.edges[e];
      out_.letters[count++] = out_.letters[e];
    }
    out_.graph.edges.resize(count);
    out_.letters.resize(count);
  }

  void remove_flat_edges() {
    const std::vector<int> faces = out_.faces_of_edges();
    std::vector<bool> is_kept(faces.size());
    for (std::size_t e = 0; e < faces.size(); ++e) is_kept[e] = out_.letters[e] != 'F' || faces[e] == 1;
    keep_edges(is_kept);
    if (out_.graph.edges.empty())
      throw InvalidInput(
          "no line of the pattern is a crease or part of the boundary. Give mountains and valleys");
  }

  /// Merges the two edges of vertices that lie between them in a line. @return whether there are such vertices
  bool remove_straight_vertices() {
    model::PlanarGraph& graph = out_.graph;
    std::vector<std::vector<int>> at(graph.vertices.size());
    for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e)
      for (const int v : {graph.edges[e].from, graph.edges[e].to}) at[v].push_back(e);
    std::vector<bool> is_kept(graph.edges.size(), true);
    std::vector<bool> is_changed(graph.edges.size(), false);
    bool is_any = false;
    for (int v = 0; v < static_cast<int>(at.size()); ++v) {
      if (at[v].size() != 2) continue;
      const int kept = at[v][0], removed = at[v][1];
      if (is_changed[kept] || is_changed[removed] || !are_alike(kept, removed)) continue;
      const int from = end_beyond(kept, v), to = end_beyond(removed, v);
      if (from == to || !is_straight(from, v, to)) continue;
      graph.edges[kept] = {from, to};
      out_.letters[kept] = stronger(out_.letters[kept], out_.letters[removed]);
      is_kept[removed] = false;
      is_changed[kept] = is_changed[removed] = is_any = true;
    }
    keep_edges(is_kept);
    return is_any;
  }

  int end_beyond(int edge, int v) const {
    const auto& [from, to] = out_.graph.edges[edge];
    return from == v ? to : from;
  }

  static char stronger(char a, char b) {
    return letters_by_strength.find(a) < letters_by_strength.find(b) ? b : a;
  }

  bool are_alike(int a, int b) const {
    const char first = out_.letters[a], second = out_.letters[b];
    return first == second || first == 'U' || second == 'U' || first == 'F' || second == 'F';
  }

  bool is_straight(int from, int v, int to) const {
    const std::vector<Vector2d>& at = out_.graph.vertices;
    const double shorter = std::min((at[from] - at[v]).norm(), (at[to] - at[v]).norm());
    return (at[v] - at[from]).dot(at[to] - at[v]) > 0 &&
           model::distance_to_wall(at[v], at[from], at[to]) <= straight_within * shorter;
  }

  /// Removes vertices without edges.
  void compact() {
    model::PlanarGraph& graph = out_.graph;
    std::vector<int> rank(graph.vertices.size(), -1);
    for (const auto& [from, to] : graph.edges) rank[from] = rank[to] = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < rank.size(); ++v) {
      if (rank[v] < 0) continue;
      rank[v] = static_cast<int>(count);
      graph.vertices[count] = graph.vertices[v];
      out_.number[count++] = out_.number[v];
    }
    graph.vertices.resize(count);
    out_.number.resize(count);
    for (auto& [from, to] : graph.edges) {
      from = rank[from];
      to = rank[to];
    }
  }

  void check_pieces() const {
    UnionFind pieces(out_.graph.vertices.size());
    for (const auto& [from, to] : out_.graph.edges) pieces.unite(from, to);
    std::set<int> roots;
    for (int v = 0; v < static_cast<int>(out_.graph.vertices.size()); ++v) roots.insert(pieces.find(v));
    if (roots.size() > 1)
      throw InvalidInput(
          fmt::format("the pattern is in {} pieces that do not touch, such as at {} and {}. "
                      "Give one connected pattern",
                      roots.size(), out_.name(*roots.begin()), out_.name(*std::next(roots.begin()))));
  }

  void check_ends() const {
    const std::vector<int> faces = out_.faces_of_edges();
    for (std::size_t e = 0; e < faces.size(); ++e)
      if (faces[e] == 0)
        throw InvalidInput(
            out_.edge_name(static_cast<int>(e)) +
            " has no face on either side. Remove it, or continue it to other creases or to the "
            "boundary");
  }

  const CreaseLines& file_;
  std::vector<targets::DrawnLine> lines_;
  std::vector<char> line_letters_;
  double join_ = 0;
  CreaseMesh out_;
};

}  // namespace

CreaseLines read_drawn_creases(const targets::Drawing& drawing) {
  CreaseLines out{drawing.lines};
  for (const auto& [from, to, line, colour, chord_of] : drawing.lines) {
    if (chord_of >= 0)
      throw InvalidInput(fmt::format("a curve ({}) is not a crease that folds. Draw straight creases",
                                     drawing.curves[chord_of]),
                         {"", line, 1});
    const char letter = letter_of_colour(colour);
    if (letter == 0)
      throw InvalidInput(
          fmt::format("creases do not have the colour #{:06x}. Use {}", colour, crease_colours),
          {"", line, 1});
    out.letters.push_back(letter);
  }
  if (std::find_if(out.letters.begin(), out.letters.end(),
                   [](char c) { return c == 'M' || c == 'V' || c == 'U'; }) == out.letters.end())
    throw InvalidInput(fmt::format("the drawing has no creases by their colours. Use {}", crease_colours));
  // A px of a screen is no size of a sheet: Origami Simulator has patterns of any size in px.
  if (drawing.has_unit && drawing.unit_source.find("px") == std::string::npos) out.unit_mm = drawing.unit_mm;
  return out;
}

CreaseLines read_cp_creases(const std::string& text) {
  CreaseLines out;
  int line = 0;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.size(), text.find('\n', start));
    const std::string_view row = std::string_view(text).substr(start, end - start);
    start = end + 1;
    if (row.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto [kind, x1, y1, x2, y2] = numbers_of(row, line + 1);
    if (out.lines.size() >= targets::max_drawn_lines)
      throw InvalidInput("the pattern has more than a million lines. Give a smaller one");
    out.lines.push_back({{x1, -y1}, {x2, -y2}, line + 1});
    out.letters.push_back(kind == 1 ? 'B' : kind == 2 ? 'M' : kind == 3 ? 'V' : 'F');
  }
  if (out.lines.empty())
    throw InvalidInput("this is not a crease pattern: it has no lines. Give lines of a kind and two ends");
  return out;
}

std::string CreaseMesh::name(int vertex) const {
  if (number[vertex] >= 0) return fmt::format("vertex {}", number[vertex]);
  return fmt::format("the point ({:.6g}, {:.6g})", graph.vertices[vertex].x(), graph.vertices[vertex].y());
}

std::string CreaseMesh::edge_name(int edge) const {
  return "the crease from " + name(graph.edges[edge].from) + " to " + name(graph.edges[edge].to);
}

std::vector<int> CreaseMesh::faces_of_edges() const {
  std::vector<int> count(graph.edges.size(), 0);
  for (const model::GraphFace& face : faces)
    for (const int edge : face.edges) ++count[edge];
  return count;
}

CreaseMesh make_crease_mesh(const CreaseLines& lines, bool is_wide) {
  return PatternBuilder(lines).run(is_wide);
}

}  // namespace kinetix::app
