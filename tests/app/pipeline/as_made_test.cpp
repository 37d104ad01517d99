#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* arc = R"(kinetix: 1
name: arc
target: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}
structure: {cells: [12, 1]}
)";

struct Printed {
  Json result;
  std::string out;
};

Printed printed(const Scratch& scratch, const std::string& process) {
  const std::string folder = scratch / "out";
  const Outcome run =
      kinetix_opt(scratch.write("arc.yaml", arc + process) + " -o " + folder + " --no-verify");
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  return {Json::parse(text_of(folder + "/result.json")), run.out};
}

TEST(AsMadeResult, SaysWhatPrintsComeTo) {
  const Scratch scratch;
  const Printed usual = printed(scratch, "");
  EXPECT_EQ(schema_errors(usual.result), "");
  const Json& made = usual.result["as_made"];
  EXPECT_EQ(made["process"], "polyjet");
  EXPECT_THAT(usual.out, HasSubstr("printed by polyjet"));
  EXPECT_EQ(usual.result["metrics"]["as_made_rms_mm"], made["rms_mm"]);
  EXPECT_GT(made["rms_mm"], made["designed_mm"]);
  EXPECT_GT(made["p95_mm"], made["rms_mm"]);
  EXPECT_EQ(made["holds"], made["p95_mm"].get<double>() <= made["tolerance_mm"].get<double>());
  EXPECT_EQ(made["sources"].size(), 10u);
}

TEST(AsMadeResult, IsConfirmedByPrints) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run =
      kinetix_opt(scratch.write("arc.yaml", arc) + " -o " + folder + " --no-verify --monte-carlo 500");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("500 prints in the elastic model"));
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  const Json& made = result["as_made"];
  EXPECT_EQ(made["prints"]["failed"], 0);
  EXPECT_NEAR(made["prints"]["rms_mm"], made["rms_mm"].get<double>(), 0.1 * made["rms_mm"].get<double>());
  EXPECT_NEAR(made["prints"]["p95_mm"], made["p95_mm"].get<double>(), 0.1 * made["p95_mm"].get<double>());
}

// To first order what errors add grows with their square.
TEST(AsMadeResult, GrowsWithTheErrorsOfTheProcess) {
  const Scratch scratch;
  const auto added = [](const Json& made) {
    const double rms = made["rms_mm"], designed = made["designed_mm"];
    return rms * rms - designed * designed;
  };
  const Json one = printed(scratch, "process: {base: fdm, sd: {t_mm: 0.05, tilt_deg: 0.25}}\n")
                       .result["as_made"],
             two =
                 printed(scratch, "process: {base: fdm, sd: {t_mm: 0.1, tilt_deg: 0.5}}\n").result["as_made"];
  EXPECT_EQ(one["process"], "fdm");
  EXPECT_NEAR(added(two), 4 * added(one), 1e-6 * added(two));
  const Printed rough = printed(scratch, "process: {sd: {tilt_deg: 20}}\n");
  EXPECT_EQ(rough.result["as_made"]["holds"], false);
  EXPECT_THAT(rough.out, HasSubstr("NOT EVERY PRINT HOLDS"));
}

TEST(AsMadeResult, RefusesProcessesThatNobodyHas) {
  const Scratch scratch;
  const auto refused = [&](const std::string& process) {
    const Outcome run = kinetix_opt("check " + scratch.write("arc.yaml", arc + process));
    EXPECT_EQ(run.code, 2) << process;
    return run.err;
  };
  EXPECT_THAT(refused("process: polijet\n"),
              HasSubstr("arc.yaml:5:10: process: `polijet` is not known (did you mean `polyjet`?)"));
  EXPECT_THAT(refused("process: {sd: {t_mm: -1}}\n"), HasSubstr("process.sd.t_mm"));
  EXPECT_THAT(refused("process: {sd: {tilt_deg: .nan}}\n"), HasSubstr("process.sd.tilt_deg"));
  EXPECT_THAT(refused("process: {nozzle: 1}\n"), HasSubstr("process.nozzle"));
}

}  // namespace
}  // namespace kinetix::testing
