#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stop_token>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_goal.hpp"
#include "app/goals/display/display_panel.hpp"
#include "app/pictures/panel_picture.hpp"
#include "app/pipeline/pipeline.hpp"
#include "targets/display/glyph_goal.hpp"
#include "targets/display/image_goal.hpp"
#include "targets/document/document.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/app/searched_goal.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/paper_scenes.hpp"
#include "tests/support/recogniser.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/images.hpp"

namespace kinetix::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

/// A square ring one cell wide on a small panel: quick to search and to verify.
constexpr const char* ring = R"(kinetix: 1
name: ring
target: {kind: display, rows: ["00000", "01110", "01010", "01110", "00000"]}
solver: {starts: 1, max_evaluations: 50}
)";

TEST(Display, IsSearchedVerifiedAndDrawn) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("ring.yaml", ring) + " -o " + folder);
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("picture in the simulation: "));

  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(false_flags(result), "printable") << run.out;
  EXPECT_EQ(result["target"]["rows"][1], "01110");
  EXPECT_EQ(result["tolerance"],
            (Json{{"stretch", 0.12}, {"auc", 0.97}, {"contrast", 3.0}, {"verify", 0.05}}));
  EXPECT_EQ(result["metrics"]["contrast_rest"], 0);
  EXPECT_EQ(result["metrics"]["auc"], 1);
  EXPECT_GE(result["metrics"]["contrast_physics"], 3);
  EXPECT_LE(result["metrics"]["stretch_max"], 0.12);
  EXPECT_EQ(result["display"]["after"]["cells"].size(), 25u);
  // The first-order estimate starts from the nominal apertures. Scatter can only blur them.
  EXPECT_LE(result["display"]["printed"]["expected"]["contrast"], result["display"]["after"]["contrast"]);
  EXPECT_TRUE(result["display"]["printed"]["confirmed"].is_boolean());
  for (const Json& cell : result["structure"]["cells"]) {
    const int i = cell["cell"][0], j = cell["cell"][1];
    const bool is_ring = std::min({i, j, 4 - i, 4 - j}) == 1;
    EXPECT_EQ(cell["on"], is_ring) << i << " " << j;
    EXPECT_EQ(cell["level"], is_ring ? 1 : 0) << i << " " << j;
  }
  for (const char* picture : {"before", "hinges", "after", "physics"}) {
    EXPECT_THAT(text_of(folder + "/" + picture + ".svg"), HasSubstr("<svg")) << picture;
    EXPECT_THAT(text_of(folder + "/" + picture + ".png"), StartsWith("\x89PNG")) << picture;
  }
  EXPECT_TRUE(std::filesystem::exists(folder + "/frames/00.png"));

  const Outcome again = kinetix_opt("verify " + folder + "/design.yaml -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
}

/// Runs of other kinds, or without the simulation, write to the same folder.
TEST(Display, LeavesNoPicturesOfAnEarlierRun) {
  const Scratch scratch;
  const std::string folder = scratch / "out", display = scratch.write("ring.yaml", ring);
  ASSERT_EQ(kinetix_opt(display + " -o " + folder).code, 3);
  ASSERT_TRUE(fs::exists(folder + "/physics.svg"));
  ASSERT_EQ(kinetix_opt(display + " --no-verify -o " + folder).code, 3);
  EXPECT_EQ(false_flags(Json::parse(text_of(folder + "/result.json"))), "printable");
  EXPECT_FALSE(fs::exists(folder + "/physics.svg"));
  EXPECT_TRUE(fs::exists(folder + "/after.svg"));

  std::ofstream(folder + "/before.svg") << "drawn over by hand";
  std::ofstream(folder + "/frames/own.txt") << "a note";
  const std::string design = scratch.write("panel.yaml", text_of(folder + "/design.yaml"));
  ASSERT_EQ(kinetix_opt("simulate " + design + " --model equilibrium -o " + folder).code, 0);
  std::set<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) left.insert(entry.path().filename());
  EXPECT_EQ(left, (std::set<std::string>{".kinetix-files", "before.svg", "design.yaml", "frames", "own.txt",
                                         "report.html", "result.json"}));
}

