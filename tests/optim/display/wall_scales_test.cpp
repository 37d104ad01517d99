#include "optim/display/wall_scales.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/closure/mobility.hpp"
#include "targets/display/display_goal.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;
using model::PlanarStructure;
using targets::DisplayScore;
using testing::boundary_rows;

constexpr double theta = 33 * radians_per_degree;  // rad: the fold that kinematics.md measures pictures at

std::vector<std::string> letter_t() {
  std::vector<std::string> rows = {"000000000000"};
  rows.insert(rows.end(), 3, "011111111110");
  rows.insert(rows.end(), 7, "000011110000");
  rows.push_back("000000000000");
  return rows;
}

/// Levels of the faces of a panel of squares. @param rows of '0' and '1', top row first
std::vector<double> levels_of(const PlanarStructure& s, const std::vector<std::string>& rows) {
  std::vector<double> levels;
  for (const model::GraphFace& face : s.faces) {
    Vector2d low = s.graph.vertices[face.vertices[0]];
    for (const int v : face.vertices) low = low.cwiseMin(s.graph.vertices[v]);
    const auto i = std::lround(low.x()), j = std::lround(low.y());
    levels.push_back(rows[rows.size() - 1 - static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] - '0');
  }
  return levels;
}

std::vector<double> areas(const PlanarStructure& s, const model::State& state) {
  std::vector<double> areas;
  for (const model::GraphFace& face : s.faces) {
    double twice = 0;
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const Eigen::Vector3d &p = state[face.vertices[k]].p,
                            &q = state[face.vertices[(k + 1) % face.vertices.size()]].p;
      twice += p.x() * q.y() - p.y() * q.x();
    }
    areas.push_back(twice / 2);
  }
  return areas;
}

TEST(ScaleWalls, MakesALetterTOfClosedHingesAlone) {
  PlanarStructure s = model::make_planar_structure(model::square_graph(12, 12), {});
  const std::vector<double> levels = levels_of(s, letter_t());
  struct Case {
    double offset;
    bool straight;
    double ratio;  ///< kinematics.md section 5, from scratch code
  };
  for (const auto& [offset, straight, ratio] :
       {Case{0.04, true, 1.14}, Case{0.08, true, 1.26}, Case{0.08, false, 1.39}}) {
    WallScales scales{.wanted = wanted_scales(levels, s, offset), .offset = offset};
    if (straight) scales.straight = boundary_rows(s.graph);
    const ScaledWalls found = scale_walls(s, scales);
    EXPECT_TRUE(found.converged) << found.iterations;
    EXPECT_LE(found.offset, offset * (1 + 1e-15));
    EXPECT_LE(found.shift, 0.6 * (1 + 1e-15));
    place_hinges(found.y, s);
    validate_hinges(s);
    const model::Linkage linkage = s;
    for (const double at : {-0.4, 0.2, theta, 0.7})
      EXPECT_LE(hinge_gaps(linkage, fold(s, found.y, at)).max, 1e-13);
    const DisplayScore seen = targets::display_score(areas(s, fold(s, found.y, theta)), levels);
    EXPECT_GE(seen.letter / seen.rest, ratio - 0.02) << offset << ", straight " << straight;
    EXPECT_EQ(seen.auc, 1) << offset << ", straight " << straight;
    const DisplayScore flat = targets::display_score(areas(s, rest_state(linkage)), levels);
    EXPECT_NEAR(flat.letter / flat.rest, 1, 1e-12);
    RecordProperty("iterations", found.iterations);
    if (!straight) continue;
    const auto rows = boundary_rows(s.graph);
    for (const double at : {0.2, theta})
      for (const auto& row : rows)
        for (const int v : row)
          EXPECT_NEAR(fold(s, found.y, at)[v].p.y(), fold(s, found.y, at)[row[0]].p.y(), 1e-12);
  }
}

