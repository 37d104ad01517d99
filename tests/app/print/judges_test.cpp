#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "app/print/fit.hpp"
#include "app/print/format/print_format.hpp"
#include "model/closure/closure.hpp"
#include "model/linkage/state.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/print/gltf_judge.hpp"
#include "tests/app/print/mujoco_judge.hpp"
#include "tests/app/print/slices.hpp"
#include "tests/app/print/step_judge.hpp"
#include "tests/app/print/threemf_judge.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

double number_after(const std::string& text, const std::string& pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern + R"(\s*([-+0-9.eE]+))"))) return NAN;
  return std::stod(match[1]);
}

/// A design without a target, small enough for quick checks. Its hinges lean to both sides.
constexpr const char* leaning_panel = R"(kinetix: 1
name: leaning
structure: {cells: [2, 2], cell_mm: 16, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 12, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 20}, {wall: [[0, 1], [1, 1]], beta_deg: -20},
  {wall: [[0, 2], [1, 2]], beta_deg: 20}]}
)";

/// A rib of few columns that folds to half an ellipse.
constexpr const char* arch = R"(kinetix: 1
name: arch
target: {kind: curve, points: half_ellipse.csv}
structure: {cells: [8, 1], cell_mm: 12, wall_mm: {thickness: 0.8, height: 6}}
variables: {beta: {range_deg: [-60, 60], per: column, symmetry: none}, theta: {range_deg: [2, 40]}}
)";

constexpr const char* small_cube = R"(kinetix: 1
name: small_cube
target: {kind: fold, box: [1, 1, 1]}
structure: {cell_mm: 10, wall_mm: {thickness: 0.8, height: 6}}
)";

std::string half_ellipse() {
  std::string csv = "x,z\n";
  for (int k = 0; k <= 32; ++k)
    csv += fmt::format("{},{}\n", -28 * std::cos(k * M_PI / 32), 22 * std::sin(k * M_PI / 32));
  return csv;
}

/// Returns the folder with the result of a small or a shipped target, which is searched once.
std::string found(const std::string& target) {
  static const Scratch scratch;
  static std::map<std::string, std::string> folders;
  const auto [known, is_new] = folders.try_emplace(target, scratch / target);
  if (!is_new) return known->second;
  if (target == "leaning") {
    fs::create_directories(known->second);
    scratch.write(target + "/design.yaml", leaning_panel);
    return known->second;
  }
  scratch.write("half_ellipse.csv", half_ellipse());
  const std::string file = target == "arch"         ? scratch.write("arch.yaml", arch)
                           : target == "small_cube" ? scratch.write("small_cube.yaml", small_cube)
                                                    : KINETIX_SOURCE "/targets/shapes/" + target + ".yaml";
  const Outcome run = kinetix_opt(file + " --lock none --no-verify --quiet -o " + known->second);
  EXPECT_EQ(run.code, 0) << run.err;
  return known->second;
}

/// The export of a target's result or of the leaning panel.
struct Exported {
  std::string target, hinge, process;
  Scratch scratch;
  app::PreparedPrint print;

  Exported(const std::string& target_, const std::string& hinge_, const std::string& process_,
           const std::string& formats)
      : target(target_), hinge(hinge_), process(process_) {
    const Outcome run = kinetix_opt("export " + found(target) + " --format " + formats + " --process " +
                                    process + " --hinge " + hinge + " -o " + std::string(scratch / "out"));
    EXPECT_EQ(run.code, 0) << run.err;
    app::Design design = app::read_design(found(target) + "/design.yaml");
    design.hinge.made.reset();  // as --hinge does
    print = app::prepared(design, *model::find_process(process),
                          {.kind = hinge == "pin"    ? model::HingeKind::pin
                                   : hinge == "film" ? model::HingeKind::film
                                                     : model::HingeKind::block},
                          false);
  }

  std::string file(const std::string& name) const { return scratch / ("out/" + name); }
  std::string of(const std::string& ending) const { return file(target + ending); }
  Json json() const { return Json::parse(text_of(file("print.json"))); }
  int bodies() const { return json()["bodies"]; }
  int blocks() const { return hinge == "pin" ? 0 : static_cast<int>(json()["hinges"]); }
};