/// The picture is not symmetric, but its hinges are tied by the mirror symmetry.
TEST(Display, HingesKeepTheirSymmetryAndTheirDistanceFromCorners) {
  const Scratch scratch;
  const std::string text = R"(kinetix: 1
target: {kind: display, rows: ["000000", "011110", "001100", "001100", "000100", "000000"]}
structure: {cells: [6, 6], cell_mm: 10}
variables: {t: {corner_mm: 2.5, symmetry: mirror_x}}
tolerance: {contrast: 0, auc: 0.51}
solver: {starts: 1, max_evaluations: 60}
)";
  const Outcome run = kinetix_opt(scratch.write("tied.yaml", text) + " --no-verify -o " + scratch.path());
  ASSERT_EQ(run.code, 3) << "its hinges stretch, and the file does not say how they are made" << run.err;
  const Json result = Json::parse(text_of(scratch / "result.json"));
  double least = 1, most = 0;
  for (const auto& hinge : result["structure"]["hinges"]) {
    least = std::min(least, hinge["t"].get<double>());
    most = std::max(most, hinge["t"].get<double>());
    const double x = hinge["point_mm"][0], y = hinge["point_mm"][1];
    const auto is_mirrored = [&](const Json& other) {
      return std::hypot(other["point_mm"][0].get<double>() - (60 - x),
                        other["point_mm"][1].get<double>() - y) < 1e-12;
    };
    EXPECT_TRUE(std::ranges::any_of(result["structure"]["hinges"], is_mirrored)) << x << " " << y;
  }
  EXPECT_GE(least, 0.25);
  EXPECT_LE(most, 0.75);
  EXPECT_GT(most - least, 0.4);
}

TEST(Display, ThatCannotBeShownSaysWhy) {
  const Scratch scratch;
  const std::string text = R"(kinetix: 1
target: {kind: display, rows: ["0000", "0110", "0010", "0000"]}
tolerance: {contrast: 1e6}
solver: {starts: 1, max_evaluations: 3}
)";
  const Outcome run = kinetix_opt(scratch.write("ring.yaml", text) + " --no-verify -o " + scratch.path());
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("at least 1000000.00 is required"));
  EXPECT_THAT(run.out, Not(HasSubstr("a panel of [")));
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_FALSE(result["display"].contains("estimated_cells"));
}

TEST(Display, EstimatesALargerPanelThatShowsThePictureAsAsked) {
  const Scratch scratch;
  const std::string text = R"(kinetix: 1
target: {kind: display, rows: ["110", "101", "011"]}
tolerance: {contrast: 15}
solver: {starts: 1, max_evaluations: 15}
)";
  const auto run_of = [&](const std::string& goal) {
    return kinetix_opt(scratch.write("rhomb.yaml", goal) + " --no-verify -o " + scratch.path());
  };
  const Outcome run = run_of(text);
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["display"]["estimated_cells"], (std::vector{6, 6}));
  EXPECT_THAT(run.out, HasSubstr("estimate: a panel of [6, 6] cells shows it clearly enough"));
  const Outcome larger = run_of(text + "structure: {cells: [6, 6]}\n");
  EXPECT_EQ(false_flags(Json::parse(text_of(scratch / "result.json"))), "printable")
      << larger.out << larger.err;
}

// No limit on the growth of d'^2 with the stroke width.
constexpr double any_growth = std::numeric_limits<double>::infinity();

TEST(PanelEstimate, NamesThePanelWhoseStrokesAreWideEnough) {
  const targets::DisplayGoal bar = targets::rows_goal({"0100", "0100", "0100", "0100"});
  EXPECT_DOUBLE_EQ(app::stroke_width(bar), 1);
  EXPECT_EQ(app::estimate_panel(bar, 3, 3.1, 10), (targets::PanelSize{8, 8}))
      << "rows are shown by multiples";
  EXPECT_EQ(app::estimate_panel(bar, 3, 4.2, 10), (targets::PanelSize{8, 8}));
  EXPECT_EQ(app::estimate_panel(bar, 5, 5.1, 10), (targets::PanelSize{12, 12}))
      << "it may grow by less than it shows";
  EXPECT_EQ(app::estimate_panel(bar, 5, 5.1, any_growth), (targets::PanelSize{8, 8}));
}

