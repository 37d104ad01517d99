#include "model/opening/blurred_light.hpp"

#include <cmath>
#include <limits>
#include <map>

#include "model/opening/cell_opening.hpp"

namespace kinetix::model {
namespace {

/// Returns the overlap of walls that leave a vertex at these angles, rad. Between two neighbours it is the
/// part of each beyond the line half-way between them: a triangle.
WallOverlap overlap_of_walls(std::vector<double> angles, double half_thickness) {
  std::sort(angles.begin(), angles.end());
  WallOverlap all;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double next = k + 1 < angles.size() ? angles[k + 1] : angles[0] + 2 * pi;
    const double half = (next - angles[k]) / 2;
    if (half >= pi / 2) continue;
    const double area = half_thickness * half_thickness / std::tan(half);
    // Centroid of both triangles along the line: a third of the sum of their corners.
    const double out = half_thickness * (2 * std::sin(half) + std::cos(half) / std::tan(half)) / 3;
    all.area += area;
    all.middle += area * out * Eigen::Vector2d(std::cos(angles[k] + half), std::sin(angles[k] + half));
  }
  if (all.area > 0) all.middle /= all.area;
  return all;
}

}  // namespace

std::vector<WallOverlap> wall_overlaps(const Linkage& panel) {
  std::vector<std::vector<double>> angles(panel.bodies.size());
  for (const Plate& p : panel.plates) angles[p.body].push_back(std::atan2(p.edge.y(), p.edge.x()));
  std::vector<WallOverlap> overlaps;
  for (std::vector<double>& of_body : angles)
    overlaps.push_back(
        overlap_of_walls(std::move(of_body), panel.size.thickness_mm / panel.size.edge_mm / 2));
  return overlaps;
}

namespace {

using Eigen::Vector2d;

// Cut-off in standard deviations: the tail beyond is 2e-9.
constexpr double max_deviations = 6;
constexpr double far = max_deviations * BlurredLight::deviation;
// Position of a part of a cell's area, as a fraction of the distance from the cell's middle to a body. It is
// for cells of more than four walls. Hexagons, bricks and octagons then cover their middles by 1.00, 1.03 and
// 1.03, squares between octagons by 0.99.
constexpr double outward_share = 0.57;

/// Returns the density at x of a Gaussian of deviation 1 about 0.
double bell(double x) { return std::exp(-x * x / 2) / std::sqrt(2 * pi); }

/// Returns the part of that Gaussian between two positions.
double share(double from, double to) {
  constexpr double root_half = 1 / std::numbers::sqrt2;
  return 0.5 * (std::erf(to * root_half) - std::erf(from * root_half));
}

/// The blurred shadow of a rectangle, dimensionless, and its derivatives, per cell edge.
struct Shadow {
  double value = 0;
  double by_along = 0, by_across = 0;  ///< derivatives by the position at which it is read
  double by_length = 0;
};

/// Computes the shadow of a rectangle. All lengths are in cell edges.
/// @param along, across position in the rectangle's frame: from its start, and from its middle line
Shadow shadow_of(double along, double across, double length, double half_thickness) {
  constexpr double unit = 1 / BlurredLight::deviation;
  const double start = -along * unit, end = (length - along) * unit, low = (-half_thickness - across) * unit,
               high = (half_thickness - across) * unit;
  const double lengthwise = share(start, end), crosswise = share(low, high);
  return {lengthwise * crosswise, (bell(start) - bell(end)) * unit * crosswise,
          lengthwise * (bell(low) - bell(high)) * unit, bell(end) * unit * crosswise};
}

/// Returns the cover by a blot of area 1 at a distance.
double cover_of(const Vector2d& offset) {
  constexpr double square = BlurredLight::deviation * BlurredLight::deviation;
  return std::exp(-offset.squaredNorm() / (2 * square)) / (2 * pi * square);
}

/// Points sorted into the squares of a grid.
class Bins {
 public:
  /// @param width side of a square, > 0
  Bins(const std::vector<Vector2d>& points, double width) : width_(width) {
    Vector2d high = low_ = points[0];
    for (const Vector2d& p : points) {
      low_ = low_.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    columns_ = column(high.x()) + 1;
    rows_ = row(high.y()) + 1;
    bins_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (std::size_t k = 0; k < points.size(); ++k)
      bins_[static_cast<std::size_t>(row(points[k].y())) * columns_ + column(points[k].x())].push_back(
          static_cast<int>(k));
  }

  /// Calls visit(index) for all points within the distance of a position, and for some beyond.
  template <class Visit>
  void near(const Vector2d& at, double distance, const Visit& visit) const {
    const int left = std::max(0, column(at.x() - distance)),
              right = std::min(columns_ - 1, column(at.x() + distance)),
              top = std::min(rows_ - 1, row(at.y() + distance));
    for (int j = std::max(0, row(at.y() - distance)); j <= top; ++j)
      for (int i = left; i <= right; ++i)
        for (const int k : bins_[static_cast<std::size_t>(j) * columns_ + i]) visit(k);
  }

 private:
  int column(double x) const { return static_cast<int>(std::floor((x - low_.x()) / width_)); }
  int row(double y) const { return static_cast<int>(std::floor((y - low_.y()) / width_)); }

  double width_;
  Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> bins_;
};

bool all_finite(const std::vector<Vector2d>& points) {
  return std::all_of(points.begin(), points.end(), [](const Vector2d& p) { return p.allFinite(); });
}

Vector2d across(const Vector2d& along) { return {-along.y(), along.x()}; }

}  // namespace

PanelGradient::PanelGradient(const Linkage& panel)
    : state(Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(panel.bodies.size()))),
      t(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(panel.hinges.size()))),
      offset(t) {}

