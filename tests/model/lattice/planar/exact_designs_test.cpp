#include "model/lattice/planar/exact_designs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "model/lattice/square/family/classification.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::disc_of_squares;
using testing::random_quads;

struct Case {
  const char* name;
  PlanarGraph graph;
  int self_stresses = 0;
};

/// Returns the graph of a cube seen from above. The picture of any polyhedron carries a self-stress (Maxwell 1864).
PlanarGraph make_nested_squares() {
  return {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
          {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
}

std::vector<Case> cases() {
  return {{"squares", square_graph(7, 5)},
          {"disc of squares", disc_of_squares(12)},
          {"rhombi", lattice_graph(rhombus_lattice, 6, 4, 1.1)},
          {"random quads", random_quads(6, 1)},
          {"honeycomb", lattice_graph(honeycomb_lattice, 5, 4)},
          {"bricks", lattice_graph(brick_lattice, 5, 4)},
          {"octagons", lattice_graph(octagon_lattice, 4, 3)},
          {"square in a square", make_nested_squares(), 1},
          {"a chain of walls", {{{0, 0}, {1, 0}, {2, 0.5}}, {{0, 1}, {1, 2}}}}};
}

/// Returns the matrix of kinematics.md section 5, written out: two rows per cell, one column per wall.
MatrixXd conditions(const PlanarStructure& s) {
  MatrixXd m = MatrixXd::Zero(2 * s.faces.size(), s.hinges.size());
  for (int f = 0; f < static_cast<int>(s.faces.size()); ++f)
    for (std::size_t k = 0; k < s.faces[f].vertices.size(); ++k) {
      const std::size_t next = (k + 1) % s.faces[f].vertices.size();
      m.block<2, 1>(2 * f, s.faces[f].edges[k]) +=
          s.graph.vertices[s.faces[f].vertices[next]] - s.graph.vertices[s.faces[f].vertices[k]];
    }
  return m;
}

void place(const VectorXd& s_of_walls, PlanarStructure& s) {
  for (std::size_t h = 0; h < s.hinges.size(); ++h)
    s.hinges[h].t = (1 + s.senses[s.graph.edges[h].from] * s_of_walls[h]) / 2;
}

TEST(ExactDesigns, HaveTheDimensionOfTheirCountAndOfADenseRank) {
  for (const Case& c : cases()) {
    const PlanarStructure s = make_planar_structure(c.graph, {});
    const ExactDesigns designs(s);
    const int bodies = static_cast<int>(s.graph.vertices.size()), cells = static_cast<int>(s.faces.size());
    EXPECT_EQ(designs.self_stresses(), c.self_stresses) << c.name;
    EXPECT_EQ(designs.dimension(), bodies - cells - 1 + c.self_stresses) << c.name;
    if (cells == 0) continue;
    const Eigen::Index rank = conditions(s).colPivHouseholderQr().rank();
    EXPECT_EQ(designs.dimension(), static_cast<int>(s.hinges.size() - rank)) << c.name;
  }
}

TEST(ExactDesigns, OfSquaresAreTheFamilyF1) {
  for (const auto& [columns, rows] : {std::pair(1, 1), {4, 1}, {6, 9}})
    EXPECT_EQ(ExactDesigns(make_planar_structure(square_graph(columns, rows), {})).dimension(),
              columns + rows);
}

TEST(ExactDesigns, CloseAtAnyThetaAndHaveNumbersOfTheirOwn) {
  for (const Case& c : cases()) {
    PlanarStructure s = make_planar_structure(c.graph, {});
    const ExactDesigns designs(s);
    std::srand(5);
    const VectorXd numbers = 0.3 * VectorXd::Random(designs.dimension());
    const VectorXd design = designs.design(numbers);
    EXPECT_NEAR(design.norm(), numbers.norm(), 1e-13) << c.name << ": the basis is orthonormal";
    EXPECT_LE((designs.numbers(design) - numbers).lpNorm<Eigen::Infinity>(), 1e-13) << c.name;
    place(design, s);
    const ExactMotion motion = exact_motion(s);
    ASSERT_TRUE(motion) << c.name << ": " << motion.why;
    for (const double theta : {-0.8, 0.2, 1.1})
      EXPECT_LE(hinge_gaps(s, motion.at(theta)).max, 1e-13) << c.name;
  }
}

TEST(ExactDesigns, NearestIsTheOrthogonalProjection) {
  for (const Case& c : cases()) {
    PlanarStructure s = make_planar_structure(c.graph, {});
    if (s.faces.empty()) continue;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> by(-0.2, 0.2);
    VectorXd desired(s.hinges.size());
    for (double& value : desired) value = by(random);
    place(desired, s);
    const PlanarStructure exact = nearest_exact(s);
    EXPECT_TRUE(exact_motion(exact)) << c.name;

    const MatrixXd m = conditions(s);
    const VectorXd projected = desired - m.completeOrthogonalDecomposition().solve(m * desired);
    const ExactDesigns designs(s);
    EXPECT_LE((designs.design(designs.numbers(desired)) - projected).lpNorm<Eigen::Infinity>(), 1e-13)
        << c.name;
    PlanarStructure expected = s;
    place(projected, expected);
    for (std::size_t h = 0; h < s.hinges.size(); ++h)
      EXPECT_NEAR(exact.hinges[h].t, expected.hinges[h].t, 1e-13) << c.name;
  }
}

TEST(ExactDesigns, NearestKeepsOffsets) {
  PlanarStructure s = make_planar_structure(lattice_graph(honeycomb_lattice, 4, 4), {});
  s.hinges[10].offset = 0.05;
  const PlanarStructure exact = nearest_exact(s);
  EXPECT_FALSE(exact_motion(s));
  EXPECT_TRUE(exact_motion(exact));
  EXPECT_EQ(exact.hinges[10].offset, 0.05);
}

}  // namespace
}  // namespace kinetix::model
