#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "model/closure/mobility.hpp"
#include "model/lattice/planar/creased_motion.hpp"
#include "model/lattice/planar/exact_designs.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/miura.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::model {
namespace {

using ::testing::HasSubstr;

// rad: both sides of flat, near it and far on.
constexpr double thetas[] = {-1.2, -0.5, 0.05, 0.4, 0.9, 1.4};

void expect_closed(const PlanarStructure& s, const char* name, double gap = 1e-12) {
  const ExactMotion motion = exact_motion(s);
  ASSERT_TRUE(motion) << name << ": " << motion.why;
  EXPECT_EQ(motion.name, "creased") << name;
  for (const double theta : thetas) {
    const HingeGaps gaps = hinge_gaps(s, motion.at(theta));
    EXPECT_LE(gaps.max, gap) << name << " at " << theta;
    EXPECT_LE(gaps.axis_max, gap) << name << " at " << theta;
  }
}

TEST(CreasedMotion, FoldsHoneycombsBricksAndOctagons) {
  for (const auto& [name, lattice] : {std::pair("honeycomb", &honeycomb_lattice),
                                      {"bricks", &brick_lattice},
                                      {"octagons", &octagon_lattice}}) {
    const testing::Creased c = testing::creased(lattice_graph(*lattice, 5, 4));
    expect_closed(c.structure, name);
    const ExactMotion motion = exact_motion(c.structure);
    for (const double theta : thetas)
      EXPECT_LE(testing::from_folded(c, motion.at(theta), theta), 1e-12) << name;
  }
}

TEST(CreasedMotion, FoldsRhombiWhoseColumnsAlternate) {
  for (const double angle : {0.9, 1.2, 1.5, 1.9}) {
    expect_closed(testing::creased_rhombi(5, 4, angle), "rhombi");
  }
}

TEST(CreasedMotion, FoldsRandomQuadsWithMirroredWalls) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const PlanarStructure s = testing::creased_quads(6, seed);
    expect_closed(s, "quads");
    EXPECT_EQ(mobility(s, exact_motion(s)).dofs_along, 1);
  }
}

// Vertices of degree four, one in every hexagon.
TEST(CreasedMotion, FoldsAMiuraSheetOfHexagons) {
  for (const double angle : {50.5, 60.0, 67.6}) {
    const PlanarStructure s = testing::miura_of_hexagons(5, 5, angle * radians_per_degree, 0.9);
    expect_closed(s, "Miura");
    const Mobility m = mobility(s, exact_motion(s));
    EXPECT_EQ(m.verdict, Verdict::mobile) << m.why;
    EXPECT_EQ(m.dofs_along, 1);
  }
}

TEST(CreasedMotion, FoldsTwentyByTwentyHexagonsWithOneFreedom) {
  const PlanarStructure s = testing::miura_of_hexagons(20, 20, pi / 3, 0.9);
  expect_closed(s, "Miura", 1e-11);
  EXPECT_EQ(null_space(s, exact_motion(s).at(0.4)).dofs(), 1);
}

/// The angle of two neighbouring zigzag creases' facets, against the closed form of the crease law.
TEST(CreasedMotion, TurnsFacetsByTheMultiplierOfTheirCrease) {
  const PlanarStructure s = testing::miura_of_hexagons(4, 4, pi / 3, 0.9);
  const PlanarCreases creases = find_creases(s);
  const State state = exact_motion(s).at(0.6);
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
    const auto [from, to] = s.graph.edges[h];
    const double cosine = state[from].R.col(2).dot(state[to].R.col(2));
    const double c = creases.of_hinge[h] < 0 ? 0 : creases.list[creases.of_hinge[h]].line.norm();
    EXPECT_NEAR(cosine, std::cos(2 * std::atan(c * std::sin(0.6))), 1e-12);
  }
}

// An angle between the straight creases and the zigzags that does not fit their multipliers.
TEST(CreasedMotion, NamesTheFaceWhereCreasesDoNotMeetInAFlatFoldableVertex) {
  PlanarStructure s = testing::miura_of_hexagons(4, 4, pi / 3, 0.9);
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h)
    if (std::abs(s.graph.along(h).x()) < 1e-9) s.hinges[h].beta *= 1.1;
  const ExactMotion motion = exact_motion(s);
  EXPECT_FALSE(motion);
  EXPECT_THAT(motion.why, HasSubstr("creases meet in the face of vertices"));
  EXPECT_THAT(motion.why, HasSubstr("where no flat-foldable vertex of four creases is"));
}