TEST(PanelEstimate, IsNothingWhereItsLawDoesNotHold) {
  const targets::DisplayGoal bar = targets::rows_goal({"0100", "0100", "0100", "0100"});
  for (const double contrast : {4.0, 5.0, 0.0, -1.0, std::nan("")})
    EXPECT_EQ(app::estimate_panel(bar, contrast, 4, any_growth), std::nullopt) << contrast;
  EXPECT_EQ(app::estimate_panel(bar, 3, 5, any_growth), std::nullopt) << "strokes would be too wide";
  EXPECT_EQ(app::estimate_panel(targets::make_goal({2, 2}, {0, 0.3, 0.6, 1}), 2, 2.1, any_growth),
            std::nullopt);
}

/// The run and the result of an L on 6 x 6 cells with further keys, without simulation.
struct ShownL {
  Outcome run;
  Json result;
};

ShownL shown_l(const std::string& more) {
  const Scratch scratch;
  const std::string text = R"(kinetix: 1
target: {kind: display, rows: ["000000", "011000", "011000", "011110", "011110", "000000"]}
)";
  const Outcome run = kinetix_opt(scratch.write("l.yaml", text + more) + " --no-verify -o " + scratch.path());
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  return {run, result};
}

// Further than the default: walls touch and hinges give.
const std::string further = "drive: {compression: 0.185}\n";

const std::string rubber_panel = R"(structure: {cell_mm: 15, wall_mm: {thickness: 2, height: 8}}
hinge: {kind: block, material: tango, gap_mm: 2, thickness_mm: 1.2}
)";

// Regression: the exact motion alone led to an estimate of [8, 8] cells, and so on from panel to panel.
TEST(Display, APictureThatOnlyTheExactMotionShowsSaysSo) {
  const auto [run, result] = shown_l(rubber_panel + further);
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("the ideal motion shows the picture (separation d' 5"));
  EXPECT_THAT(run.out, Not(HasSubstr("a panel of [")));
  EXPECT_GE(result["display"]["scaled"]["exact"]["contrast"], 3);
  EXPECT_FALSE(result["display"].contains("estimated_cells"));
}

TEST(Display, LimitsAreKeptByAFiftiethOfTheCompressionIfNeedBe) {
  const auto [run, result] = shown_l(R"(structure: {cell_mm: 20, wall_mm: {thickness: 4, height: 10}}
hinge: {kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4}
tolerance: {strain: 0.025}
)");
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  const Json& display = result["display"];
  EXPECT_LE(display["loads"]["strain"], 0.025);
  EXPECT_LT(display["loads"]["compression"], 0.0185);
  EXPECT_GE(display["loads"]["contrast"], 3);
  EXPECT_GT(display["unlimited"]["strain"], 0.025);
  EXPECT_GE(display["after"]["letter"], 1.01 * display["after"]["rest"].get<double>());
  EXPECT_THAT(run.out, HasSubstr("limit of their material 0.1"));
}

TEST(Display, LimitsThatLeaveNothingToSeeAreNotKeptAndSayHowFarThatWasTried) {
  const auto [run, result] = shown_l(rubber_panel + further + "tolerance: {force_N: 2}\n");
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("at most 2 N is allowed, and less compression, down to 0."));
  EXPECT_THAT(run.out, HasSubstr("but then letter and rest differ by less than 1 %"));
  EXPECT_EQ(result["display"]["loads"]["compression"], 0.185);
  EXPECT_FALSE(result["display"].contains("unlimited"));
}