BlurredLight::BlurredLight(const Linkage& panel, const State& state)
    : BlurredLight(panel, state, Unscaled{}) {
  const State rest = rest_state(panel);
  const std::vector<Reading> flat = BlurredLight(panel, rest, Unscaled{}).readings_;
  std::map<std::size_t, std::size_t> deepest;  // cell with the most cover, by number of walls
  for (std::size_t c = 0; c < flat.size(); ++c) {
    const auto [at, is_new] = deepest.try_emplace(panel.cells[c].bodies.size(), c);
    if (!is_new && flat[c].cover > flat[at->second].cover) at->second = c;
  }
  for (std::size_t c = 0; c < flat.size(); ++c) {
    const Reading& middle = flat[deepest.at(panel.cells[c].bodies.size())];
    scale_[c] = middle.shadow / middle.cover * flat[c].cover / flat[c].shadow;
    light_[c] = 1 - scale_[c] * readings_[c].shadow / readings_[c].cover;
  }
}

BlurredLight::BlurredLight(const Linkage& panel, const State& state, Unscaled)
    : panel_(panel),
      state_(state),
      half_thickness_(panel.size.thickness_mm / panel.size.edge_mm / 2),
      readings_(panel.cells.size()),
      scale_(panel.cells.size(), 1.0),
      light_(panel.cells.size(), std::numeric_limits<double>::quiet_NaN()) {
  const double L = panel.size.edge_mm;
  for (const Plate& p : panel.plates)
    strips_.push_back({state[p.body].p.head<2>() / L, (state[p.body].R * p.edge).head<2>(), p.length});
  for (const WallOverlap& overlap : wall_overlaps(panel)) {
    const Pose& pose = state[laps_.size()];
    laps_.push_back({pose.p.head<2>() / L + pose.R.topLeftCorner<2, 2>() * overlap.middle, overlap.area});
  }
  for (int c = 0; c < static_cast<int>(panel.cells.size()); ++c) add_parts(c);
  read();
}

void BlurredLight::add_parts(int cell) {
  const LinkageCell& members = panel_.cells[cell];
  const double L = panel_.size.edge_mm, whole = area(opening(panel_, state_, members)),
               share = 1 / static_cast<double>(members.bodies.size());
  Vector2d sum = Vector2d::Zero();
  for (const int b : members.bodies) sum += state_[b].p.head<2>() / L;
  const Vector2d& middle = middles_.emplace_back(sum / static_cast<double>(members.bodies.size()));
  if (members.bodies.size() <= 4) {
    parts_.push_back({cell, members.bodies.front(), 0, 1, {middle, whole}});
    return;
  }
  for (const int b : members.bodies) {
    const Vector2d at = (1 - outward_share) * middle + outward_share * state_[b].p.head<2>() / L;
    parts_.push_back({cell, b, outward_share, share, {at, share * whole}});
  }
}

