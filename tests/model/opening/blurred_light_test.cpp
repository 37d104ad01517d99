#include "model/opening/blurred_light.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/base/angle.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

// mm: walls as thick as those of the displays that ship.
constexpr CellSize size = {10, 0.8, 6};

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double part = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - part * (b - a)).norm();
}

/// Light at a place by a sum over a fine raster: 1 where no wall stands. Cell edges.
double raster_light(const Linkage& panel, const State& state, const Vector2d& at) {
  constexpr double pixel = 0.01, reach = 2.2;
  double light = 0, whole = 0;
  for (double x = -reach; x <= reach; x += pixel)
    for (double y = -reach; y <= reach; y += pixel) {
      const double weight =
          std::exp(-(x * x + y * y) / (2 * BlurredLight::deviation * BlurredLight::deviation));
      bool dark = false;
      for (const Plate& p : panel.plates) {
        const Vector2d from = state[p.body].p.head<2>() / panel.size.edge_mm;
        const Vector2d to = from + p.length * (state[p.body].R * p.edge).head<2>();
        dark = dark || distance_to_segment(at + Vector2d(x, y), from, to) <
                           panel.size.thickness_mm / panel.size.edge_mm / 2;
        if (dark) break;
      }
      whole += weight;
      if (!dark) light += weight;
    }
  return light / whole;
}

TEST(BlurredLight, IsWhatARasterShowsButForWhereWallsOverlap) {
  for (const double theta : {0.0, 0.35, 0.6}) {
    auto design = ExactDesign<double>::basic(7, 7);
    design.theta = theta;
    const Structure sheet = sheet_of(design, size);
    const Linkage panel = sheet;
    const State state = fold(design, sheet);
    const std::size_t middle = panel.cells.size() / 2;
    Vector2d at = Vector2d::Zero();
    for (const int b : panel.cells[middle].bodies) at += state[b].p.head<2>() / 40.0;
    // Walls that meet count twice there: a square of the walls' thickness a vertex.
    EXPECT_NEAR(BlurredLight(panel, state).values()[middle], raster_light(panel, state, at), 0.012) << theta;
  }
}

TEST(BlurredLight, OfAFlatPanelIsTheSameInAllCells) {
  const Structure sheet = make_sheet(6, 4, size);
  const std::vector<double> light = BlurredLight(sheet, rest_state(sheet)).values();
  for (const double of_cell : light) EXPECT_NEAR(of_cell, light.front(), 1e-13);
  // Two walls of thickness 0.08 a cell, less what they share at a vertex twice.
  EXPECT_NEAR(light.front(), 1 - 2 * 0.08, 0.01);
}

TEST(BlurredLight, SlopesMatchCentralDifferences) {
  std::mt19937 random(2);
  const Structure sheet = testing::random_panel(3, 2, random, true);
  const State state = testing::shaken(sheet, rest_state(sheet), 0.2, random, true);
  Eigen::VectorXd weights(static_cast<Eigen::Index>(sheet.cells.size()));
  for (Eigen::Index c = 0; c < weights.size(); ++c) weights[c] = std::sin(1.0 + static_cast<double>(c));
  const auto sum = [&](const Structure& s, const State& moved) {
    const std::vector<double> light = BlurredLight(s, moved).values();
    return Eigen::VectorXd::Constant(
        1, weights.dot(Eigen::Map<const Eigen::VectorXd>(light.data(), weights.size())));
  };
  PanelGradient gradient{Linkage(sheet)};
  const Linkage panel = sheet;
  BlurredLight(panel, state).add_gradient(weights, gradient);

  const auto by_state = [&](const Eigen::VectorXd& x) {
    return sum(sheet, retract_straight(sheet, state, x));
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
  testing::expect_jacobian(
      [&](const Eigen::VectorXd& q) {
        Structure s = sheet;
        for (std::size_t h = 0; h < s.hinges.size(); ++h)
          s.hinges[h].parameters.t += q[static_cast<Eigen::Index>(h)];
        return sum(s, state);
      },
      Eigen::VectorXd::Zero(gradient.t.size()), gradient.t.transpose());
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
