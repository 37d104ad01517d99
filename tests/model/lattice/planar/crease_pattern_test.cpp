#include "model/lattice/planar/crease_pattern.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/creased.hpp"
#include "tests/support/miura.hpp"

namespace kinetix::model {
namespace {

/// Facets stay flat and as large as the plane's motion has them, and the dihedral angle at every crease is that of its
/// multiplier, by the positions of vertices alone.
void expect_folded_by_its_multipliers(const PlanarStructure& s, double theta) {
  const CreasePattern p = crease_pattern(s, redrawing_of(s).y, theta);
  std::vector<Eigen::Vector3d> normals;
  for (const auto& facet : p.facets) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::size_t k = 1; k + 1 < facet.size(); ++k)
      area += (p.folded[facet[k]] - p.folded[facet[0]]).cross(p.folded[facet[k + 1]] - p.folded[facet[0]]);
    normals.push_back(area.normalized());
    for (const int v : facet)
      EXPECT_NEAR(normals.back().dot(p.folded[v] - p.folded[facet[0]]) / s.size.edge_mm, 0, 1e-12);
  }
  const PlanarCreases creases = find_creases(s);
  int inner = 0;
  for (const CreasePattern::Edge& edge : p.edges) {
    if (edge.crease < 0) continue;
    ++inner;
    const PlanarCrease& crease = creases.list[edge.crease];
    EXPECT_NEAR(normals[crease.from].dot(normals[crease.to]),
                std::cos(2 * std::atan(edge.multiplier * std::sin(theta))), 1e-12);
  }
  EXPECT_EQ(inner, static_cast<int>(creases.list.size()));
  EXPECT_EQ(p.flat.size() + p.facets.size(), p.edges.size() + 1) << "Euler's formula";
}

TEST(CreasePattern, HasTheFacetsOfTheSheetFoldedByTheirMultipliers) {
  for (const double theta : {0.0, 0.3, 0.8}) {
    expect_folded_by_its_multipliers(testing::miura_of_hexagons(5, 4, pi / 3, 0.9), theta);
    expect_folded_by_its_multipliers(testing::creased(lattice_graph(honeycomb_lattice, 5, 4)).structure,
                                     theta);
    expect_folded_by_its_multipliers(testing::creased_rhombi(5, 4, 1.2), theta);
    expect_folded_by_its_multipliers(testing::creased_quads(6, 2), theta);
  }
}

// Valleys rise: seen from above, facets beside a crease of positive multiplier come up.
TEST(CreasePattern, CountsValleysPositive) {
  PlanarStructure s = make_planar_structure(lattice_graph(honeycomb_lattice, 3, 3), {});
  for (const int h : testing::creased(s.graph).hinges) set_fold(s, h, Eigen::Vector2d::UnitX(), 0.7);
  const CreasePattern p = crease_pattern(s, redrawing_of(s).y, 0.5);
  double highest = 0, lowest = 0;
  for (const Eigen::Vector3d& at : p.folded) {
    highest = std::max(highest, at.z());
    lowest = std::min(lowest, at.z());
  }
  EXPECT_GT(highest, 0.1);
  EXPECT_GE(lowest, -1e-12);
  for (const CreasePattern::Edge& edge : p.edges)
    if (edge.crease >= 0) {
      EXPECT_NEAR(edge.multiplier, 0.7, 1e-12);
    }
}

}  // namespace
}  // namespace kinetix::model
