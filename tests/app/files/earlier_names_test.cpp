#include <gmock/gmock.h>

#include <fstream>

#include "app/files/design_file.hpp"
#include "app/goals/registry.hpp"
#include "app/sweep/plan/doe_file.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::refusal;
using testing::TemporaryFolder;

const std::string source = KINETIX_SOURCE "/targets/shapes/in.yaml";

Design design(const std::string& text) { return read_design(targets::parse_document(text, source)); }

void read_goal(const std::string& text) { read_target(targets::parse_document(text, source)); }

const std::string sheet = "kinetix: 1\nname: sheet\nstructure: {cells: [2, 1], cell_mm: 20}\n";
const std::string wall = "{wall: [[0, 0], [1, 0]], ";

/// Lines of a design with the current names and with the earlier names, and one with both.
struct Renamed {
  std::string now, before, both;
};

const Renamed designs[] = {
    {"design: {fold_angle_deg: 20}", "design: {theta_deg: 20}",
     "design: {fold_angle_deg: 20, theta_deg: 20}"},
    {"design: {hinges: [" + wall + "hinge_position: 0.4}]}", "design: {hinges: [" + wall + "t: 0.4}]}",
     "design: {hinges: [" + wall + "hinge_position: 0.4, t: 0.4}]}"},
    {"design: {hinges: [" + wall + "tilt_deg: 30}]}", "design: {hinges: [" + wall + "beta_deg: 30}]}",
     "design: {hinges: [" + wall + "tilt_deg: 30, beta_deg: 30}]}"},
    {"drive: {kind: plates, compression: 0.1, push_only: true}",
     "drive: {kind: plates, compression: 0.1, press: true}",
     "drive: {kind: plates, compression: 0.1, push_only: true, press: true}"},
    {"hinge: {kind: pin, diameter_mm: 2, round_caps: true}", "hinge: {kind: pin, diameter_mm: 2, caps: true}",
     "hinge: {kind: pin, diameter_mm: 2, round_caps: true, caps: true}"},
    {"process: {min_wall_mm: 0.4, std_dev: {tilt_deg: 1}}",
     "process: {least_wall_mm: 0.4, sd: {tilt_deg: 1}}",
     "process: {std_dev: {tilt_deg: 1}, sd: {tilt_deg: 1}}"},
    {"process: {base: laser, min_film_mm: 2}", "process: {base: laser, least_film_mm: 2}",
     "process: {base: laser, min_film_mm: 2, least_film_mm: 2}"}};

TEST(EarlierNames, AreReadLikeTheCurrentOnesAndWritten) {
  for (const Renamed& lines : designs) {
    const std::string written = design_text(design(sheet + lines.now + "\n"));
    EXPECT_EQ(design_text(design(sheet + lines.before + "\n")), written) << lines.before;
    EXPECT_EQ(design_text(design(written)), written);
    for (const char* name : {"fold_angle", "hinge_position", "push_only", "round_caps", "min_", "std_dev"})
      EXPECT_THAT(written, Not(HasSubstr(name))) << "kinetix: 1 has the earlier names";
  }
}

TEST(EarlierNames, AreRefusedTogetherWithTheCurrentOnes) {
  for (const Renamed& lines : designs)
    EXPECT_THAT(refusal([&] { design(sheet + lines.both + "\n"); }),
                AllOf(HasSubstr("is the earlier name of `"), HasSubstr("Remove one of the two keys")))
        << lines.both;
}

TEST(EarlierNames, AreNotListedAmongTheAllowedOnes) {
  EXPECT_THAT(refusal([] { design(sheet + "design: {angle: 20}\n"); }),
              HasSubstr("allowed: fold_angle_deg, pattern, hinges"));
  EXPECT_THAT(
      refusal([] { read_goal("kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\ndrive: {kind: usal}\n"); }),
      HasSubstr("allowed: auto, shape_memory"));
}

TEST(EarlierNames, OfTargetsAreRead) {
  const std::string head = "kinetix: 1\ntarget: {kind: ";
  for (const std::string text :
       {"curve, points: helmet_rib.csv}\nvariables: {A: {range_deg: [-30, 30]}, B: {range_deg: [5, 30]}}\n",
        "fold, box: [4, 4, 4]}\nvariables: {A: {range_deg: [-50, 50]}, B: {range_deg: [5, 44]}}\n",
        "space_curve, points: helix.csv}\nvariables: {A: {range_deg: [-50, 50]}, C: {range: [0.2, 0.8]}}\n",
        "outline, points: disc.csv}\nvariables: {B: {range_deg: [20, 40]}, C: {range: [0.3, 0.7]}}\n",
        "surface, shape: cap}\nvariables: {B_deg: 20, A_deg: 60}\n",
        "fold, box: [4, 4, 4]}\ndrive: {kind: D}\n"}) {
    const auto named = [&](const std::array<std::string, 4>& names) {
      std::string out = head + text;
      for (std::size_t k = 0; k < names.size(); ++k)
        for (std::size_t at;
             (at = out.find(std::string(1, static_cast<char>('A' + k)), head.size())) != std::string::npos;)
          out.replace(at, 1, names[k]);
      return out;
    };
    EXPECT_NO_THROW(read_goal(named({"tilt", "fold_angle", "hinge_position", "auto"}))) << text;
    EXPECT_NO_THROW(read_goal(named({"beta", "theta", "t", "usual"}))) << text;
  }
}

TEST(EarlierNames, OfSweepsAreRead) {
  TemporaryFolder folder;
  for (const std::string names : {"model: rigid_body|std_dev", "model: bullet|sd"}) {
    const std::size_t bar = names.find('|');
    const DoeFile doe = read_doe(folder.write(
        "doe.yaml", "kinetix: 1\nbase: x.yaml\nmethod: {kind: sobol}\nresponses: [area_ratio]\n" +
                        names.substr(0, bar) + "\nfactors: [{path: a, normal: {mean: 1, " +
                        names.substr(bar + 1) + ": 2}}]\n"));
    EXPECT_EQ(doe.model, Model::bullet);
    EXPECT_EQ(std::get<optim::NormalSpread>(doe.factors[0].values.distribution).sd, 2);
  }
}

}  // namespace
}  // namespace kinetix::app