// Regression: a strained panel needs 60 N, but its file allows 2 N.
TEST(Display, IsStrainedOnPurposeOnlyWithinItsLimits) {
  const Scratch scratch;
  const std::string goal =
      "kinetix: 1\ntarget: {kind: display, glyph: T}\nstructure: {cells: [8, 8]}\n"
      "variables: {stretch_mm: 0.05}\ntolerance: {force_N: 2}\n";
  const Outcome run = kinetix_opt(scratch.write("t.yaml", goal) + " --no-verify -o " + scratch.path());
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_LE(result["metrics"]["force_N"], 2);
  EXPECT_LE(result["display"]["loads"]["force_N"], 2);
  EXPECT_GT(result["display"]["unlimited"]["force_N"], 2);
  EXPECT_EQ(result["display"]["scaled"]["strained"], false);
  EXPECT_THAT(result["optimiser"]["why"].get<std::string>(), HasSubstr("it would exceed its limits"));
}

TEST(Display, StretchIsThatOfTheStateThatIsShown) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(scratch.write("ring.yaml", std::string(ring) + "drive: {press: true}\n") +
                                  " --no-verify -o " + scratch.path());
  ASSERT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
  const Json metrics = Json::parse(text_of(scratch / "result.json"))["metrics"];
  EXPECT_EQ(metrics["stretch_max"], metrics["hinge_gap_max"]) << "the search has plates that grip";
}

// About 580 contacts press. If a solver treats them one after the other, 200 rounds per step are too few, and the run
// takes 640 steps.
TEST(Display, OfThickWallsComesToRestSoon) {
  const Scratch scratch;
  const std::string goal =
      "kinetix: 1\ntarget: {kind: display, glyph: T}\nstructure: {cell_mm: 10, wall_mm: {thickness: 4.5}}\n";
  const Outcome run = kinetix_opt(scratch.write("thick.yaml", goal) + " --quiet -o " + scratch.path());
  EXPECT_EQ(run.code, 3) << run.err;
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(result["physics"]["status"], "settled") << result["physics"]["why"];
  EXPECT_LT(result["physics"]["steps"], 300);
  EXPECT_LE(result["physics"]["comparison"]["rms"], 1e-2);
}

TEST(Display, LightBelowZeroIsNoPicture) {
  const auto [run, result] = shown_l(further + "structure: {cell_mm: 10, wall_mm: {thickness: 4}}\n");
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("cells is below zero: their walls overlap"));
  // Without a correction for the area that walls cover twice at vertices, the mean of both was negative.
  EXPECT_GT(result["display"]["after"]["letter"], 0.1);
}

TEST(Display, ContrastWithoutScatterIsANumber) {
  const Scratch scratch;
  const Outcome run =
      kinetix_opt(scratch.write("two.yaml", "kinetix: 1\ntarget: {kind: display, rows: [\"10\", \"01\"]}\n") +
                  " --no-verify -o " + scratch.path());
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, Not(HasSubstr("inf")));
  EXPECT_GT(Json::parse(text_of(scratch / "result.json"))["metrics"]["contrast"], 100);
}

// Regression: longer steps than those of the reported path gave another largest load.
TEST(DisplayLimits, AreJudgedByTheLoadsThatAreTold) {
  const Scratch scratch;
  const std::string goal = R"(kinetix: 1
target: {kind: display, rows: ["0110", "0110", "0000", "1111"], channel: area}
tolerance: {contrast: 0, auc: 0.51, stretch: 1, force_N: 100000}
solver: {starts: 1, max_evaluations: 30}
structure: {cell_mm: 10}
)";
  const Outcome run = kinetix_opt(scratch.write("t.yaml", goal) + " --no-verify -o " + scratch.path());
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(false_flags(result), "printable") << run.out << run.err;
  EXPECT_DOUBLE_EQ(result["display"]["loads"]["force_N"], result["metrics"]["force_N"]);
  double largest = 0;
  for (const Json& step : result["equilibrium"]["path"])
    largest = std::max(largest, std::abs(step["load"].get<double>()));
  EXPECT_DOUBLE_EQ(result["display"]["loads"]["force_N"], largest);
}

