#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/sodalite.hpp"
#include "tests/support/sodalite_arms.hpp"

namespace kinetix::model {
namespace {

constexpr CellSize size = {10, 0.4, 1};  // mm: slender walls, which leave arms of a quarter of an edge room

TEST(Sodalite, TwoAndThreeCellsHaveTheRotorsAndGussetsOfTheNet) {
  const SodaliteStructure two = make_sodalite({2, 2, 2}, 0.2, size);
  EXPECT_EQ(two.rotors.size(), 144u);
  EXPECT_EQ(two.gussets.size(), 240u);
  const SodaliteStructure three = make_sodalite({3, 3, 3}, 0.2, size);
  EXPECT_EQ(three.rotors.size() + three.gussets.size(), 1188u);
}

TEST(Sodalite, EveryRingGoesFromBodyToBodyByTheHingeBetweenThem) {
  const Linkage lattice = make_sodalite({2, 1, 1}, 0.2, size);
  ASSERT_FALSE(lattice.cells.empty());
  for (const LinkageCell& ring : lattice.cells)
    for (std::size_t k = 0; k < ring.bodies.size(); ++k) {
      const int from = ring.bodies[k], to = ring.bodies[(k + 1) % ring.bodies.size()];
      const RestHinge& hinge = lattice.hinges[ring.hinges[k]];
      EXPECT_EQ(std::minmax(hinge.lower, hinge.upper), std::minmax(from, to));
    }
}

TEST(Sodalite, NamesBodiesByTheirPlacesInEighthsOfACell) {
  const SodaliteStructure lattice = make_sodalite({1, 1, 1}, 0.2, size);
  const auto name = [&](int body) {
    const Eigen::Vector3d at = sodalite_place(lattice, body) * std::sqrt(8.0);
    std::ostringstream out;
    out << '[' << std::lround(at.x()) << ", " << std::lround(at.y()) << ", " << std::lround(at.z()) << ']';
    return out.str();
  };
  const Linkage linkage = lattice;
  for (int b = 0; b < static_cast<int>(linkage.bodies.size()); ++b)
    EXPECT_EQ(linkage.vertex_name(b), name(b));
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h)
    EXPECT_EQ(linkage.wall_name(h),
              "[" + name(linkage.hinges[h].lower) + ", " + name(linkage.hinges[h].upper) + "]");
}

TEST(Sodalite, EveryHingeClosesOnTheWay) {
  for (const int n : {1, 2, 3})
    for (const double gusset : {0.05, 0.2, 0.5}) {
      const SodaliteStructure lattice = make_sodalite({n, n, n}, gusset, size);
      const ExactMotion exact = exact_motion(lattice);
      ASSERT_TRUE(exact) << exact.why;
      for (const double theta : {-0.6, 0.1, 0.5, 1.0})
        EXPECT_LE(closure_residual(lattice, exact.at(theta)).cwiseAbs().maxCoeff(), 1e-12) << n << gusset;
    }
}

double extent(const SodaliteStructure& lattice, const State& state, int along) {
  double low = 1e9, high = -1e9;
  for (std::size_t r = 0; r < lattice.rotors.size(); ++r) {
    low = std::min(low, state[r].p[along]);
    high = std::max(high, state[r].p[along]);
  }
  return high - low;
}

// Arms shrink as (1 + cos of the rotors' turn) / 2, gussets not at all.
TEST(Sodalite, ItShrinksAlikeInAllDirections) {
  for (const double gusset : {0.02, 0.2, 0.6}) {
    const SodaliteStructure lattice = make_sodalite({2, 2, 2}, gusset, size);
    const State rest = rest_state(lattice);
    for (const double theta : {0.1, 0.4, 0.7}) {
      const State state = exact_motion(lattice).at(theta);
      const double ratio = gusset + (1 - gusset) * (1 + std::cos(2 * theta)) / 2;
      for (const int along : {0, 1, 2})
        EXPECT_NEAR(extent(lattice, state, along) / extent(lattice, rest, along), ratio, 1e-12) << along;
    }
  }
}

// Parallel edges have equal arms, and each direction has its own arm length (kinematics.md section 8).
TEST(Sodalite, MovesExactlyWithSixLengthsOfArms) {
  SodaliteStructure block = testing::block_with_arms({2, 2, 2}, {0.4, 0.5, 0.6, 0.7, 0.8, 0.9}, {10, 0.8, 1});
  const ExactMotion exact = exact_motion(block);
  ASSERT_TRUE(exact) << exact.why;
  for (const double theta : {-0.5, 0.1, 0.7})
    EXPECT_LE(closure_residual(block, exact.at(theta)).cwiseAbs().maxCoeff(), 1e-12);
  block.hinges[0].t += 0.01;
  EXPECT_FALSE(exact_motion(block));
}

TEST(Sodalite, PlatesStayOnFlatLayersAndTheClosedFormKnowsTheirTheta) {
  const SodaliteStructure lattice = make_sodalite({2, 2, 2}, 0.2, size);
  const ExactMotion exact = exact_motion(lattice);
  for (const Axis axis : {Axis::x, Axis::y}) {
    const LinkageDrive drive = plate_drive(lattice, axis, 0.3, 1);
    EXPECT_EQ(drive.gripped[0].size(), 16u);
    const double theta = exact.theta_of(drive);
    EXPECT_NEAR(0.2 + 0.8 * (1 + std::cos(2 * theta)) / 2, 0.7, 1e-9);
    EXPECT_LE(planes_of(drive.gripped, exact.at(theta)).off_plane, 1e-11);
  }
  EXPECT_NEAR(exact.theta_of(drive_to(lattice, 0.5)), 0.5, 1e-9);
}

TEST(Sodalite, AHingeThatIsMovedAloneOpensItsRings) {
  SodaliteStructure lattice = make_sodalite({1, 1, 1}, 0.2, size);
  ASSERT_TRUE(exact_motion(lattice));
  lattice.hinges[5].t += 0.01;
  EXPECT_FALSE(exact_motion(lattice));
}

// Its points would close, and its two bodies carry its axis apart.
TEST(Sodalite, AHingeThatLeansFromItsRotorHasNoClosedForm) {
  for (double HingeParameters::*field : {&HingeParameters::alpha, &HingeParameters::beta}) {
    SodaliteStructure lattice = make_sodalite({1, 1, 1}, 0.2, size);
    lattice.hinges[5].*field += 1e-6;
    const ExactMotion exact = exact_motion(lattice);
    EXPECT_FALSE(exact);
    EXPECT_NE(exact.why.find("has not the axis of its rotor"), std::string::npos) << exact.why;
  }
}

TEST(Sodalite, BadHingesAndSizesAreRefused) {
  EXPECT_THROW(make_sodalite({0, 1, 1}, 0.2, size), InvalidInput);
  EXPECT_THROW(make_sodalite({1, 1, 1}, 0.95, size), InvalidInput);
  EXPECT_THROW(make_sodalite({1, 1, 1}, 0.2, {10, 0, 1}), InvalidInput);
  SodaliteStructure lattice = make_sodalite({1, 1, 1}, 0.2, size);
  lattice.hinges[0].beta = 0.1;
  EXPECT_THROW(validate_hinges(lattice), InvalidInput);
}

void expect_one_freedom(const SodaliteStructure& lattice) {
  const Mobility found = mobility(lattice, exact_motion(lattice));
  EXPECT_EQ(found.verdict, Verdict::mobile) << found.why;
  EXPECT_EQ(found.dofs_along, 1) << found.why;
}

TEST(Sodalite, HasOneFreedomAlongItsMotion) { expect_one_freedom(make_sodalite({2, 2, 2}, 0.2, size)); }

TEST(SodaliteSoak, HasOneFreedomAlongItsMotion) { expect_one_freedom(make_sodalite({3, 3, 3}, 0.2, size)); }

// Rotors have turned by 90 degrees, and walls of neighbours lie side by side. Ends are cut along hinges at 45 degrees: those of
// walls as high as a rotor's arm is long reach the next arm.
TEST(Sodalite, LowWallsPassEachOtherUntilTheRotorsHaveTurnedByNinetyDegrees) {
  for (const double height : {0.5, 1.0, 1.5}) {
    const SodaliteStructure lattice = make_sodalite({2, 2, 2}, 0.2, {10, 0.4, height});
    const ContactRange range = theta_range(lattice, exact_motion(lattice));
    EXPECT_TRUE(range.touching_at_rest.empty());
    EXPECT_GE(range.positive.theta, pi / 4 - 1e-8) << height;
  }
  const SodaliteStructure high = make_sodalite({2, 2, 2}, 0.2, {10, 0.4, 2});
  EXPECT_FALSE(theta_range(high, exact_motion(high)).touching_at_rest.empty());
}

}  // namespace
}  // namespace kinetix::model
