#include "app/print/sheet/raised_text.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "model/base/angle.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using model::Polyhedron;

constexpr int rows = 5;           // squares, of a letter's height: as the figures below are drawn
constexpr double flat_mm = 1e-7;  // mm: corners of one face are the same numbers but for rounding
constexpr double start_angle =
    0.1;  // rad: at which the merging of two outlines starts, of no edge of upright text

/// Seven strokes on 3 x 5 squares, from the top. No two squares touch by a corner alone.
constexpr const char* digits[10] = {
    "111101101101111", "001001001001001", "111001111100111", "111001111001111", "101101111001001",
    "111100111001111", "111100111101111", "111001001001001", "111101111101111", "111101111001111"};

/// Squares of a text, [row from below][column].
std::vector<std::vector<bool>> squares_of(std::string_view text) {
  std::vector<std::vector<bool>> out(rows);
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool point = text[k] == '.';
    if (!point && (text[k] < '0' || text[k] > '9'))
      throw std::invalid_argument("text of digits and points alone");
    const char* shape = point ? "00001" : digits[text[k] - '0'];
    const int width = point ? 1 : 3;
    for (int row = 0; row < rows; ++row) {
      if (k > 0) out[row].push_back(false);
      for (int column = 0; column < width; ++column)
        out[row].push_back(shape[(rows - 1 - row) * width + column] == '1');
    }
  }
  if (text.empty()) throw std::invalid_argument("no text to raise");
  return out;
}

class Raised {
 public:
  Raised(std::string_view text, const TextFace& face, Polyhedron& solid)
      : face_(face),
        squares_(squares_of(text)),
        columns_(static_cast<int>(squares_[0].size())),
        solid_(solid) {}