TEST(DisplayLimits, PressLessWhateverTheDrive) {
  app::DisplayFile file;
  file.compression_range = {0.1, 0.2};
  const app::DisplayFile less = app::pressed_by(file, 0.25);
  EXPECT_DOUBLE_EQ(less.compression, 0.25 * file.compression);
  EXPECT_DOUBLE_EQ(less.angle, 0.25 * file.angle);
  EXPECT_FALSE(less.compression_range);
  EXPECT_TRUE(app::pressed_by(file, 1).compression_range);
}

TEST(DisplayLimits, TakeNothingThatIsFoundOnceTheSearchIsStopped) {
  const app::DisplayFile file = app::read_display_file(targets::parse_document(R"(kinetix: 1
target: {kind: display, rows: ["000000", "011000", "011000", "011110", "011110", "000000"]}
tolerance: {force_N: 0.01}
)",
                                                                               "l.yaml"));
  model::Lattice panel = app::make_panel(file, {6, 6});
  int searches = 0;
  const auto search = [&](const app::DisplayFile& asked) {
    ++searches;
    return app::search_panel(asked, panel, app::search_options(asked, {}, {}), {});
  };
  app::DisplayOutcome display;
  display.design = search(file);
  std::stop_source stop;
  stop.request_stop();
  keep_limits(file, {}, display, panel, search, stop.get_token());
  EXPECT_EQ(searches, 1);
  EXPECT_EQ(display.pressed, 1);
  EXPECT_TRUE(display.limits_stopped);
}

// Regression: a run that was stopped during its equilibrium path showed the flat panel, although its search had found a
// design.
TEST(DisplayGoal, ShowsTheStateOfItsSearchWhereThePathIsStopped) {
  const auto of = [](const std::string& extra, const char* stage) {
    std::stop_source stop;
    app::RunOptions options;
    options.verify = false;
    options.stop = stop.get_token();
    options.progress = [&](const std::string& name, double, const std::string&) {
      if (name == stage) stop.request_stop();
    };
    const std::string text =
        "kinetix: 1\ntarget: {kind: display, glyph: L, font: DejaVu Sans Bold}\nstructure: {cells: [8, "
        "8]}\n" +
        extra;
    const auto goal = make_goal(app::read_display_file(targets::parse_document(text, "l.yaml")));
    return *stage ? run_goal(*goal, options) : searched_goal(*goal, options);
  };
  for (const char* extra : {"", "drive: {kind: hinge}\n", "drive: {press: true}\n"}) {
    const app::Run run = of(extra, "equilibrium path"), whole = of(extra, "");
    const auto& display = app::measure_of<app::DisplayMeasure>(run);
    EXPECT_TRUE(run.stopped);
    EXPECT_NEAR(run.theta, whole.theta, 0.05) << extra;
    EXPECT_GT(std::abs(run.theta), 0.2) << extra;
    EXPECT_EQ(run.theta, run.states.front().theta);
    EXPECT_GT(display.reading.score.auc, 0.95) << extra;
  }
}

TEST(PrintedDisplay, IsConfirmedByPrintsThatAreNear) {
  app::PrintedDisplay printed;
  EXPECT_TRUE(printed.is_confirmed());
  printed.first_order_contrast = 20;
  printed.seen.contrast = 15;
  printed.prints = 20;
  EXPECT_TRUE(printed.is_confirmed());
  printed.seen.contrast = 9.6;
  EXPECT_FALSE(printed.is_confirmed());
  printed.seen.contrast = 20;
  printed.failed = 2;
  EXPECT_FALSE(printed.is_confirmed());
}

TEST(Display, NamesThePanelThatKeepsAllStrokes) {
  const Scratch scratch;
  const std::string text = R"(kinetix: 1
target: {kind: display, glyph: B}
structure: {cells: [6, 6]}
solver: {starts: 1, max_evaluations: 3}
)";
  const Outcome run = kinetix_opt(scratch.write("b.yaml", text) + " --no-verify -o " + scratch.path());
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("the smallest panel that shows it whole has [7, 7] cells"));
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(result["display"]["needed_cells"], (std::vector{7, 7}));
}

