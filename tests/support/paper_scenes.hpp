#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "model/lattice/square/family/exact_family.hpp"
#include "model/lattice/square/unit_laws.hpp"

/// Structures of the paper's figures, by its cell tuples. Numbers that text and figures leave open are chosen here:
/// tilts of 30 deg, twisting angles of 80 deg, the lengths of strips.
namespace kinetix::testing {

inline constexpr double bend_tilt = 30 * radians_per_degree;    ///< rad; the paper gives no number
inline constexpr double twist_alpha = 80 * radians_per_degree;  ///< rad; the paper gives no number

inline model::Structure tiled(int columns, int rows, const model::CellTuple& even,
                              const model::CellTuple& odd, const model::CellSize& size = {}) {
  model::Structure s = make_structure(model::rectangle(columns, rows), size);
  apply_pattern(s, even, odd, model::SharedWalls::must_agree);
  return s;
}

/// Fig. 9, Eq. 9 (k = 0.2): every cell scales.
inline model::Structure crossable_grid(double k = 0.2, int columns = 3, int rows = 5,
                                       const model::CellSize& size = {}) {
  return tiled(columns, rows, {.P = {k, 1 - k, k, 1 - k}}, {.P = {1 - k, k, 1 - k, k}}, size);
}

/// Fig. 10, Eq. 10 (k = 0.3): every cell shears.
inline model::Structure uncrossable_grid(double k = 0.3, int columns = 3, int rows = 5,
                                         const model::CellSize& size = {}) {
  return tiled(columns, rows, {.P = {k, k, k, k}}, {.P = {1 - k, 1 - k, 1 - k, 1 - k}}, size);
}

/// Fig. 13.
inline model::Structure single_unit_panel() { return make_structure(model::rectangle(15, 15), {}); }

/// P of the cells in a column of Fig. 14: 0.8 on the left to 0.2 on the right.
inline double gradient_fraction(int column) { return 0.8 - 0.6 * column / 7; }

/// Returns Fig. 14: neighbouring columns need different hinges on the wall they share, and get the mean.
inline model::Structure gradient_panel() {
  model::Structure s = make_structure(model::rectangle(8, 8), {});
  for (model::Hinge& hinge : s.hinges) {
    const auto [i, j] = hinge.wall.from;
    const bool along_x = hinge.wall.axis == model::Axis::x;
    const double left = gradient_fraction(i == 0 ? 0 : i - 1), right = gradient_fraction(i == 8 ? 7 : i);
    const double of_class_a = along_x ? right : 1 - (left + right) / 2;
    hinge.parameters.t = hinge.wall.from.is_in_sublattice_a() ? of_class_a : 1 - of_class_a;
  }
  return s;
}

/// Returns basic cells, and cells that scale inside the picture: tA = k on their walls.
inline model::Structure rule_panel(double k, int cells, const std::function<bool(int i, int j)>& in_picture) {
  model::Structure s = make_structure(model::rectangle(cells, cells), {});
  for (model::Hinge& hinge : s.hinges) {
    const auto [i, j] = hinge.wall.from;
    const bool along_x = hinge.wall.axis == model::Axis::x;
    if (in_picture(i, j) || in_picture(along_x ? i : i - 1, along_x ? j - 1 : j))
      hinge.parameters.t = fraction_from_lower(k, hinge.wall.from);
  }
  return s;
}

/// A letter T.
inline model::Structure letter_panel(double k, int cells = 10) {
  const int middle = cells / 2, top = cells - 2;
  return rule_panel(k, cells, [=](int i, int j) {
    const bool bar = j == top - 1 || j == top, stem = i == middle - 1 || i == middle;
    return (bar && i >= 1 && i <= top) || (stem && j >= 1 && j <= top);
  });
}

/// Hinges of a column's x-walls in the two-unit tessellations. Neighbouring units share the y-walls, which are basic,
/// so a strip bends or twists by its x-walls alone.
struct ColumnUnit {
  double t = 0.5;         ///< fraction of a wall that belongs to its class A vertex
  double alpha = pi / 2;  ///< rad, of the walls in even rows; pi - alpha in odd ones
  double beta = 0;        ///< rad, of the walls in even rows; -beta in odd ones
};

/// The units of the paper.
inline constexpr ColumnUnit basic_unit{};
inline constexpr ColumnUnit scaling_unit{.t = 0.3};   ///< a fraction: k = 0.3, as in Fig. 10
inline constexpr ColumnUnit shearing_unit{.t = 0.7};  ///< a fraction: 1 - k, with k = 0.3
inline constexpr ColumnUnit bending_unit{.beta = bend_tilt};
inline constexpr ColumnUnit twisting_unit{.alpha = twist_alpha};

/// Returns two units in alternation along x. @param s_of_class_a part of every y-wall that belongs to class A
inline model::Structure alternating(int columns, int rows, const ColumnUnit& even, const ColumnUnit& odd,
                                    double s_of_class_a = 0.5) {
  model::Structure s = make_structure(model::rectangle(columns, rows), {});
  for (model::Hinge& hinge : s.hinges) {
    const auto [i, j] = hinge.wall.from;
    const bool along_x = hinge.wall.axis == model::Axis::x;
    const ColumnUnit unit = along_x ? (i % 2 == 0 ? even : odd) : ColumnUnit{.t = s_of_class_a};
    const double t = hinge.wall.from.is_in_sublattice_a() ? unit.t : 1 - unit.t;
    const bool mirrored = along_x && j % 2 == 1;
    hinge.parameters = {t, mirrored ? pi - unit.alpha : unit.alpha, mirrored ? -unit.beta : unit.beta};
  }
  return s;
}

inline model::Structure curling_strip() {
  return alternating(9, 1, bending_unit, twisting_unit);
}  ///< Fig. 15
inline model::Structure bending_strip() { return alternating(9, 1, bending_unit, basic_unit); }  ///< Fig. 16
inline model::Structure twisting_strip() {
  return alternating(9, 1, twisting_unit, basic_unit);
}  ///< Fig. 17
inline model::Structure bending_sheet() { return alternating(9, 7, bending_unit, basic_unit); }  ///< Fig. 18
inline model::Structure curling_sheet() {
  return alternating(9, 7, bending_unit, shearing_unit);
}  ///< Fig. 19

}  // namespace kinetix::testing
