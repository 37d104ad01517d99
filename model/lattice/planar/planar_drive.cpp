#include "model/lattice/planar/planar_drive.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/linkage/make_drive.hpp"

namespace kinetix::model {
namespace {

// Cell edges: rounding separates vertices on one line of a drawing by as much
constexpr double one_line = 1e-9;

std::vector<int> bodies_at(const PlanarStructure& s, Axis axis, double place) {
  const int along = component(axis);
  std::vector<int> row;
  for (int v = 0; v < static_cast<int>(s.graph.vertices.size()); ++v)
    if (std::abs(s.graph.vertices[v][along] - place) <= one_line) row.push_back(v);
  std::sort(row.begin(), row.end(),
            [&](int a, int b) { return s.graph.vertices[a][1 - along] < s.graph.vertices[b][1 - along]; });
  return row;
}

/// Returns the boundary rows without the check for single bodies.
GrippedRows outermost_rows(const PlanarStructure& s, Axis axis) {
  const int along = component(axis);
  const auto [low, high] =
      std::minmax_element(s.graph.vertices.begin(), s.graph.vertices.end(),
                          [along](const auto& a, const auto& b) { return a[along] < b[along]; });
  return {bodies_at(s, axis, (*low)[along]), bodies_at(s, axis, (*high)[along])};
}

bool can_grip(const GrippedRows& rows) { return rows[0].size() > 1 && rows[1].size() > 1; }

/// Returns the distance of the rows at theta over that at rest. Along x a body is at cos(theta) x - sin(theta) y_y,
/// along y at cos(theta) y + sin(theta) y_x.
double closing(const PlanarStructure& s, const Redrawing& y, Axis axis, const GrippedRows& rows,
               double theta) {
  const int first = rows[0].front(), last = rows[1].front(), along = component(axis);
  const double rest = s.graph.vertices[last][along] - s.graph.vertices[first][along];
  const double moved = y[last][1 - along] - y[first][1 - along];
  return std::cos(theta) + (axis == Axis::x ? -1 : 1) * std::sin(theta) * moved / rest;
}

/// Returns the first upright hinge, or the first hinge if none is upright.
int first_upright(const PlanarStructure& s) {
  const Linkage linkage = s;
  const auto upright = std::find_if(linkage.hinges.begin(), linkage.hinges.end(),
                                    [](const RestHinge& hinge) { return is_vertical(hinge); });
  return upright == linkage.hinges.end() ? 0 : static_cast<int>(upright - linkage.hinges.begin());
}

}  // namespace

GrippedRows rim_rows(const PlanarStructure& structure, Axis axis) {
  GrippedRows rows = outermost_rows(structure, axis);
  if (can_grip(rows)) return rows;
  const int single = rows[0].size() > 1 ? rows[1].front() : rows[0].front();
  throw InvalidInput("plates normal to " + std::string(to_string(axis)) +
                         " would touch this panel at vertex " + std::to_string(single) +
                         " alone and let it turn; allowed: " +
                         to_string(axis == Axis::x ? Axis::y : Axis::x) + ", or kind: hinge",
                     {"", 0, 0, "drive.axis"});
}

LinkageDrive plate_drive(const PlanarStructure& structure, Axis axis, double compression, int branch) {
  validate_hinges(structure);
  return plates_between(rim_rows(structure, axis), axis, compression, branch,
                        static_cast<int>(structure.graph.vertices.size()));
}

LinkageDrive hinge_drive(const PlanarStructure& structure, int hinge, double angle) {
  validate_hinges(structure);
  return turned_hinge(hinge, structure.senses[structure.graph.edges[hinge].from], angle);
}

LinkageDrive drive_to(const PlanarStructure& structure, double theta) {
  require("theta", theta, std::abs(theta) < pi / 2, "in (-pi/2, pi/2) rad");
  if (const RedrawingFit fit = redrawing_of(structure); fit.is_closed() && all_vertical(structure))
    for (const Axis axis : {Axis::y, Axis::x}) {
      const GrippedRows rows = outermost_rows(structure, axis);
      if (!can_grip(rows) || !keeps_rows_straight(fit.y, axis, rows)) continue;
      const double compression = 1 - closing(structure, fit.y, axis, rows, theta);
      if (compression >= 0) return plate_drive(structure, axis, compression, theta < 0 ? -1 : 1);
    }
  const int hinge = first_upright(structure);
  return hinge_drive(structure, hinge,
                     turn_at_theta(structure.senses[structure.graph.edges[hinge].from], theta));
}

bool keeps_rows_straight(const Redrawing& y, Axis axis, const GrippedRows& rows) {
  const int part = 1 - component(axis);
  const auto is_straight = [&](const std::vector<int>& row) {
    return std::all_of(row.begin(), row.end(), [&](int b) {
      return std::abs(y[b][part] - y[row.front()][part]) <= RedrawingFit::closed;
    });
  };
  return is_straight(rows[0]) && is_straight(rows[1]);
}

void refuse_rows_that_curve(const LinkageDrive& drive, const Redrawing& y) {
  if (keeps_rows_straight(y, drive.axis, drive.gripped)) return;
  throw InvalidInput("plates normal to " + std::string(to_string(drive.axis)) +
                         " would hold rows straight that curve in this panel's exact motion; allowed: "
                         "kind: hinge, or --model equilibrium",
                     {"", 0, 0, "drive.axis"});
}

}  // namespace kinetix::model