const Exported& pinned() {
  static const Exported rib("arch", "pin", "polyjet", "all");
  return rib;
}
const Exported& blocked() {
  static const Exported rib("arch", "block", "polyjet", "all");
  return rib;
}
const Exported& filmed() {
  static const Exported panel("leaning", "film", "polyjet", "all");
  return panel;
}
const Exported& pinned_cube() {
  static const Exported cube("small_cube", "pin", "sla", "stl,3mf,dxf,svg,mjcf");  // STEP takes long
  return cube;
}
const Exported& pinned_helmet() {
  static const Exported rib("helmet_rib", "pin", "polyjet", "all");
  return rib;
}
const Exported& blocked_helmet() {
  static const Exported rib("helmet_rib", "block", "polyjet", "all");
  return rib;
}
const Exported& pinned_shipped_cube() {
  static const Exported cube("cube", "pin", "sla", "stl,3mf,dxf,svg,mjcf");  // STEP alone takes 15 s
  return cube;
}

class Judges : public ::testing::TestWithParam<const Exported& (*)()> {
 protected:
  const Exported& given() const { return GetParam()(); }
};

TEST_P(Judges, TheSchemaAllowsWhatIsSaidOfThePrint) { EXPECT_EQ(schema_errors(given().json(), "print"), ""); }

TEST_P(Judges, AdmeshFindsNothingToRepair) {
  for (const char* name : {"all.stl", "hard.stl", "soft.stl"}) {
    if (!fs::exists(given().file(name))) continue;
    const std::string said = command_output("admesh " + given().file(name));
    for (const char* what : {"Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
                             "Facets reversed", "Backwards edges", "Normals fixed"})
      EXPECT_EQ(number_after(said, std::string(what) + R"(\s*:)"), 0) << name << ": " << what << "\n" << said;
    // All facets have three neighbours in the file itself, before admesh repairs it.
    std::smatch columns;
    ASSERT_TRUE(
        std::regex_search(said, columns, std::regex(R"(Facets with 3 disconnected edges\s*:\s*(\d+))")))
        << said;
    EXPECT_EQ(columns[1], "0");
    EXPECT_EQ(number_after(said, R"(Total disconnected facets\s*:)"), 0) << said;
    const std::string file = name;
    const int parts =
        (file == "soft.stl" ? 0 : given().bodies()) + (file == "hard.stl" ? 0 : given().blocks());
    EXPECT_EQ(number_after(said, R"(Number of parts\s*:)"), parts) << name;
  }
}

TEST_P(Judges, CgalFindsNoTwoFacesThatCross) {
  for (const char* name : {"hard.stl", "soft.stl"}) {
    if (!fs::exists(given().file(name))) continue;
    const std::string said = command_output(std::string(KINETIX_SELF_CROSSING) + " " + given().file(name));
    EXPECT_THAT(said, HasSubstr("manifold 1\nclosed 1\ncrossing 0")) << name;
  }
}

TEST_P(Judges, PrusaSlicerSeesEveryBodyAndTheirVolume) {
  const std::string said = command_output("prusa-slicer --info " + given().of(".3mf"));
  EXPECT_THAT(said, HasSubstr("manifold = yes"));
  EXPECT_EQ(number_after(said, "number_of_parts ="), given().bodies() + given().blocks());
  const Json volume = given().json()["volume_mm3"];
  const double own = double(volume["hard"]) + double(volume["soft"]);
  EXPECT_NEAR(number_after(said, "volume =") / own, 1, 1e-4) << "PrusaSlicer counts in floats";
}

TEST_P(Judges, Lib3mfReadsOneManifoldObjectWithoutWarning) {
  const ThreemfVerdict verdict = read_threemf(given().of(".3mf"));
  EXPECT_TRUE(verdict.is_read);
  EXPECT_EQ(verdict.warnings, 0);
  EXPECT_EQ(verdict.objects, 1);
  EXPECT_TRUE(verdict.manifold);
  EXPECT_GE(verdict.triangles, 12 * given().bodies());
}

