#include "model/lattice/square/cell_rectangle.hpp"

namespace kinetix::model {
namespace {

/// Returns the first and the end index of a rectangle along an axis: columns for x, rows for y.
int low_end(const CellRectangle& r, Axis axis) { return row_along(axis, {r.low.i, r.low.j}); }
int high_end(const CellRectangle& r, Axis axis) { return low_end(r, axis) + r.extent(axis); }

Axis other(Axis axis) { return axis == Axis::x ? Axis::y : Axis::x; }

/// Creates a rectangle from positions and lengths along an axis and across it.
CellRectangle from_spans(Axis axis, int along, int length, int aside, int breadth) {
  if (axis == Axis::x) return {{along, aside}, length, breadth};
  return {{aside, along}, breadth, length};
}

/// Returns the vertices of lines first to last across an axis, line by line, counted from the rectangle's first one.
std::vector<Vertex> lines_of_vertices(const CellRectangle& r, Axis axis, int first, int last) {
  std::vector<Vertex> out;
  for (int n = first; n <= last; ++n)
    for (int m = 0; m <= r.extent(other(axis)); ++m)
      out.push_back(axis == Axis::x ? Vertex{r.low.i + n, r.low.j + m} : Vertex{r.low.i + m, r.low.j + n});
  return out;
}

bool spans_touch(const CellRectangle& a, const CellRectangle& b, Axis axis) {
  return low_end(a, axis) <= high_end(b, axis) && low_end(b, axis) <= high_end(a, axis);
}

}  // namespace

std::string to_string(Side side) {
  switch (side) {
    case Side::left:
      return "left";
    case Side::right:
      return "right";
    case Side::bottom:
      return "bottom";
    case Side::top:
      break;
  }
  return "top";
}

Side opposite(Side side) {
  switch (side) {
    case Side::left:
      return Side::right;
    case Side::right:
      return Side::left;
    case Side::bottom:
      return Side::top;
    case Side::top:
      break;
  }
  return Side::bottom;
}

Axis across(Side side) { return side == Side::left || side == Side::right ? Axis::x : Axis::y; }

bool is_upper(Side side) { return side == Side::right || side == Side::top; }

CellRectangle CellRectangle::beside(const CellRectangle& from, Side side, int gap, int shift) const {
  const Axis axis = across(side), aside = other(axis);
  const int along = is_upper(side) ? high_end(from, axis) + gap : low_end(from, axis) - gap - extent(axis);
  return from_spans(axis, along, extent(axis), low_end(from, aside) + shift, extent(aside));
}

CellRectangle CellRectangle::seen_from(const Cell& origin) const {
  return {{low.i - origin.i, low.j - origin.j}, width, height};
}

CellRectangle CellRectangle::turned() const { return {{-low.j - height, low.i}, height, width}; }

CellRectangle CellRectangle::mirrored() const { return {{-low.i - width, low.j}, width, height}; }

std::vector<Cell> CellRectangle::cells() const {
  std::vector<Cell> out = rectangle(width, height);
  for (Cell& cell : out) cell = {low.i + cell.i, low.j + cell.j};
  return out;
}

std::vector<Vertex> CellRectangle::vertices() const { return lines_of_vertices(*this, Axis::x, 0, width); }

std::vector<Vertex> CellRectangle::rows_of_vertices() const {
  return lines_of_vertices(*this, Axis::y, 0, height);
}

std::vector<Vertex> CellRectangle::vertices_between_ends(Axis axis) const {
  return lines_of_vertices(*this, axis, 1, extent(axis) - 1);
}

std::vector<Wall> CellRectangle::walls_along(Axis axis) const {
  std::vector<Wall> out;
  for (const Vertex& from : lines_of_vertices(*this, axis, 0, extent(axis) - 1)) out.push_back({from, axis});
  return out;
}

Vertex CellRectangle::corner(Side side) const {
  if (side == Side::right) return {low.i + width, low.j};
  if (side == Side::top) return {low.i, low.j + height};
  return {low.i, low.j};
}

Vertex CellRectangle::middle() const { return {low.i + width / 2, low.j + height / 2}; }

CellRectangle gap_between(const CellRectangle& from, Side side, const CellRectangle& to) {
  const Axis axis = across(side), aside = other(axis);
  const CellRectangle &first = is_upper(side) ? from : to, &second = is_upper(side) ? to : from;
  const int low = high_end(first, axis), high = low_end(second, axis);
  const int left = std::max(low_end(from, aside), low_end(to, aside)),
            right = std::min(high_end(from, aside), high_end(to, aside));
  return from_spans(axis, low, high - low, left, right - left);
}

bool touch(const CellRectangle& a, const CellRectangle& b) {
  return spans_touch(a, b, Axis::x) && spans_touch(a, b, Axis::y);
}

CellRectangle bounds(const std::vector<CellRectangle>& rectangles) {
  Cell low = rectangles.front().low, high = low;
  for (const CellRectangle& r : rectangles) {
    low = {std::min(low.i, r.low.i), std::min(low.j, r.low.j)};
    high = {std::max(high.i, high_end(r, Axis::x)), std::max(high.j, high_end(r, Axis::y))};
  }
  return {low, high.i - low.i, high.j - low.j};
}

std::vector<int> bodies_of(const CellRectangle& rectangle, const Structure& structure) {
  std::vector<int> bodies;
  for (const Vertex& v : rectangle.rows_of_vertices()) bodies.push_back(*structure.body_at(v));
  return bodies;
}

std::vector<std::array<int, 2>> line_ends(const CellRectangle& r, Axis axis) {
  const int row = r.width + 1;
  std::vector<std::array<int, 2>> ends;
  if (axis == Axis::x)
    for (int j = 0; j <= r.height; ++j) ends.push_back({j * row, j * row + r.width});
  else
    for (int i = 0; i <= r.width; ++i) ends.push_back({i, r.height * row + i});
  return ends;
}

int middle_body(const CellRectangle& rectangle, const Structure& structure) {
  return *structure.body_at(rectangle.middle());
}

}  // namespace kinetix::model
