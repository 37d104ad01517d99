#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "model/base/geometry.hpp"
#include "model/lattice/planar/planar_structure.hpp"
#include "model/lattice/planar/regular_lattices.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "model/opening/blurred_light.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

constexpr double thickness = 0.4;  // cell edges: thick, so that a raster counts much

/// One body with half walls at these angles, rad.
Linkage body_with(const std::vector<double>& angles) {
  Linkage panel;
  panel.size = {10, 10 * thickness, 6};
  panel.bodies.resize(1);
  for (const double angle : angles) {
    Plate& plate = panel.plates.emplace_back();
    plate.edge = {std::cos(angle), std::sin(angle), 0};
  }
  return panel;
}

TEST(WallOverlaps, OfACornerIsASquareOfHalfTheThickness) {
  const WallOverlap corner = wall_overlaps(body_with({pi / 2, 0})).front();
  EXPECT_NEAR(corner.area, thickness * thickness / 4, 1e-15);
  EXPECT_NEAR((corner.middle - Vector2d::Constant(thickness / 4)).norm(), 0, 1e-15);
}

TEST(WallOverlaps, OfAStraightWallIsNothing) {
  const WallOverlap straight = wall_overlaps(body_with({0, pi})).front();
  EXPECT_EQ(straight.area, 0);
  EXPECT_EQ(straight.middle, Vector2d::Zero());
}

/// Returns how many half walls of the body cover a place, cell edges.
long covers_at(const Linkage& panel, const Vector2d& place) {
  return std::count_if(panel.plates.begin(), panel.plates.end(), [&](const Plate& plate) {
    const Vector2d along = plate.edge.head<2>();
    return place.dot(along) > 0 && std::abs(along.x() * place.y() - along.y() * place.x()) < thickness / 2;
  });
}

/// A raster counts the area that more than one half wall covers, each time except the first.
TEST(WallOverlaps, AreWhatARasterCountsTwice) {
  constexpr double pixel = 2e-3, reach = 1;  // cell edges
  const std::vector<std::vector<double>> bodies = {
      {0.3, 1.5}, {0.2, 2.1}, {0.0, 1.2, 3.5}, {0.4, 1.6, 2.9, 4.7}, {0.0, 1.1, 2.2, 3.3, 4.4}};
  for (const std::vector<double>& angles : bodies) {
    const Linkage panel = body_with(angles);
    double area = 0;
    Vector2d sum = Vector2d::Zero();
    for (double x = -reach + pixel / 2; x < reach; x += pixel)
      for (double y = -reach + pixel / 2; y < reach; y += pixel)
        if (const long covers = covers_at(panel, {x, y}); covers > 1) {
          area += pixel * pixel * static_cast<double>(covers - 1);
          sum += pixel * pixel * static_cast<double>(covers - 1) * Vector2d(x, y);
        }
    const WallOverlap found = wall_overlaps(panel).front();
    EXPECT_NEAR(found.area, area, 1e-3) << angles.size();
    EXPECT_NEAR((found.middle - sum / area).norm(), 0, 2e-3) << angles.size();
  }
}

// mm: walls as thick as those of the displays that ship.
constexpr CellSize size = {10, 0.8, 6};

/// Half wall in a state: a rectangle from its vertex to its hinge. All in cell edges.
struct Shadow {
  Vector2d from, along;
  double length, half_thickness;

  bool covers(const Vector2d& place) const {
    const Vector2d at = place - from;
    const double on = at.dot(along), beside = std::abs(along.x() * at.y() - along.y() * at.x());
    return on > 0 && on < length && beside < half_thickness;
  }
};

/// Returns the half walls of which a part may be within `reach` of a place, cell edges.
std::vector<Shadow> shadows_near(const Linkage& panel, const State& state, const Vector2d& at, double reach) {
  std::vector<Shadow> near;
  for (const Plate& plate : panel.plates) {
    const Shadow shadow{state[plate.body].p.head<2>() / panel.size.edge_mm,
                        (state[plate.body].R * plate.edge).head<2>(), plate.length,
                        panel.size.thickness_mm / panel.size.edge_mm / 2};
    if ((shadow.from - at).norm() < reach + shadow.length + shadow.half_thickness) near.push_back(shadow);
  }
  return near;
}

