#include "optim/display/scaled_display.hpp"

#include <cmath>
#include <tuple>

#include "model/base/invalid_input.hpp"
#include "model/contact/wall_contact.hpp"
#include "optim/display/wall_scales.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

constexpr double middle_half = 0.25;  // of the panel's extent, from its middle to either side
constexpr double alike = 1e-6;        // of a wall's length: offsets that differ by less are equal

struct Extent {
  Vector2d middle, size;  ///< cell edges
};

Extent extent_of(const model::PlanarGraph& graph) {
  Vector2d low = graph.vertices.front(), high = low;
  for (const Vector2d& v : graph.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return {(low + high) / 2, high - low};
}

}  // namespace

int middle_hinge(const model::PlanarStructure& panel, const model::ParallelDrawing& y) {
  const Extent extent = extent_of(panel.graph);
  const auto rank = [&](int edge) {
    const auto [from, to] = panel.graph.edges[static_cast<std::size_t>(edge)];
    const Vector2d off = (panel.graph.vertices[from] + panel.graph.vertices[to]) / 2 - extent.middle;
    const bool is_outside = (off.cwiseAbs() - middle_half * extent.size).maxCoeff() > 0;
    const double scaled = is_outside ? 0 : std::round(std::abs(change_of(panel, y, edge).o) / alike);
    return std::tuple(is_outside, scaled, off.norm());
  };
  int best = 0;
  for (int edge = 1; edge < static_cast<int>(panel.graph.edges.size()); ++edge)
    if (rank(edge) < rank(best)) best = edge;
  return best;
}

model::HingeTurn turn_to(const model::PlanarStructure& panel, int hinge, double theta) {
  const int lower = panel.graph.edges[static_cast<std::size_t>(hinge)].from;
  return {hinge, model::turn_at_theta(panel.senses[static_cast<std::size_t>(lower)], theta)};
}