  void raise() {
    const std::vector<int> outer = take_out_face();
    std::vector<int> inner = rim();
    check_room(outer, inner);
    fill_between(outer, inner);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns_; ++column) add_square(column, row);
  }

 private:
  Vector3d outwards() const { return face_.right.cross(face_.up); }

  Vector2d flat(int point) const {
    const Vector3d d = solid_.points[point] - face_.middle;
    return {d.dot(face_.right), d.dot(face_.up)};
  }

  bool is_on_face(int point) const {
    return std::abs((solid_.points[point] - face_.middle).dot(outwards())) < flat_mm;
  }

  /// Removes its triangles. @return its outline, counter-clockwise
  std::vector<int> take_out_face() {
    std::map<std::pair<int, int>, int> edges;
    const auto on_face = [&](const std::array<int, 3>& t) {
      return is_on_face(t[0]) && is_on_face(t[1]) && is_on_face(t[2]);
    };
    for (const auto& t : solid_.triangles)
      if (on_face(t))
        for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    solid_.triangles.erase(std::remove_if(solid_.triangles.begin(), solid_.triangles.end(), on_face),
                           solid_.triangles.end());
    std::map<int, int> next;
    for (const auto& [edge, count] : edges)
      if (!edges.count({edge.second, edge.first})) next[edge.first] = edge.second;
    if (next.empty()) throw std::invalid_argument("no face to raise text from");
    std::vector<int> loop{next.begin()->first};
    while (loop.size() < next.size()) loop.push_back(next.at(loop.back()));
    if (next.at(loop.back()) != loop.front()) throw std::invalid_argument("the face for a text is not one");
    return loop;
  }

  /// A corner of the grid of squares, on the face or raised; made once.
  int corner(int column, int row, bool raised) {
    const auto [at, is_new] = corners_.try_emplace({column, row, raised ? 1 : 0}, 0);
    if (!is_new) return at->second;
    const double x = (column - columns_ / 2.0) * face_.pixel_mm, y = (row - rows / 2.0) * face_.pixel_mm;
    return at->second = solid_.add_point(face_.middle + x * face_.right + y * face_.up +
                                         (raised ? face_.raised_mm : 0) * outwards());
  }

  /// Of all squares together, counter-clockwise.
  std::vector<int> rim() {
    std::vector<int> out;
    for (int c = 0; c < columns_; ++c) out.push_back(corner(c, 0, false));
    for (int r = 0; r < rows; ++r) out.push_back(corner(columns_, r, false));
    for (int c = columns_; c > 0; --c) out.push_back(corner(c, rows, false));
    for (int r = rows; r > 0; --r) out.push_back(corner(0, r, false));
    return out;
  }

  void check_room(const std::vector<int>& outer, const std::vector<int>& inner) const {
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const Vector2d from = flat(outer[k]), along = flat(outer[(k + 1) % outer.size()]) - from;
      for (const int p : inner) {
        const Vector2d d = flat(p) - from;
        if (!(along.x() * d.y() - along.y() * d.x() > flat_mm))
          throw std::invalid_argument("the face is smaller than its text");
      }
    }
  }

  /// Direction of an outline's edge, rad from start_angle on, [0, 2 pi).
  double direction(const std::vector<int>& loop, std::size_t k) const {
    const Vector2d d = flat(loop[(k + 1) % loop.size()]) - flat(loop[k % loop.size()]);
    const double angle = std::atan2(d.y(), d.x()) - start_angle;
    return angle < 0 ? angle + 2 * pi : angle;
  }

  /// The same, from its first direction on.
  std::vector<int> started(std::vector<int> loop) const {
    std::size_t first = 0;
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (direction(loop, k) + pi < direction(loop, k + loop.size() - 1)) first = k;  // where they wrap
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
    return loop;
  }

  /// Two convex outlines, the one in the other: edges of both by their directions, as the sides of the convex hull of
  /// the two in parallel planes.
  void fill_between(const std::vector<int>& around, const std::vector<int>& within) {
    const std::vector<int> outer = started(around), inner = started(within);
    std::size_t o = 0, i = 0;
    while (o < outer.size() || i < inner.size()) {
      const int at_outer = outer[o % outer.size()], at_inner = inner[i % inner.size()];
      const bool takes_outer =
          i == inner.size() || (o < outer.size() && direction(outer, o) <= direction(inner, i));
      if (takes_outer)
        solid_.triangles.push_back({at_outer, outer[++o % outer.size()], at_inner});
      else
        solid_.triangles.push_back({at_inner, at_outer, inner[++i % inner.size()]});
    }
  }

  bool is_raised(int column, int row) const {
    return column >= 0 && column < columns_ && row >= 0 && row < rows && squares_[row][column];
  }

  void add_square(int c, int r) {
    const bool up = is_raised(c, r);
    solid_.add_face({corner(c, r, up), corner(c + 1, r, up), corner(c + 1, r + 1, up), corner(c, r + 1, up)});
    if (!up) return;
    add_side(c, r, c + 1, r, is_raised(c, r - 1));
    add_side(c + 1, r, c + 1, r + 1, is_raised(c + 1, r));
    add_side(c + 1, r + 1, c, r + 1, is_raised(c, r + 1));
    add_side(c, r + 1, c, r, is_raised(c - 1, r));
  }

  void add_side(int c, int r, int next_c, int next_r, bool goes_on) {
    if (goes_on) return;
    solid_.add_face({corner(c, r, false), corner(next_c, next_r, false), corner(next_c, next_r, true),
                     corner(c, r, true)});
  }

  const TextFace& face_;
  const std::vector<std::vector<bool>> squares_;
  const int columns_;
  Polyhedron& solid_;
  std::map<std::array<int, 3>, int> corners_;
};

}  // namespace

void raise_text(std::string_view text, const TextFace& face, Polyhedron& solid) {
  Polyhedron out = solid;
  Raised(text, face, out).raise();
  solid = std::move(out);
}

int raised_squares(std::string_view text) {
  const auto squares = squares_of(text);
  return std::accumulate(squares.begin(), squares.end(), 0, [](int sum, const std::vector<bool>& row) {
    return sum + static_cast<int>(std::count(row.begin(), row.end(), true));
  });
}

}  // namespace kinetix::app
