#include "tests/regression/prototypes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kinetix::testing {

void PrintTo(const Prototype& prototype, std::ostream* out) { *out << prototype.target; }

/// Returns the file's stem for test names: `helmet_rib` of `helmet_rib.yaml`.
std::string stem(const ::testing::TestParamInfo<Prototype>& info) {
  return fs::path(info.param.target).stem().string();
}

class Prototypes : public ::testing::TestWithParam<Prototype> {};

TEST_P(Prototypes, AreAsGoodAsTheyWere) {
  const Scratch scratch;
  const std::string out = scratch / "out";
  const Outcome run =
      kinetix_opt(KINETIX_SOURCE "/targets/shapes/" + GetParam().target + " --quiet -o " + out);
  const auto result = nlohmann::json::parse(text_of(out + "/result.json"));
  // Displays take hinges to the ends of their walls, where some cannot be printed.
  ASSERT_EQ(run.code, result["verdict"]["printable"] == false ? 3 : 0) << run.out << run.err;
  for (const char* flag : {"met", "agrees", "reaches"}) EXPECT_NE(result["verdict"][flag], false) << run.out;
  const auto& metrics = result["metrics"];
  EXPECT_EQ(metrics.at("met"), true);
  EXPECT_EQ(metrics.at("verified"), true);
  for (const Limit& limit : GetParam().limits) {
    ASSERT_TRUE(limit.at_least || limit.at_most) << limit.metric;
    EXPECT_TRUE(limit.holds(limit.measured)) << limit.metric << ": the limit excludes what was measured";
    const double value = metrics.at(limit.metric).get<double>();
    EXPECT_TRUE(limit.holds(value)) << limit.metric << " is " << value << ", was " << limit.measured;
  }
}

INSTANTIATE_TEST_SUITE_P(Regression, Prototypes, ::testing::ValuesIn(read_prototypes(KINETIX_SOURCE)), stem);

TEST(RegressionLimit, HoldsAtItsEdgeAndNeverForNaN) {
  const Limit most{"error", 1, {}, 2}, least{"quality", 1, 0.5, {}};
  EXPECT_TRUE(most.holds(2));
  EXPECT_FALSE(most.holds(2.1));
  EXPECT_TRUE(least.holds(0.5));
  EXPECT_FALSE(least.holds(0.4));
  EXPECT_FALSE(most.holds(std::nan("")));
  EXPECT_FALSE(least.holds(std::nan("")));
}

}  // namespace kinetix::testing