TEST(ScaleWalls, LeavesOneWayToMove) {
  PlanarStructure s = model::make_planar_structure(model::square_graph(6, 6), {});
  const std::vector<double> levels =
      levels_of(s, {"000000", "011110", "001100", "001100", "001100", "000000"});
  place_hinges(
      scale_walls(s, {.wanted = wanted_scales(levels, s, 0.08), .straight = boundary_rows(s.graph)}).y, s);
  const model::Mobility m = mobility(s, exact_motion(s));
  EXPECT_EQ(m.verdict, model::Verdict::mobile) << m.why;
  EXPECT_EQ(m.dofs_along, 1);
}

// The optimum of a convex problem: no step to another feasible redrawing lowers the sum.
TEST(ScaleWalls, FindsTheOptimum) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> by(-1, 1);
  const PlanarStructure s =
      model::make_planar_structure(model::lattice_graph(model::honeycomb_lattice, 4, 3), {});
  WallScales scales{.wanted = {}, .offset = 0.06, .shift = 0.3};
  for (std::size_t e = 0; e < s.graph.edges.size(); ++e) scales.wanted.push_back(0.2 * by(random));
  const ScaledWalls found = scale_walls(s, scales);
  ASSERT_TRUE(found.converged);
  const auto cost = [&](const model::ParallelDrawing& y) {
    double sum = 0, excess = 0;
    for (int e = 0; e < static_cast<int>(s.graph.edges.size()); ++e) {
      const auto [shift, offset] = change_of(s, y, e);
      sum += std::pow(2 * offset - scales.wanted[e], 2);
      excess = std::max({excess, std::abs(shift) - scales.shift, std::abs(offset) - scales.offset});
    }
    return std::pair(sum, excess);
  };
  const double best = cost(found.y).first;
  EXPECT_LE(cost(found.y).second, 1e-15);
  EXPECT_NEAR(std::sqrt(best / static_cast<double>(scales.wanted.size())), found.distance, 1e-12);
  for (int round = 0; round < 2000; ++round) {
    model::ParallelDrawing other = found.y;
    const double size = std::pow(10, -1 - 3 * std::abs(by(random)));
    for (Vector2d& p : other) p += size * Vector2d(by(random), by(random));
    const auto [sum, excess] = cost(other);
    if (excess <= 0) {
      EXPECT_GE(sum, best - 1e-5);
    }
  }
}

TEST(ScaleWalls, DropsTheLastRowByWhatIsAsked) {
  const PlanarStructure s = model::make_planar_structure(model::square_graph(6, 5), {});
  const auto rows = boundary_rows(s.graph);
  const ScaledWalls found = scale_walls(
      s, {.wanted = std::vector<double>(s.graph.edges.size(), 0.0), .straight = rows, .drop = 0.3});
  ASSERT_TRUE(found.converged);
  for (const int v : rows[1]) EXPECT_NEAR(found.y[v].x() - found.y[rows[0][0]].x(), -0.3, 1e-12);
}

TEST(ScaleWalls, RefusesWhatHasNoMeaning) {
  const PlanarStructure s = model::make_planar_structure(model::square_graph(2, 2), {});
  const auto refused = [&](WallScales scales, const char* what) {
    try {
      scales.validate(s);
      ADD_FAILURE() << what;
    } catch (const InvalidInput& e) {
      EXPECT_THAT(e.reason(), ::testing::HasSubstr(what));
    }
  };
  const std::vector<double> none(s.graph.edges.size(), 0.0);
  refused({.wanted = {0.1}}, "a value for each wall");
  refused({.wanted = none, .offset = 0}, "offset is 0, must be in (0, 0.5)");
  refused({.wanted = none, .offset = NAN}, "offset is nan");
  refused({.wanted = none, .shift = 1}, "shift is 1, must be in (0, 1)");
  refused({.wanted = none, .straight = {{0, 1}, {1, 2}}}, "vertex 1 twice");
  refused({.wanted = none, .drop = INFINITY}, "drop is inf");
}

}  // namespace
}  // namespace kinetix::optim