void BlurredLight::read() {
  std::vector<Vector2d> walls, laps, parts;
  double longest = 0;
  for (const Strip& strip : strips_) {
    walls.push_back(strip.from + strip.length / 2 * strip.along);
    longest = std::max(longest, strip.length);
  }
  for (const Blot& lap : laps_) laps.push_back(lap.middle);
  for (const Part& part : parts_) parts.push_back(part.blot.middle);
  if (!all_finite(walls) || !all_finite(laps) || !all_finite(parts)) return;
  const Bins wall_bins(walls, deviation), lap_bins(laps, deviation), part_bins(parts, deviation);
  for (std::size_t c = 0; c < middles_.size(); ++c) {
    Reading& r = readings_[c];
    wall_bins.near(middles_[c], far + longest / 2, [&](int k) {
      const Vector2d to = middles_[c] - strips_[k].from;
      r.strips.push_back(k);
      r.shadow += shadow_of(to.dot(strips_[k].along), to.dot(across(strips_[k].along)), strips_[k].length,
                            half_thickness_)
                      .value;
    });
    lap_bins.near(middles_[c], far, [&](int k) {
      r.laps.push_back(k);
      r.shadow -= laps_[k].area * cover_of(middles_[c] - laps[k]);
    });
    part_bins.near(middles_[c], far, [&](int k) {
      r.parts.push_back(k);
      r.cover += parts_[k].blot.area * cover_of(middles_[c] - parts[k]);
    });
  }
}

void BlurredLight::add_gradient(const Eigen::VectorXd& by_value, PanelGradient& gradient) const {
  std::vector<double> by_area(middles_.size(), 0.0);
  for (int c = 0; c < static_cast<int>(readings_.size()); ++c) {
    const Reading& r = readings_[c];
    const double by_shadow = -by_value[c] * scale_[c] / r.cover, by_cover = -by_shadow * r.shadow / r.cover;
    for (const int k : r.strips) add_strip_gradient(c, k, by_shadow, gradient);
    for (const int k : r.laps) add_lap_gradient(c, k, by_shadow, gradient);
    for (const int k : r.parts)
      by_area[parts_[k].cell] += parts_[k].share * add_part_gradient(c, k, by_cover, gradient);
  }
  for (std::size_t c = 0; c < middles_.size(); ++c) add_area(static_cast<int>(c), by_area[c], gradient);
}

void BlurredLight::add_strip_gradient(int cell, int strip, double by_shadow, PanelGradient& gradient) const {
  const Strip& s = strips_[strip];
  const Plate& plate = panel_.plates[strip];
  const Vector2d to = middles_[cell] - s.from;
  const double u = to.dot(s.along), v = to.dot(across(s.along));
  const Shadow shadow = shadow_of(u, v, s.length, half_thickness_);
  const Vector2d by_place = by_shadow * (shadow.by_along * s.along + shadow.by_across * across(s.along));
  add_middle(cell, by_place, gradient);
  const Eigen::Index body = 6 * plate.body;
  gradient.state[body + 2] += by_shadow * (shadow.by_along * v - shadow.by_across * u);
  gradient.state.segment<2>(body + 3) -= by_place;
  gradient.t[plate.hinge] += by_shadow * shadow.by_length * plate.length_t;
}

void BlurredLight::add_lap_gradient(int cell, int lap, double by_shadow, PanelGradient& gradient) const {
  const Vector2d offset = middles_[cell] - laps_[lap].middle;
  const Vector2d by_place = by_shadow * laps_[lap].area * cover_of(offset) / (deviation * deviation) * offset;
  add_middle(cell, by_place, gradient);
  const Vector2d arm = laps_[lap].middle - state_[lap].p.head<2>() / panel_.size.edge_mm;
  gradient.state[6 * lap + 2] -= across(arm).dot(by_place);
  gradient.state.segment<2>(6 * lap + 3) -= by_place;
}

double BlurredLight::add_part_gradient(int cell, int part, double by_cover, PanelGradient& gradient) const {
  const Part& p = parts_[part];
  const Vector2d offset = middles_[cell] - p.blot.middle;
  const double cover = cover_of(offset);
  const Vector2d by_place = -by_cover * p.blot.area * cover / (deviation * deviation) * offset;
  add_middle(cell, by_place, gradient);
  add_middle(p.cell, -(1 - p.out) * by_place, gradient);
  gradient.state.segment<2>(6 * static_cast<Eigen::Index>(p.body) + 3) -= p.out * by_place;
  return by_cover * cover;
}

void BlurredLight::add_area(int cell, double by_area, PanelGradient& gradient) const {
  const LinkageCell& members = panel_.cells[cell];
  const CellReading area = area_reading(opening(panel_, state_, members));
  for (std::size_t k = 0; k < members.bodies.size(); ++k) {
    gradient.state.segment<3>(6 * members.bodies[k] + 2) += by_area * area.bodies.col(k);
    gradient.t[members.hinges[k]] += by_area * area.t[k];
  }
}

void BlurredLight::add_middle(int cell, const Vector2d& by_middle, PanelGradient& gradient) const {
  const std::vector<int>& bodies = panel_.cells[cell].bodies;
  for (const int b : bodies)
    gradient.state.segment<2>(6 * b + 3) += by_middle / static_cast<double>(bodies.size());
}

}  // namespace kinetix::model