TEST(Display, RefusesWhatCannotBeAndWritesNothing) {
  const Scratch scratch;
  write_image(scratch / "flat.png", drawn({"....", "...."}));
  write_image(scratch / "damaged.png", drawn({"#...", "...."}));
  std::string damaged = text_of(scratch / "damaged.png");
  damaged[damaged.find("IDAT") + 6] ^= 1;
  scratch.write("damaged.png", damaged);
  write_image(scratch / "grey.png", {{0, 90}, {180, 255}});
  scratch.write("text.png", "no picture\n");
  scratch.write("nine.pgm", "P2\n2 1 9\n0 9\n");
  scratch.write("huge.pgm", "P5\n80000 80000\n255\n");
  const std::vector<std::array<std::string, 2>> cases = {
      {"glyph: \"\"", "is empty. Give a letter or a short word"},
      {"glyph: \" \"", "shows no ink"},
      {"glyph: T, font: DejaVu Sanz", "is not installed"},
      {"glyph: T, font: DejaVu Sanz", "DejaVu Sans"},
      {"image: none.png", "no such file"},
      {"image: text.png", "Give a PNG, JPEG, PBM or PGM file"},
      {"image: damaged.png", "damaged.png: is damaged"},
      {"image: nine.pgm", "largest value is 3, 15, 255 or 65535"},
      {"image: huge.pgm", "80000 x 80000 pixels; at most 64 megapixels"},
      {"image: flat.png", "one value everywhere"},
      {"image: grey.png, levels: grey}\ntolerance: {contrast: 3",
       "tolerance.contrast: only applies to pictures with two levels"},
      {"rows: [\"00\", \"00\"]", "every cell is rest"},
      {"glyph: T}\nstructure: {cells: [1, 1]", "from 2 to 1000"},
      {"glyph: T}\nstructure: {cells: [1000, 1000]", "250000 in all"},
  };
  for (const auto& [target, says] : cases) {
    const std::string file =
        scratch.write("bad.yaml", "kinetix: 1\ntarget: {kind: display, " + target + "}\n");
    const Outcome run = kinetix_opt(file + " -o " + scratch.path() + "/out");
    EXPECT_EQ(run.code, 2) << target;
    EXPECT_THAT(run.err, HasSubstr(says));
    EXPECT_THAT(run.err, HasSubstr("bad.yaml:"));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out")) << target;
  }
}

TEST(PanelMemory, PanelsThatMemoryDoesNotHoldAreRefused) {
  const std::size_t gib = std::size_t{1} << 30;
  EXPECT_NO_THROW(app::check_memory({100, 100}, 2, 4, gib));
  EXPECT_NO_THROW(app::check_memory({300, 50}, 8, 1, gib));
  EXPECT_THAT(refusal([&] {
                app::check_memory({500, 500}, 2, 4, 8 * gib);
              }),
              AllOf(HasSubstr("structure.cells"), HasSubstr("500 x 500 cells needs about 23.3 GiB"),
                    HasSubstr("has 8.0 GiB. Give fewer cells, or --threads 1")));
}

TEST(PanelPicture, IsToScaleAndRefusesBrokenStates) {
  const model::Structure panel = make_structure(model::rectangle(3, 2), {});
  model::State state = rest_state(panel);
  // Half a cell of margin on both sides: 40 mm by 30 mm, in points of 1/72 inch.
  EXPECT_THAT(app::panel_picture(panel, state, {}), HasSubstr("113.38"));
  state[2].p.x() = NAN;
  EXPECT_THROW(app::panel_picture(panel, state, {}), std::runtime_error);
}

/// Reads width and height from the header.
std::array<int, 2> png_size(const std::string& png) {
  const auto number = [&](std::size_t at) {
    int out = 0;
    for (std::size_t k = at; k < at + 4; ++k) out = 256 * out + static_cast<unsigned char>(png[k]);
    return out;
  };
  return {number(16), number(20)};
}

