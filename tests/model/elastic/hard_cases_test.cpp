#include <gtest/gtest.h>

#include <cctype>

#include "model/elastic/elastic_system.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/hard/hard_cases.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::model {
namespace {

using namespace testing;

class HardCaseOfTheModel : public ::testing::TestWithParam<HardCase> {};

TEST_P(HardCaseOfTheModel, IsRightOrDiagnosed) {
  const HardAnswer answer = GetParam().solve();
  EXPECT_NE(answer.mark, HardAnswer::Mark::wrong)
      << GetParam().name << "\nasked: " << GetParam().asked << "\nexact: " << answer.exact
      << "\nequilibrium: " << answer.equilibrium;
}

std::vector<HardCase> tested() {
  auto cases = hard_cases();
  std::erase_if(cases, [](const HardCase& c) { return !c.in_tests; });
  return cases;
}

std::string test_name(const ::testing::TestParamInfo<HardCase>& tested) {
  std::string name = tested.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name + "_" + std::to_string(tested.index);
}

INSTANTIATE_TEST_SUITE_P(All, HardCaseOfTheModel, ::testing::ValuesIn(tested()), test_name);

/// A strip that curls between its plates turns its bodies far out of the plane.
TEST(HardCases, WhatPlatesGripStaysOnThem) {
  const Structure s = bending_strip();
  const double theta = 35 * radians_per_degree, L = s.size.edge_mm;
  const EquilibriumPath path =
      trace_equilibrium(driven(s, plates_drive(Axis::y, theta)), {}, without_contact());
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const double side = s.bodies[b].j == 0 ? -1 : 1;
    EXPECT_NEAR(path.state[b].p.y(), L / 2 + side * L / 2 * std::cos(theta), 1e-12 * L);
  }
  for (const int j : {0, 1}) EXPECT_NEAR(path.state[*s.body_at({5, j})].p.z(), 0, 1e-12 * L);
}

}  // namespace
}  // namespace kinetix::model