/// Light at a place by a sum over a fine raster: 1 where no wall stands. Cell edges.
double raster_light(const Linkage& panel, const State& state, const Vector2d& at) {
  constexpr double pixel = 0.01, reach = 2.2;
  const std::vector<Shadow> near = shadows_near(panel, state, at, std::sqrt(2.0) * reach);
  double light = 0, whole = 0;
  for (double x = -reach; x <= reach; x += pixel)
    for (double y = -reach; y <= reach; y += pixel) {
      const double weight =
          std::exp(-(x * x + y * y) / (2 * BlurredLight::deviation * BlurredLight::deviation));
      const Vector2d place = at + Vector2d(x, y);
      const bool dark =
          std::any_of(near.begin(), near.end(), [&](const Shadow& shadow) { return shadow.covers(place); });
      whole += weight;
      if (!dark) light += weight;
    }
  return light / whole;
}

void expect_as_in_raster(double theta, double thickness_mm, double tolerance) {
  auto design = ExactDesign<double>::basic(7, 7);
  design.theta = theta;
  const Structure sheet = sheet_of(design, {10, thickness_mm, 6});
  const Linkage panel = sheet;
  const State state = fold(design, sheet);
  const std::size_t middle = panel.cells.size() / 2;
  Vector2d at = Vector2d::Zero();
  for (const int b : panel.cells[middle].bodies) at += state[b].p.head<2>() / 40.0;
  EXPECT_NEAR(BlurredLight(panel, state).values()[middle], raster_light(panel, state, at), tolerance)
      << thickness_mm << " mm at " << theta;
}

TEST(BlurredLight, IsWhatARasterShows) {
  expect_as_in_raster(0, 0.8, 0.005);  // flat, cells cover 2.9 % too much in their middles
  for (const double theta : {0.35, 0.6}) expect_as_in_raster(theta, 0.8, 0.005);
}