namespace {

// Fraction of the height: a larger drop would be visible in a small panel.
constexpr double max_drop = 1.0 / 80;
// Factor of the bound on turning per round; seven rounds leave a third of it.
constexpr double less_turning = 0.85;
constexpr int max_clearance_rounds = 7;
// rad: walls stay apart a little beyond the goal of the plates.
constexpr double margin = 2 * radians_per_degree;

constexpr double no_level = 0.5;  // level, [0, 1], at which walls neither grow nor shrink

double shift_of(const std::array<double, 2>& t) { return 2 * std::min(0.5 - t[0], t[1] - 0.5); }

void validate(const ScaledDisplayOptions& o) {
  require("compression", o.compression[0], o.compression[0] > 0 && o.compression[0] <= o.compression[1],
          "above 0, and no more than the upper end");
  require("compression", o.compression[1], o.compression[1] <= 0.5, "at most 0.5");
  require("offset", o.offset, o.offset > 0 && o.offset < 0.5, "in (0, 0.5) cell edges");
  require("t", o.t[0], o.t[0] > 0 && o.t[0] < 0.5, "in (0, 0.5)");
  require("t", o.t[1], o.t[1] > 0.5 && o.t[1] < 1, "in (0.5, 1)");
  require("drop", o.drop, o.drop >= 0 && std::isfinite(o.drop), "at least 0");
  if (o.free_to) require("free_to", *o.free_to, *o.free_to > 0 && *o.free_to < pi / 2, "in (0, pi/2) rad");
}

/// Returns the drop of the last row, cell edges (WallScales::drop). It is a little less than requested, since
/// bounds have priority.
double drop_of(const model::ParallelDrawing& y, const model::GrippedRows& rows, model::Axis axis) {
  const Eigen::Vector2d by = y[rows[1].front()] - y[rows[0].front()];
  return axis == model::Axis::x ? by.y() : -by.x();
}

/// Returns the distance of the rows at rest, cell edges.
double height_of(const model::PlanarStructure& panel, const model::GrippedRows& rows, model::Axis axis) {
  const int along = axis == model::Axis::x ? 0 : 1;
  return panel.graph.vertices[rows[1].front()][along] - panel.graph.vertices[rows[0].front()][along];
}

/// Returns the theta, rad, at which walls first meet, searched up to a little more than `theta`.
model::ContactLimit clearance(model::PlanarStructure panel, const model::ParallelDrawing& y, double theta) {
  place_hinges(y, panel);
  const auto fold_to = [&](double at, model::State& state) { state = fold(panel, y, at); };
  return theta_range(panel, fold_to, {.limit = theta + margin}).positive;
}

/// Returns the wanted scales of a panel and its bounds, with all rows free.
WallScales free_scales(const model::PlanarStructure& panel, std::vector<double> levels,
                       const ScaledDisplayOptions& options) {
  levels.resize(panel.faces.size(), no_level);
  return {.wanted = wanted_scales(levels, panel, options.offset),
          .offset = options.offset,
          .shift = shift_of(options.t)};
}

/// Scales the walls with less and less turning until they stay apart.
/// @param goal theta, rad, of a parallel drawing
/// @return the goal of the last one
template <class Goal>
double scale_until_apart(const model::PlanarStructure& panel, WallScales scales, const Goal& goal,
                         ScaledDisplay& found) {
  double theta = 0;
  do {
    const ScaledWalls walls = scale_walls(panel, scales);
    found.y = walls.y;
    found.offset = walls.offset;
    found.shift = walls.shift;
    found.converged = walls.converged;
    found.iterations += walls.iterations;
    theta = goal(found.y);
    const model::ContactLimit limit = clearance(panel, found.y, theta);
    found.clear = !limit.touches;
    found.clear_to = limit.theta;
    scales.shift *= less_turning;
  } while (++found.rounds < max_clearance_rounds && !found.clear);
  return theta;
}

ScaledDisplay scale_between_plates(const model::PlanarStructure& panel, const std::vector<double>& levels,
                                   const ScaledDisplayOptions& options) {
  const model::GrippedRows rows = boundary_rows(panel, options.axis);
  const double height = height_of(panel, rows, options.axis);
  const auto [least, most] = options.compression;
  WallScales scales = free_scales(panel, levels, options);
  scales.axis = options.axis;
  scales.straight = {rows[0], rows[1]};
  scales.drop = std::min(options.drop, max_drop * height);
  ScaledDisplay found;
  const auto theta_at_most = [&, most = most](const model::ParallelDrawing& y) {
    return theta_of_compression(most, drop_of(y, rows, options.axis), height);
  };
  const double goal = scale_until_apart(panel, scales, theta_at_most, found);
  const double drop = drop_of(found.y, rows, options.axis);
  const double reached = found.clear ? goal : std::min(goal, found.clear_to - margin);
  found.compression = found.clear ? most : std::max(least, compression_at(reached, drop, height));
  found.theta = theta_of_compression(found.compression, drop, height);
  found.clear = found.theta < found.clear_to;
  return found;
}

ScaledDisplay scale_free(const model::PlanarStructure& panel, const std::vector<double>& levels,
                         const ScaledDisplayOptions& options) {
  ScaledDisplay found;
  found.theta = scale_until_apart(
      panel, free_scales(panel, levels, options),
      [&](const model::ParallelDrawing&) { return *options.free_to; }, found);
  found.clear = found.theta < found.clear_to;
  return found;
}

}  // namespace

// H cos(theta) - drop sin(theta) = R cos(theta + phi), with R = hypot(H, drop) and tan(phi) = drop / H.
double theta_of_compression(double compression, double drop, double height) {
  return std::acos((1 - compression) * height / std::hypot(height, drop)) - std::atan2(drop, height);
}

double compression_at(double theta, double drop, double height) {
  return 1 - (height * std::cos(theta) - drop * std::sin(theta)) / height;
}

ScaledDisplay scale_display(const model::PlanarStructure& panel, const std::vector<double>& levels,
                            const ScaledDisplayOptions& options) {
  validate(options);
  return options.free_to ? scale_free(panel, levels, options) : scale_between_plates(panel, levels, options);
}

}  // namespace kinetix::optim
