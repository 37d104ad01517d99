#include <gtest/gtest.h>

#include "model/lattice/square/structure.hpp"
#include "optim/elastic/tilt_ties.hpp"

namespace kinetix::optim {
namespace {

model::Structure strip() {
  model::Structure s = make_structure(model::rectangle(5, 2), {10, 0.8, 6});
  for (model::Hinge& hinge : s.hinges)
    if (hinge.wall.axis == model::Axis::x && hinge.wall.from.i != 2)
      hinge.parameters.beta = (starts_in_sublattice_b(hinge.wall) ? -0.1 : 0.1) * (1 + hinge.wall.from.i);
  return s;
}

TEST(TiltTies, AreTheColumnsOfAStrip) {
  const std::vector<TiltTie> ties = tilt_ties(strip());
  ASSERT_EQ(ties.size(), 4u) << "the upright column has no tilt";
  for (const TiltTie& tie : ties) {
    EXPECT_EQ(tie.hinges.size(), 3u);
    for (const int h : tie.hinges) EXPECT_NEAR(std::abs(strip().hinges[h].parameters.beta), tie.tilt, 1e-15);
  }
}

TEST(TiltTies, KeepWhatTheyAreGiven) {
  const model::Lattice sheet = strip();
  const std::vector<TiltTie> ties = tilt_ties(sheet);
  std::vector<double> tilts;
  for (const TiltTie& tie : ties) tilts.push_back(tie.tilt);
  const model::Lattice same = with_tilts(sheet, ties, tilts);
  for (int h = 0; h < sheet.hinges(); ++h) EXPECT_EQ(same.hinge(h).beta, sheet.hinge(h).beta);
  tilts[1] = 0.7;
  const model::Lattice other = with_tilts(sheet, ties, tilts);
  for (std::size_t k = 0; k < ties[1].hinges.size(); ++k)
    EXPECT_EQ(other.hinge(ties[1].hinges[k]).beta, 0.7 * ties[1].signs[k]);
}

}  // namespace
}  // namespace kinetix::optim