// Regression: a larger cell's area was once covered from its middle alone, by 1.7 of a hexagon and 3.1 of an octagon.
// Such panels showed too much light, and letters stood out by half as much again.
TEST(BlurredLight, OfOtherLatticesIsWhatARasterShows) {
  for (const PlanarLattice* lattice : {&honeycomb_lattice, &brick_lattice, &octagon_lattice})
    for (const double theta : {0.0, 0.35}) {
      const PlanarStructure sheet = make_planar_structure(LatticeSheet{lattice, lattice_cells(5, 5)}, size);
      const Linkage panel = sheet;
      State state = rest_state(panel);
      for (std::size_t b = 0; b < state.size(); ++b) {  // centred hinges: uniform shrinking
        state[b].p *= std::cos(theta);
        state[b].R = Eigen::AngleAxisd(sheet.senses[b] * theta, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      }
      const std::size_t middle = 12;  // of the lattice's own 25 cells, which come first
      const std::vector<int>& bodies = panel.cells[middle].bodies;
      Vector2d at = Vector2d::Zero();
      for (const int b : bodies) at += state[b].p.head<2>() / 10.0 / static_cast<double>(bodies.size());
      EXPECT_NEAR(BlurredLight(panel, state).values()[middle], raster_light(panel, state, at), 0.005)
          << lattice->name << " at " << theta;
    }
}

// Regression: walls that meet at a vertex once counted twice there, by 0.16 for such walls, and light fell below zero.
// One half of a wall that lies over the other still counts twice.
TEST(BlurredLight, IsNearWhatARasterShowsOfThickWalls) {
  expect_as_in_raster(0, 4, 0.02);
  expect_as_in_raster(0.3, 4, 0.02);
  expect_as_in_raster(0.6, 4, 0.1);
}

// Its corners, which two walls cover, lie towards its middle: on the other side of their vertices they would count for half.
TEST(BlurredLight, OfOneCellIsWhatARasterShows) {
  const Linkage panel = make_sheet(1, 1, {10, 4, 6});
  const State flat = rest_state(panel);
  const double cover =
      1 / (2 * pi * BlurredLight::deviation * BlurredLight::deviation);  // of one cell's area
  const double shadow = 1 - raster_light(panel, flat, {0.5, 0.5});
  EXPECT_NEAR(BlurredLight(panel, flat).values().front(), 1 - shadow / cover, 0.01);
}

TEST(BlurredLight, OfAFlatPanelIsTheSameInAllCells) {
  const Structure sheet = make_sheet(6, 4, size);
  const std::vector<double> light = BlurredLight(sheet, rest_state(sheet)).values();
  for (const double of_cell : light) EXPECT_NEAR(of_cell, light.front(), 1e-13);
  // Two walls of thickness 0.08 a cell, which cross at a vertex.
  EXPECT_NEAR(light.front(), (1 - 0.08) * (1 - 0.08), 0.007);
}

/// Checks the slopes of a panel with hinges up to 0.03 cell edges off their walls, turned by up to 0.4 rad.
/// @param parameters of a hinge of a sheet
template <class Sheet, class Parameters>
void expect_slopes(Sheet sheet, const Parameters& parameters, std::mt19937& random) {
  const std::size_t hinges = Linkage(sheet).hinges.size();
  for (std::size_t h = 0; h < hinges; ++h)
    parameters(sheet, h).offset = 0.03 * std::sin(static_cast<double>(h));
  const Linkage panel = sheet;
  const State state = testing::shaken(panel, rest_state(panel), 0.2, random, true);
  Eigen::VectorXd weights(static_cast<Eigen::Index>(panel.cells.size()));
  for (Eigen::Index c = 0; c < weights.size(); ++c) weights[c] = std::sin(1.0 + static_cast<double>(c));
  const auto sum = [&](const Linkage& s, const State& moved) {
    const std::vector<double> light = BlurredLight(s, moved).values();
    return Eigen::VectorXd::Constant(
        1, weights.dot(Eigen::Map<const Eigen::VectorXd>(light.data(), weights.size())));
  };
  PanelGradient gradient(panel);
  BlurredLight(panel, state).add_gradient(weights, gradient);

  const auto by_state = [&](const Eigen::VectorXd& x) {
    return sum(panel, retract_straight(panel, state, x));
  };
  Eigen::VectorXd planar = gradient.state;
  testing::expect_jacobian(
      [&](const Eigen::VectorXd& q) {
        Eigen::VectorXd x = Eigen::VectorXd::Zero(planar.size());
        for (Eigen::Index b = 0; b < planar.size() / 6; ++b) x.segment<3>(6 * b + 2) = q.segment<3>(3 * b);
        return by_state(x);
      },
      Eigen::VectorXd::Zero(planar.size() / 2),
      [&] {
        Eigen::MatrixXd row(1, planar.size() / 2);
        for (Eigen::Index b = 0; b < planar.size() / 6; ++b)
          row.middleCols<3>(3 * b) = planar.segment<3>(6 * b + 2).transpose();
        return row;
      }());
  const auto by_parameter = [&](double HingeParameters::*parameter) {
    return [&, parameter](const Eigen::VectorXd& q) {
      Sheet s = sheet;
      for (std::size_t h = 0; h < hinges; ++h) parameters(s, h).*parameter += q[static_cast<Eigen::Index>(h)];
      return sum(s, state);
    };
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(gradient.t.size());
  testing::expect_jacobian(by_parameter(&HingeParameters::t), none, gradient.t.transpose());
  testing::expect_jacobian(by_parameter(&HingeParameters::offset), none, gradient.offset.transpose());
}

TEST(BlurredLight, SlopesMatchCentralDifferences) {
  for (const double thickness_mm : {0.8, 4.0}) {
    std::mt19937 random(2);
    Structure sheet = testing::random_panel(3, 2, random, true);
    sheet.size.thickness_mm = thickness_mm;
    const auto parameters = [](Structure& s, std::size_t h) -> HingeParameters& {
      return s.hinges[h].parameters;
    };
    expect_slopes(sheet, parameters, random);
  }
}

TEST(BlurredLight, SlopesMatchCentralDifferencesOnHexagons) {
  std::mt19937 random(3);
  const auto parameters = [](PlanarStructure& s, std::size_t h) -> HingeParameters& { return s.hinges[h]; };
  expect_slopes(make_planar_structure(LatticeSheet{&honeycomb_lattice, lattice_cells(2, 2)}, size),
                parameters, random);
}

TEST(BlurredLight, OfABrokenStateIsNoNumber) {
  const Structure sheet = make_sheet(2, 2, size);
  State state = rest_state(sheet);
  state[3].p.x() = NAN;
  const std::vector<double> light = BlurredLight(sheet, state).values();
  for (const double of_cell : light) EXPECT_TRUE(std::isnan(of_cell));
}

}  // namespace
}  // namespace kinetix::model