// Rows bend by a share of a cell that no unit of length changes.
TEST(CreasedMotion, RefusesPlatesOnRowsThatBendInCellsOfAnySize) {
  for (const double edge : {10.0, 1e-3, 1e6}) {
    PlanarStructure s = testing::miura_of_hexagons(4, 4, pi / 3, 0.01);
    s.size = {edge, 0.08 * edge, 0.6 * edge};
    EXPECT_THAT(testing::refusal([&] { exact_motion(s).theta_of(plate_drive(s, Axis::y, 0.1, 1)); }),
                HasSubstr("would keep rows straight that bend"))
        << edge;
  }
}

// The direction of a line is known from a lean of 1e-7 to nine digits only; nor does that open a hinge by more.
TEST(CreasedMotion, FoldsSheetsThatHardlyLean) {
  for (const double multiplier : {1e-4, 1e-7})
    expect_closed(testing::miura_of_hexagons(4, 4, pi / 3, multiplier), "Miura");
}

TEST(CreasedMotion, NamesAHingeThatLeansAlone) {
  PlanarStructure s = make_planar_structure(lattice_graph(honeycomb_lattice, 3, 3), {});
  s.hinges[s.faces[4].edges[0]].beta = 0.3;
  EXPECT_THAT(exact_motion(s).why, HasSubstr("upright hinges join both sides of it"));
}

/// Its hinges moved along their walls, the cells closed again, so that only its crease is crooked.
PlanarStructure crooked(PlanarStructure s, double by, std::mt19937& random) {
  std::uniform_real_distribution<double> moved(-by, by);
  PlanarStructure upright = s;
  for (HingeParameters& hinge : upright.hinges) {
    hinge.t += moved(random);
    hinge.beta = 0;
  }
  PlanarStructure closed = nearest_exact(upright);
  for (std::size_t h = 0; h < closed.hinges.size(); ++h) closed.hinges[h].beta = s.hinges[h].beta;
  return closed;
}

TEST(CreasedMotion, SaysWhetherTheNearestFractionsLieOnTheirWalls) {
  const testing::Creased c = testing::creased(lattice_graph(honeycomb_lattice, 5, 4));
  std::mt19937 random(6);
  int on = 0, off = 0;
  for (int k = 0; k < 40; ++k) {
    const PlanarStructure s = crooked(c.structure, 0.6, random);
    const ExactMotion motion = exact_motion(s);
    if (motion.why.find("does not stay straight") == std::string::npos) continue;
    const PlanarStructure near = nearest_exact(s);
    const bool on_walls = std::all_of(near.hinges.begin(), near.hinges.end(),
                                      [](const HingeParameters& p) { return p.t > 0 && p.t < 1; });
    EXPECT_THAT(motion.why, HasSubstr(on_walls ? "straight differ on" : "straight lie off their walls"));
    ++(on_walls ? on : off);
  }
  EXPECT_GT(on, 0) << "seed 6";
  EXPECT_GT(off, 0) << "seed 6";
}

TEST(CreasedMotion, ProposesTheNearestFractionsThatKeepACreaseStraight) {
  const testing::Creased c = testing::creased(lattice_graph(honeycomb_lattice, 5, 4));
  std::mt19937 random(5);
  const PlanarStructure closed = crooked(c.structure, 0.05, random);
  const ExactMotion motion = exact_motion(closed);
  ASSERT_FALSE(motion);
  EXPECT_THAT(motion.why, HasSubstr("does not stay straight: the hinge on wall"));
  EXPECT_THAT(motion.why, HasSubstr("the nearest t that keep all creases straight"));
  expect_closed(nearest_exact(closed), "straightened");
}

// The smallest change is at right angles to all changes that keep the conditions.
TEST(CreasedMotion, ChangesFractionsByAsLittleAsCanBe) {
  testing::Creased c = testing::creased(lattice_graph(honeycomb_lattice, 4, 4));
  const PlanarStructure exact = c.structure;
  const ExactDesigns designs(exact, straight_lines(exact, find_creases(exact)));
  c.structure.hinges[3].t += 0.04;
  c.structure.hinges[c.hinges[1]].t += 0.03;
  const PlanarStructure near = nearest_exact(c.structure);
  Eigen::VectorXd change(near.hinges.size());
  for (Eigen::Index h = 0; h < change.size(); ++h)
    change[h] = near.senses[near.graph.edges[h].from] * (near.hinges[h].t - c.structure.hinges[h].t);
  EXPECT_GT(change.norm(), 0.01);
  EXPECT_LE(designs.numbers(change).norm(), 1e-12);
}

/// Facets stay flat and as large as the plane's motion has them, and the dihedral angle at every crease is that of its
/// multiplier, by the positions of vertices alone.
void expect_folded_by_its_multipliers(const PlanarStructure& s, double theta) {
  const CreasePattern p = crease_pattern(s, parallel_drawing_of(s).y, theta);
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
  const CreasePattern p = crease_pattern(s, parallel_drawing_of(s).y, 0.5);
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