// Regression: pictures of a panel of four metres had 250 million pixels and took a minute.
TEST(PanelPicture, HasFewerPixelsAMillimetreOfLargePanels) {
  const auto size_of = [](double edge_mm, double most) {
    const model::Structure panel =
        make_structure(model::rectangle(3, 2), {edge_mm, edge_mm / 10, edge_mm / 2});
    return png_size(app::panel_picture(panel, rest_state(panel),
                                       {.format = app::PictureFormat::png, .max_pixels = most}));
  };
  EXPECT_THAT(size_of(10, 4000), ::testing::ElementsAre(160, 120));
  EXPECT_THAT(size_of(1000, 400), ::testing::ElementsAre(400, 300));
}

// The hinges differ, but the flat walls do not: the letter is invisible before compression.
TEST(FarView, IsTheSameForEveryFlatPanel) {
  const model::Structure plain = make_structure(model::rectangle(10, 10), {}), letter = letter_panel(0.1);
  const model::State flat = rest_state(plain);
  EXPECT_EQ(app::far_view(letter, flat), app::far_view(plain, flat));
  EXPECT_EQ(app::panel_picture(letter, flat, {.format = app::PictureFormat::png}),
            app::panel_picture(plain, flat, {.format = app::PictureFormat::png}));
}

/// Runs a short search for a letter on 12 x 12 cells, without simulation.
app::Run searched(const std::string& text) {
  app::DisplayFile file;
  file.goal = glyph_goal(text, targets::find_font(targets::default_font), 12, 12);
  file.channel = optim::Channel::area;
  file.solver.starts = 1;
  file.solver.max_evaluations = 40;
  app::RunOptions options;
  options.verify = false;
  return searched_goal(*make_goal(file), options);
}

TEST(FarView, ARecogniserReadsTheLetterAfterCompressionAndNothingBefore) {
  for (const char* text : {"C", "Z"}) {
    const auto run = searched(text);
    EXPECT_EQ(read_capitals(app::far_view(run.design.structure, run.states.front().poses, as_ink)), text);
    EXPECT_EQ(read_capitals(app::far_view(run.design.structure, rest_state(run.design.structure), as_ink)),
              "");
  }
}

/// Computes the luminance of the middle pixel from sRGB.
double middle_luminance(const std::string& png) {
  const TemporaryFolder folder;
  const targets::Picture light =
      targets::read_image(folder.write("light.png", png), targets::ImageLevels::grey, true);
  const double value =
      light.ink[static_cast<std::size_t>(light.height / 2) * light.width + light.width / 2] / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// Regression: light of 0.755 beside light of 0.666 was drawn as white beside black, and inverted.
TEST(FarView, ShowsTrueLuminanceUnlessItIsEnhanced) {
  for (const double thickness : {0.5, 1.0, 2.0}) {
    const model::Structure panel = make_structure(model::rectangle(11, 11), {10, thickness, 6});
    const double open = std::pow(1 - thickness / 10, 2);  // share of a cell's area between its walls
    EXPECT_NEAR(middle_luminance(app::far_view(panel, rest_state(panel), {.blur_in_cells = 1.5})), open, 0.02)
        << thickness;
  }
}

TEST(FarView, IsStretchedAndNegativeWhereThatIsAskedFor) {
  const model::Structure panel = letter_panel(0.1);
  const model::State state = rest_state(panel);
  const std::string usual = app::far_view(panel, state),
                    enhanced = app::far_view(panel, state, {.enhanced = true}),
                    ink = app::far_view(panel, state, as_ink);
  EXPECT_NE(usual, enhanced);
  EXPECT_NE(enhanced, ink);
  EXPECT_GT(middle_luminance(usual), 0.6) << "a flat panel lets most of the light through";
}

TEST(FarView, RefusesBrokenStates) {
  const model::Structure panel = make_structure(model::rectangle(3, 2), {});
  model::State state = rest_state(panel);
  state[0].R(0, 0) = NAN;
  EXPECT_THROW(app::far_view(panel, state), std::runtime_error);
}

}  // namespace
}  // namespace kinetix::testing
