#include "model/lattice/square/sheet_symmetry.hpp"

#include "model/lattice/square/changed_cells.hpp"

namespace kinetix::model {
namespace {

Vertex image(Vertex v, PlaneMotion motion, Vertex corner) {
  switch (motion) {
    case PlaneMotion::mirror_x:
      return {corner.i - v.i, v.j};
    case PlaneMotion::mirror_y:
      return {v.i, corner.j - v.j};
    case PlaneMotion::half_turn:
      return {corner.i - v.i, corner.j - v.j};
    case PlaneMotion::quarter_turn:
      return {corner.j - v.j, v.i};
    case PlaneMotion::none:
      break;
  }
  return v;
}

}  // namespace

WallImage image(const Structure& panel, const Hinge& hinge, PlaneMotion motion) {
  const Vertex corner = panel.bodies.back();
  const Vertex from = image(hinge.wall.from, motion, corner), to = image(hinge.wall.to(), motion, corner);
  const Vertex low = std::min(from, to);
  return {*panel.hinge_at({low, from.j == to.j ? Axis::x : Axis::y}), low != from};
}

namespace {

/// Returns true if its parameters are measured from the end nearer to the origin.
bool counted_from_below(const Structure& sheet, const Hinge& hinge) {
  return hinge.lower == *sheet.body_at(hinge.wall.from);
}

}  // namespace

SheetSymmetry::SheetSymmetry(const Structure& sheet, bool mirrors_x, bool mirrors_y)
    : mirrors_x_(mirrors_x), mirrors_y_(mirrors_y), extent_(extent(sheet)) {}

Cell SheetSymmetry::image(const Cell& cell) const {
  return {mirrors_x_ ? extent_[0] - 1 - cell.i : cell.i, mirrors_y_ ? extent_[1] - 1 - cell.j : cell.j};
}

std::optional<int> SheetSymmetry::image(const Structure& sheet, int hinge) const {
  Wall wall = sheet.hinges[hinge].wall;
  const bool along_x = wall.axis == Axis::x;
  if (mirrors_x_) wall.from.i = extent_[0] - wall.from.i - (along_x ? 1 : 0);
  if (mirrors_y_) wall.from.j = extent_[1] - wall.from.j - (along_x ? 0 : 1);
  return sheet.hinge_at(wall);
}

HingeParameters SheetSymmetry::image(const Structure& sheet, int hinge, int other) const {
  const Hinge& from = sheet.hinges[hinge];
  const bool turned_round = counted_from_below(sheet, from) != counted_from_below(sheet, sheet.hinges[other]);
  const bool along_x = from.wall.axis == Axis::x;
  HingeParameters out = from.parameters;
  if ((along_x ? mirrors_x_ : mirrors_y_) != turned_round) {
    out.t = 1 - out.t;
    out.alpha = pi - out.alpha;
  }
  if ((along_x ? mirrors_y_ : mirrors_x_) != turned_round) {
    out.beta = -out.beta;
    out.offset = -out.offset;
  }
  return out;
}

bool has_cell(const Structure& sheet, const Cell& cell) {
  return std::find(sheet.cells.begin(), sheet.cells.end(), cell) != sheet.cells.end();
}

bool is_countable(const Cell& cell) { return cell.i >= 0 && cell.j >= 0; }

}  // namespace kinetix::model