/// The shares of hard and soft filament, one extruder each, follow from their volumes.
TEST(Extruders, GetFilamentInTheRatioOfTheVolumes) {
  const Exported panel("leaning", "block", "polyjet", "3mf");
  const Json volume = panel.json()["volume_mm3"];
  const double asked = double(volume["hard"]) / double(volume["soft"]);
  EXPECT_NEAR(filament_ratio(panel.scratch.path(), panel.of(".3mf")) / asked, 1, 0.1);
}

/// Returns poses by object name from the output of blender_judge.py, in mm.
std::map<std::string, model::Pose> poses_in(const std::string& said) {
  std::map<std::string, model::Pose> poses;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("pose ")) continue;
    const std::size_t end = line.find(" | ");
    std::istringstream numbers(line.substr(end + 3));
    model::Pose pose;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) numbers >> pose.R(row, column);
      numbers >> pose.p[row];
    }
    pose.R *= 1e3;  // metres of a mesh in mm
    pose.p *= 1e3;
    poses[line.substr(5, end - 5)] = pose;
  }
  return poses;
}

/// Tests of exports in all formats.
class AllFormats : public Judges {};

TEST_P(AllFormats, AssimpFindsEveryBodyAndItsMotion) {
  const GltfVerdict verdict = read_gltf(given().of(".glb"));
  EXPECT_EQ(verdict.error, "");
  EXPECT_EQ(verdict.nodes_with_meshes, given().bodies() + (given().blocks() > 0)) << "blocks are one mesh";
  EXPECT_GE(verdict.meshes, given().bodies());
  EXPECT_EQ(verdict.animations, 1);
  EXPECT_GE(verdict.moved_nodes, given().bodies() - 1);
  EXPECT_GT(verdict.seconds, 0.5);
}

TEST_P(AllFormats, BlenderOpensEveryBodyAndMovesAllButOne) {
  const std::string said = command_output("blender -b --factory-startup --python " KINETIX_SOURCE
                                          "/tests/app/print/blender_judge.py -- " +
                                          given().of(".glb"));
  EXPECT_EQ(number_after(said, "objects"), given().bodies() + (given().blocks() > 0)) << said;
  EXPECT_GE(number_after(said, "moved"), given().bodies() - 1) << said;
  EXPECT_EQ(number_after(said, "materials"), given().blocks() > 0 ? 2 : 1) << said;
  EXPECT_GT(number_after(said, "last"), 12) << "half a second at 24 frames a second";
  const app::PrintSheet& sheet = given().print.job.sheet;
  const std::map<std::string, model::Pose> poses = poses_in(said);
  for (std::size_t b = 0; b < sheet.bodies.size(); ++b) {
    if (sheet.meshes[b].points.empty()) continue;
    const std::string name = "body " + sheet.linkage.vertex_name(static_cast<int>(b));
    ASSERT_TRUE(poses.contains(name)) << name << "\n" << said;
    const model::Pose &pose = poses.at(name), &folded = sheet.path.back()[b];
    EXPECT_LE((pose.p - folded.p).norm(), 0.01) << name << ", mm, in floats of metres";
  }
}

TEST_P(AllFormats, FindsAsManyValidSolidsAsThereAreParts) {
  StepVerdict step = read_step(given().of(".step"));
  EXPECT_TRUE(step.valid);
  EXPECT_EQ(step.solids, given().bodies() + given().blocks());
  EXPECT_EQ(step.shells, step.solids);
  EXPECT_EQ(step.open_shells, 0);
  EXPECT_EQ(step.names["body"], given().bodies());
  EXPECT_EQ(step.names["hinge"], given().blocks());
  EXPECT_EQ(step.colours["#D8D8D2"], given().bodies()) << "hard, as in the 3MF file";
  EXPECT_EQ(step.colours["#2E6FB7"], given().blocks()) << "soft";
  // Computes the volume of the same solids with polygons fine enough to replace the circles.
  const app::PrintSheet& sheet = given().print.job.sheet;
  std::vector<model::HingePrint> fine = sheet.hinges;
  for (model::HingePrint& hinge : fine) hinge.tolerance_mm = 1e-5;
  double own = 0;
  for (const model::BodySolid& body :
       body_solids(sheet.linkage, [&](int h) -> const model::HingePrint& { return fine[h]; }))
    own += volume_mm3(body_mesh(body));
  for (const model::Polyhedron& block : sheet.soft)
    if (!block.points.empty()) own += volume_mm3(block);
  EXPECT_NEAR(step.volume_mm3 / own, 1, 1e-4);
}

