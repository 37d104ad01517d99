#include "model/lattice/sodalite/sodalite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"

namespace kinetix::model {
namespace {

constexpr CellSize size = {10, 0.4, 1};

TEST(Sodalite, TwoAndThreeCellsHaveTheRotorsAndGussetsOfTheNet) {
  const SodaliteStructure two = make_sodalite({2, 2, 2}, 0.2, size);
  EXPECT_EQ(two.rotors.size(), 144u);
  EXPECT_EQ(two.gussets.size(), 240u);
  const SodaliteStructure three = make_sodalite({3, 3, 3}, 0.2, size);
  EXPECT_EQ(three.rotors.size() + three.gussets.size(), 1188u);
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

TEST(Sodalite, ItShrinksAlikeInAllDirectionsByTheSquareOfTheCosine) {
  const SodaliteStructure lattice = make_sodalite({2, 2, 2}, 1e-9 + 0.02, size);
  const Linkage linkage = lattice;
  const State rest = rest_state(linkage), state = exact_motion(lattice).at(0.4);
  for (int d = 0; d < 3; ++d) {
    const auto extent = [&](const State& s) {
      double low = 1e9, high = -1e9;
      for (std::size_t r = 0; r < lattice.rotors.size(); ++r) {
        low = std::min(low, s[r].p[d]);
        high = std::max(high, s[r].p[d]);
      }
      return high - low;
    };
    std::cout << "extent ratio " << extent(state) / extent(rest) << " cos^2 " << std::pow(std::cos(0.4), 2)
              << "\n";
  }
  for (const Axis axis : {Axis::x, Axis::y}) {
    const LinkageDrive drive = plate_drive(lattice, axis, 0, 1);
    std::cout << drive.gripped[0].size() << " off " << planes_of(drive.gripped, state).off_plane << "\n";
  }
}

TEST(Sodalite, HasOneFreedomAlongItsMotion) {
  const SodaliteStructure lattice = make_sodalite({2, 2, 2}, 0.2, size);
  const Mobility found = mobility(lattice, exact_motion(lattice));
  EXPECT_EQ(found.verdict, Verdict::mobile) << found.why;
  EXPECT_EQ(found.dofs_along, 1) << found.why;
}

TEST(Sodalite, PlatesOfWallsOnTheWay) {
  for (const double height : {0.5, 1.0, 2.0}) {
    const SodaliteStructure lattice = make_sodalite({2, 2, 2}, 0.2, {10, 0.4, height});
    const ThetaRange range = theta_range(lattice, exact_motion(lattice));
    std::cout << height << ": " << range.positive.touches << " " << range.positive.theta << " at rest "
              << range.touching_at_rest.size() << "\n";
  }
}

}  // namespace
}  // namespace kinetix::model