TEST_P(Judges, MujocoFoldsItToTheExactShape) {
  const MujocoVerdict verdict = fold_in_mujoco(text_of(given().of(".xml")), 1, 1.2);
  EXPECT_EQ(verdict.error, "");
  const Json volume = given().json()["volume_mm3"];
  const double own = 1.2e-6 * (double(volume["hard"]) + double(volume["soft"]));  // kg, of 1200 kg/m^3
  EXPECT_NEAR(verdict.mass_kg / own, 1, 1e-6);
  const app::PrintSheet& sheet = given().print.job.sheet;
  model::State settled = sheet.path.back();
  ASSERT_EQ(verdict.positions.size(), settled.size());
  for (std::size_t b = 0; b < settled.size(); ++b) settled[b].p = 1e3 * verdict.positions[b];
  EXPECT_LE(aligned_distance(sheet.linkage, settled, sheet.path.back()).max, 0.05);
  double energy_Nmm = 0;
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h)
    if (sheet.hinges[h].made.kind != model::HingeKind::pin)
      energy_Nmm += model::stiffness(sheet.hinges[h].made).turn *
                    std::pow(hinge_turn(sheet.linkage, sheet.path.back(), h), 2) / 2;
  EXPECT_NEAR(1e3 * verdict.energy_J, energy_Nmm, 0.02 * energy_Nmm) << "hinges of loops count as well";
}

TEST_P(Judges, EzdxfAndRsvgReadTheDrawings) {
  const std::string said = command_output(
      "/usr/bin/python3 -c \"import ezdxf; d = ezdxf.readfile('" + given().of(".dxf") +
      "'); print('errors', len(d.audit().errors), 'unit', d.header['\\$INSUNITS'], 'numbers', "
      "len(d.modelspace().query('TEXT')), 'open', sum(not p.is_closed for p in "
      "d.modelspace().query('POLYLINE')), 'outlines', len(d.modelspace().query('POLYLINE')))\"");
  const int parts = given().bodies() + given().blocks();
  EXPECT_THAT(said, HasSubstr("errors 0 unit 4 numbers " + std::to_string(int(given().json()["hinges"])) +
                              " open 0"));
  EXPECT_GE(number_after(said, "outlines"), parts);
  const std::string png = given().scratch / "drawing.png";
  command_output("rsvg-convert " + given().of(".svg") + " -o " + png);
  EXPECT_GT(fs::file_size(png), 1000U);
}

std::string name_of(const ::testing::TestParamInfo<const Exported& (*)()>& run) {
  return run.param == &pinned           ? "PinnedRib"
         : run.param == &blocked        ? "BlockedRib"
         : run.param == &filmed         ? "FilmedPanel"
         : run.param == &pinned_cube    ? "PinnedCube"
         : run.param == &pinned_helmet  ? "PinnedHelmetRib"
         : run.param == &blocked_helmet ? "BlockedHelmetRib"
                                        : "PinnedShippedCube";
}
INSTANTIATE_TEST_SUITE_P(Of, Judges, ::testing::Values(pinned, blocked, pinned_cube, filmed), name_of);
INSTANTIATE_TEST_SUITE_P(Of, AllFormats, ::testing::Values(pinned, blocked, filmed), name_of);
INSTANTIATE_TEST_SUITE_P(Soak, Judges, ::testing::Values(pinned_helmet, blocked_helmet, pinned_shipped_cube),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Soak, AllFormats, ::testing::Values(pinned_helmet, blocked_helmet), name_of);

/// Slices a file next to its print.json, on a bed a little larger than the print.
/// @return the path of the slices
std::string sliced_close(const Scratch& scratch, const fs::path& folder, const char* name,
                         SlicingOf how = {}) {
  const Json bounds = Json::parse(text_of(folder / "print.json"))["bounds_mm"];
  const auto mm = [&](int k) { return static_cast<int>(std::ceil(double(bounds[k]))) + 4; };
  how.width = mm(0);
  how.height = mm(1);
  return sliced(scratch.path(), folder / name, how);
}

/// Checks the number of bodies in the slices.
/// @param structure cells and sizes
void expect_bodies_in_slices(const std::string& structure, const std::string& process, int bodies) {
  const Scratch scratch;
  const std::string design =
      scratch.write("panel.yaml", "kinetix: 1\nstructure: " + structure + "\ndesign: {theta_deg: 15}\n");
  const Outcome run = kinetix_opt("export " + design + " --format stl --process " + process + " -o " +
                                  std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string slices = sliced_close(scratch, scratch / "out", "hard.stl");
  const auto [printed, swollen] = printed_and_swollen_pieces(slices, 1);
  EXPECT_EQ(printed, bodies);
  EXPECT_EQ(swollen, bodies) << "swollen by 0.05 mm a side";
}

TEST(Slices, OfPinsFallIntoTheBodiesAndStillDoWhenSwollen) {
  expect_bodies_in_slices("{cells: [2, 2], cell_mm: 10}", "sla", 9);
  expect_bodies_in_slices("{cells: [2, 2], cell_mm: 16}", "fdm", 9);
}

TEST(SlicesSoak, OfPinsFallIntoTheBodiesAndStillDoWhenSwollen) {
  expect_bodies_in_slices("{cells: [5, 4], cell_mm: 10}", "sla", 30);
  expect_bodies_in_slices("{cells: [4, 3], cell_mm: 16}", "fdm", 20);
}

/// The slicer's default radius would close gaps of 0.05 mm. The 3MF file contains a smaller radius. Layers are thinner
/// than the axial clearance, 0.05 mm, and pixels are smaller than half of a gap.
TEST(Slices, OfSmallClearancesStayApartBecauseTheFileSaysSo) {
  const Scratch scratch;
  const std::string design = scratch.write(
      "panel.yaml",
      "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 10, wall_mm: {thickness: 0.8, height: 3}}\n"
      "design: {theta_deg: 15}\n");
  const Outcome run = kinetix_opt("export " + design + " --format stl,3mf --process polyjet --hinge pin -o " +
                                  std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const SlicingOf fine{.width = 16, .height = 16, .pixels = 50, .layer_mm = 0.04};
  EXPECT_LT(printed_pieces(sliced(scratch.path(), scratch / "out/hard.stl", fine)), 4) << "a file without";
  EXPECT_EQ(printed_pieces(sliced(scratch.path(), scratch / "out/panel.3mf", fine)), 4);
}

/// Covers rods in their bores, and single tiles.
TEST(Slices, OfLooseRodsAreBodiesAndRods) {
  const Scratch scratch;
  const std::string design = scratch.write(
      "panel.yaml", "kinetix: 1\nstructure: {cells: [3, 2], cell_mm: 16}\ndesign: {theta_deg: 15}\n");
  const Outcome run =
      kinetix_opt("export " + design + " --format stl,step --process fdm --hinge pin --bed 30,30 -o " +
                  std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(text_of(scratch / "out/print.json"));
  ASSERT_EQ(json["tiles"], Json::array({2, 2}));
  const int rods = json["loose_rods"];
  EXPECT_EQ(rods, 3 + 4) << "hinges across the lines between tiles";
  const StepVerdict step = read_step(scratch / "out/panel.step");
  EXPECT_TRUE(step.valid);
  EXPECT_EQ(step.solids, 12 + rods);
  const SlicingOf how{.width = 34, .height = 34, .layer_mm = 0.2};
  int pieces = 0;
  for (int tile = 1; tile <= 4; ++tile)
    pieces += printed_pieces(sliced(scratch.path(), scratch / fmt::format("out/tile_{}.stl", tile), how));
  EXPECT_EQ(pieces, 12);
  EXPECT_EQ(printed_pieces(sliced(scratch.path(), scratch / "out/rods.stl", how)), rods);
  for (const char* name : {"tile_1.stl", "rods.stl", "hard.stl"}) {
    const std::string said = command_output("admesh " + std::string(scratch / "out") + "/" + name);
    EXPECT_THAT(said, HasSubstr("Facets with 3 disconnected edges :     0")) << name << said;
    EXPECT_EQ(number_after(said, R"(Normals fixed\s*:)"), 0) << name;
  }
}

TEST(Slices, OfACouponFuseWhereTheGapIsNarrow) {
  const Scratch scratch;
  const Outcome run =
      kinetix_opt("export --coupon --format stl --process sla -o " + std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string slices = sliced_close(scratch, scratch / "out", "hard.stl");
  const auto [printed, swollen] = printed_and_swollen_pieces(slices, 2);
  EXPECT_EQ(printed, 36) << "the slicer closes gaps of less than 0.098 mm";
  // All parts are swollen by 0.1 mm per side. Gaps of 0.1 mm fuse in all three rows. A gap stays open if it exceeds
  // both sides, a pixel and the step of a 0.1 mm layer on the slope together. These limits are 0.25 mm upright, 0.31 mm
  // at 30 degrees and 0.42 mm at 60 degrees.
  EXPECT_LE(swollen, 36 - 3);
  EXPECT_GE(swollen, 36 - (2 + 3 + 4));
}

/// The slicer closes exactly the gaps narrower than twice its radius, for any tilt of the pins.
TEST(Coupon, FallsFromTwoPiecesAHingeToOneWhereTheSlicerClosesItsGap) {
  const Scratch scratch;
  const Outcome run =
      kinetix_opt("export --coupon --format stl --process sla -o " + std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  for (const auto& [radius_mm, fused_gaps] : {std::pair{0.08, 1}, {0.13, 2}, {0.23, 4}})
    EXPECT_EQ(printed_pieces(sliced_close(scratch, scratch / "out", "hard.stl",
                                          {.closing_mm = radius_mm, .pixels = 10, .layer_mm = 0.2})),
              36 - 3 * fused_gaps)
        << "gaps of less than " << 2 * radius_mm << " mm, at 0, 30 and 60 degrees";
}

/// A block among pins is not a joint of the tree. The pins resist in its place.
TEST(Mujoco, CountsABlockThatIsInALoopAlone) {
  const Scratch scratch;
  const std::string design = scratch.write("panel.yaml", R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 12, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 20, hinges: [{wall: [[0, 0], [0, 1]], hinge: {kind: block, material: tango, gap_mm: 1.6}}]}
hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}
)");
  const std::string out = scratch / "out";
  ASSERT_EQ(kinetix_opt("export " + design + " --format mjcf -o " + out).code, 0);
  model::ManufacturedHinge block;
  block.kind = model::HingeKind::block;
  block.material = *model::find_material("tango");
  block.gap_mm = 1.6;
  block.thickness_mm = 0.8;
  block.height_mm = 6;
  const MujocoVerdict verdict = fold_in_mujoco(text_of(out + "/panel.xml"), 1, 1.2);
  EXPECT_EQ(verdict.error, "");
  const double turn = 40 * M_PI / 180, energy_Nmm = model::stiffness(block).turn * turn * turn / 2;
  EXPECT_NEAR(1e3 * verdict.energy_J, energy_Nmm, 0.02 * energy_Nmm);
}

/// Films lean among pins. The actuator's force balances the resistance of every joint.
TEST(Mujoco, FoldsPinsBesideFilmsToTheExactShape) {
  std::string hinges;
  for (const auto& [column, lean] : {std::pair{2, 15}, {3, -12}})
    for (const int row : {0, 1})
      hinges += fmt::format(
          "    - {{wall: [[{0}, {1}], [{2}, {1}]], beta_deg: {3}, hinge: {{kind: film, material: pp, gap_mm: "
          "3, "
          "thickness_mm: 0.4}}}}\n",
          column, row, column + 1, row == 0 ? lean : -lean);
  const Scratch scratch;
  const std::string design =
      scratch.write("strip.yaml",
                    "kinetix: 1\nstructure: {cells: [6, 1], cell_mm: 22, wall_mm: {thickness: 1, height: "
                    "6}}\ndesign:\n  theta_deg: 25\n  hinges:\n" +
                        hinges + "hinge: {kind: pin, diameter_mm: 1.5, clearance_mm: 0.25}\n");
  const std::string out = scratch / "out";
  ASSERT_EQ(kinetix_opt("export " + design + " --process sla --format mjcf -o " + out).code, 0);
  const MujocoVerdict verdict = fold_in_mujoco(text_of(out + "/strip.xml"), 1, 1.2);
  EXPECT_EQ(verdict.error, "");
  const app::PreparedPrint print =
      app::prepared(app::read_design(design), *model::find_process("sla"), {}, false);
  const app::PrintSheet& sheet = print.job.sheet;
  model::State settled = sheet.path.back();
  ASSERT_EQ(verdict.positions.size(), settled.size());
  for (std::size_t b = 0; b < settled.size(); ++b) settled[b].p = 1e3 * verdict.positions[b];
  EXPECT_LE(aligned_distance(sheet.linkage, settled, sheet.path.back()).max, 1e-4) << "cell edges";
}

/// Eighteen hinges next to one another, each of which turns independently.
TEST(Coupon, IsReadByMujocoAsAHingeEach) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("export --coupon --format mjcf -o " + std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const MujocoVerdict verdict = fold_in_mujoco(text_of(scratch / "out/coupon.xml"), 0.01, 0.1);
  EXPECT_EQ(verdict.error, "");
  EXPECT_EQ(verdict.positions.size(), 36U);
  EXPECT_EQ(verdict.joints, 18);
  EXPECT_EQ(verdict.constraints, 0) << "nothing holds a hinge";
}

TEST(Coupon, IsCleanWithItsRaisedNumbers) {
  const Scratch scratch;
  for (const char* process : {"sla", "fdm"}) {
    const Outcome run = kinetix_opt(fmt::format("export --coupon --format stl --process {} -o {}", process,
                                                std::string(scratch / process)));
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string file = scratch / (std::string(process) + "/all.stl");
    const std::string said = command_output("admesh " + file);
    EXPECT_THAT(said, HasSubstr("Facets with 3 disconnected edges :     0")) << said;
    EXPECT_EQ(number_after(said, R"(Number of parts\s*:)"), 36);
    for (const char* what : {"Degenerate facets", "Edges fixed", "Facets removed", "Facets reversed"})
      EXPECT_EQ(number_after(said, std::string(what) + R"(\s*:)"), 0) << what << said;
    EXPECT_THAT(command_output(std::string(KINETIX_SELF_CROSSING) + " " + file),
                HasSubstr("manifold 1\nclosed 1\ncrossing 0"));
  }
}

/// A small picture. Its hinges are off their walls by up to 0.8 mm.
constexpr const char* dot = R"(kinetix: 1
name: dot
target: {kind: display, rows: ["01", "00"]}
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 0.8, height: 6}}
variables: {offset_mm: 0.8}
)";

/// Caps hide bores that are off the middle. The pins are as clean, as many and as free as other pins.
TEST(Caps, HideWhereTheAxesAreAndFoldAsWell) {
  const Scratch scratch;
  const std::string result = scratch / "dot", out = scratch / "out";
  const Outcome found = kinetix_opt(scratch.write("dot.yaml", dot) + " --no-verify --quiet -o " + result);
  ASSERT_TRUE(found.code == 0 || found.code == 3) << found.err;
  std::string command = "export " + result + " --format stl,step --process sla --caps --quiet -o " + out;
  Outcome run = kinetix_opt(command);
  std::smatch edge;
  if (std::regex_search(run.err, edge, std::regex(R"(--cell-mm ([0-9.]+))")))
    run = kinetix_opt(command += " --cell-mm " + edge.str(1));
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(text_of(scratch / "out/print.json"));
  EXPECT_EQ(schema_errors(json, "print"), "");
  EXPECT_EQ(json["caps"], true);
  EXPECT_EQ(json["hinge"], "pin");
  EXPECT_GE(double(json["path"]["in_hinges"]["mm"]), 0.25 - 0.01);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("bores in round caps of "));
  const std::string admesh = command_output("admesh " + out + "/hard.stl");
  EXPECT_THAT(admesh, HasSubstr("Facets with 3 disconnected edges :     0"));
  EXPECT_EQ(number_after(admesh, R"(Normals fixed\s*:)"), 0);
  EXPECT_EQ(number_after(admesh, R"(Number of parts\s*:)"), 9);
  EXPECT_THAT(command_output(std::string(KINETIX_SELF_CROSSING) + " " + out + "/hard.stl"),
              HasSubstr("manifold 1\nclosed 1\ncrossing 0"));
  const StepVerdict step = read_step(out + "/dot.step");
  EXPECT_TRUE(step.valid);
  EXPECT_EQ(step.solids, 9);
  EXPECT_NEAR(step.volume_mm3 / double(json["volume_mm3"]["hard"]), 1, 3e-3) << "circles for polygons";
  const std::string slices = sliced_close(scratch, out, "hard.stl", {.layer_mm = 0.2});
  const auto [printed, swollen] = printed_and_swollen_pieces(slices, 1);
  EXPECT_EQ(printed, 9);
  EXPECT_EQ(swollen, 9) << "swollen by 0.05 mm a side";
  EXPECT_EQ(kinetix_opt("export " + result + " --format stl --caps --hinge block -o " + out).code, 2);
}

TEST(Caps, OfADesignWhosePinsHaveThem) {
  const Scratch scratch;
  const auto target = [&](const std::string& more) {
    return scratch.write("dot.yaml",
                         dot + ("hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.25" + more + "}\n"));
  };
  const std::string result = scratch / "dot", out = scratch / "out";
  const Outcome found = kinetix_opt(target(", caps: true") + " --no-verify --quiet -o " + result);
  ASSERT_TRUE(found.code == 0 || found.code == 3) << found.err;
  const Outcome run =
      kinetix_opt("export " + result + " --format stl --process sla --cell-mm 30 --quiet -o " + out);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(text_of(out + "/print.json"))["caps"], true);
}

fs::path folder_of(const Exported& print) { return fs::path(print.file("")).parent_path(); }

/// Walls and soft parts are upright over their whole height, so thick layers show as much as thin ones.
void expect_one_piece(const Exported& print) {
  const Scratch scratch;
  EXPECT_EQ(printed_pieces(sliced_close(scratch, folder_of(print), "all.stl", {.layer_mm = 0.5})), 1)
      << print.target << ", " << print.hinge;
}

/// Layers thinner than the axial clearance show all gaps. The parts are swollen by a pixel, 0.05 mm per side.
void expect_as_many_pieces_as_bodies(const std::string& rib_target, int cell_mm, const Exported& cube) {
  const Scratch scratch;
  const Outcome run =
      kinetix_opt(fmt::format("export {} --format stl --process sla --hinge pin --cell-mm {} -o {}",
                              found(rib_target), cell_mm, std::string(scratch / "rib")));
  ASSERT_EQ(run.code, 0) << run.err;
  const auto bodies_in = [](const fs::path& folder) {
    return int(Json::parse(text_of(folder / "print.json"))["bodies"]);
  };
  const SlicingOf how{.layer_mm = 0.2};
  const fs::path rib = scratch / "rib", squares = folder_of(cube);
  for (const fs::path& print : {rib, squares}) {
    const auto [printed, swollen] =
        printed_and_swollen_pieces(sliced_close(scratch, print, "hard.stl", how), 1);
    EXPECT_EQ(printed, bodies_in(print)) << print;
    EXPECT_EQ(swollen, bodies_in(print)) << print;
  }
}

TEST(SlicesOfTargets, OfARibOfBlocksAndAPanelOfFilmsAreOnePiece) {
  for (const Exported& print : {std::cref(blocked()), std::cref(filmed())}) expect_one_piece(print);
}

TEST(SlicesOfTargets, OfPinsFallIntoTheBodiesAndStillDoWhenSwollen) {
  expect_as_many_pieces_as_bodies("arch", 14, pinned_cube());
}

TEST(SlicesOfTargetsSoak, OfAHelmetRibOfBlocksAreOnePiece) { expect_one_piece(blocked_helmet()); }

TEST(SlicesOfTargetsSoak, OfPinsFallIntoTheBodiesAndStillDoWhenSwollen) {
  expect_as_many_pieces_as_bodies("helmet_rib", 12, pinned_shipped_cube());
}

}  // namespace
}  // namespace kinetix::testing
