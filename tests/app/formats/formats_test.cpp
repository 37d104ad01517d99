#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/files/bodies_section.hpp"
#include "app/files/design_file.hpp"
#include "app/formats/formats_page.hpp"
#include "app/goals/registry.hpp"
#include "app/imports/model_parts.hpp"
#include "app/sweep/plan/doe_file.hpp"
#include "app/sweep/plan/metric.hpp"
#include "tests/app/formats/node_json.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using ::testing::HasSubstr;
using testing::read_file;
using testing::schema_errors;
using Json = nlohmann::json;
using Kind = targets::ValueType::Kind;

// The source folder with schemas, pages and examples.
const std::string source = KINETIX_SOURCE;

std::string schema_text(const std::string& name) {
  return read_file(source + "/app/schema/" + name + ".schema.json");
}

TEST(FormatsPages, AreWhatTheTablesSay) {
  const auto pages = formats_pages(read_file(source + "/app/formats/page.in"), schema_text);
  EXPECT_GE(pages.size(), 12u);
  for (const FormatsPage& page : pages)
    EXPECT_EQ(read_file(source + "/docs/reference/" + page.name), page.text)
        << page.name << ": write it anew by `make docs`";
}

TEST(FormatsPages, NameEveryResponse) {
  const std::string page =
      read_file(source + "/docs/reference/sweep.md") + read_file(source + "/docs/reference/result.md");
  for (const bool searches : {false, true})
    for (const Model model : {Model::exact, Model::equilibrium, Model::bullet})
      for (const std::string& name : metric_names({model, searches, goal_kinds().front()}))
        EXPECT_THAT(page, HasSubstr("`" + name + "`"));
}

TEST(FormatsPages, RefuseATableThatIsLeftOutAndMarksThatStandForNothing) {
  for (const char* text :
       {"{{page design.md}}\n{{keys design}}\n", "{{page design.md}}\n{{keys nothing}}\n", "text\n"})
    EXPECT_THROW(formats_pages(text, schema_text), InvalidInput) << text;
}

/// Written designs have offsets to the left and to the right of the middle of a wall.
TEST(FileSchema, HasBothSignsOfAnOffset) {
  const Json schema = Json::parse(schema_text("design"));
  const Json offset =
      schema["properties"]["design"]["properties"]["hinges"]["items"]["properties"]["offset_mm"];
  ASSERT_EQ(offset["type"], "number");
  for (const char* bound : {"minimum", "exclusiveMinimum"}) EXPECT_FALSE(offset.contains(bound)) << bound;
}

TEST(FileSchema, IsWhatTheTablesSay) {
  for (const FileSchema& schema : file_schemas())
    EXPECT_EQ(schema_text(schema.name), schema.text) << "write it anew by `make docs`";
}

/// Returns the name of the schema for a file, by its keys.
std::string schema_of(const Json& file) {
  return file.contains("factors") ? "doe" : file.contains("target") ? "target" : "design";
}

TEST(FileSchema, AllowsEveryFileThatShips) {
  int count = 0;
  for (const char* folder : {"/targets/shapes", "/targets/sweeps"})
    for (const auto& entry : std::filesystem::directory_iterator(source + folder)) {
      if (entry.path().extension() != ".yaml") continue;
      const Json file = testing::as_json(targets::read_document(entry.path().string(), max_design_bytes));
      EXPECT_EQ(schema_errors(file, schema_of(file)), "") << entry.path();
      ++count;
    }
  EXPECT_GE(count, 20);
}

/// Reads a file of any kind. @throws InvalidInput
void read_any(const std::string& text) {
  if (Json::parse(text, nullptr, false).contains("hinges")) {
    testing::TemporaryFolder side;
    return void(read_hinge_choices(side.write("in.yaml", text)));
  }
  const targets::Node root = targets::parse_document(text, source + "/targets/shapes/in.yaml");
  if (root.kind() != targets::Node::Kind::map || root.optional("target")) return void(read_target(root));
  if (!root.optional("factors")) return void(read_design(root));
  testing::TemporaryFolder folder;
  read_doe(folder.write("in.yaml", text));
}

// Parts of files; the tests add wrong lines to them.
const std::string curve = "target: {kind: curve, points: [[0, 0], [60, 0], [60, 40]]}";
const std::string doe = "kinetix: 1\nbase: x.yaml\nresponses: [theta_deg]\nmethod: {kind: sobol}\n";

TEST(FileSchema, RefusesWhatTheProgramRefuses) {
  const std::pair<const char*, std::string> bad[] = {
      {"target", curve},
      {"target", "kinetix: 2\n" + curve},
      {"target", "kinetix: 1\ntarget: {kind: outline}"},
      {"target", "kinetix: 1\ntarget: {kind: outline, points: [[0, 0], [1, 0]], structure: {cells: [2]}}"},
      {"target", "kinetix: 1\ntarget: {points: [[0, 0], [1, 1]]}"},
      {"target", "kinetix: 1\n" + curve + "\nsomething: 1"},
      {"target", "kinetix: 1\n" + curve + "\nhinge: {k_turn: -1}"},
      {"target", "kinetix: 1\n" + curve + "\ntolerance: {shape: 2}"},
      {"target", "kinetix: 1\n" + curve + "\ntolerance: {shape: \"0.1\"}"},
      {"target", "kinetix: 1\n" + curve + "\nsolver: {starts: 1.5}"},
      {"target", "kinetix: 1\n" + curve + "\nvariables: {theta: {range_deg: [2]}}"},
      {"target", "kinetix: 1\ntarget: {kind: display, glyph: T, rows: [\"01\", \"10\"]}"},
      {"target", "kinetix: 1\ntarget: {kind: display}"},
      {"target", "kinetix: 1\ntarget: {kind: display, rows: [\"01\", \"10\"], font: Sans}"},
      {"target", "kinetix: 1\ntarget: {kind: display, glyph: T}\nsolver: {name: ceres}"},
      {"target", "kinetix: 1\ntarget: {kind: fold, box: [1, 2]}"},
      {"target", "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\nstructure: {cells: [3, 3]}"},
      {"target", "kinetix: 1\ntarget: {kind: helmet}"},
      {"target", "kinetix: 1\ntarget: {kind: helmet, mesh: headform.obj, up: w}"},
      {"design", "kinetix: 1"},
      {"design", "kinetix: 1\nstructure: {cell_mm: 10}"},
      {"design", "kinetix: 1\nstructure: {cells: [2, 1]}\ndesign: {theta_deg: 90}"},
      {"design", "kinetix: 1\nstructure: {cells: [2, 1]}\ndesign: {hinges: [{t: 0.5}]}"},
      {"design", "kinetix: 1\nstructure: {cells: [2, 1]}\ndrive: {kind: plates}"},
      {"design",
       "kinetix: 1\nstructure: {cells: [2, 1]}\ndrive: {kind: plates, compression: 0.1, angle_deg: 3}"},
      {"design", "kinetix: 1\nstructure: {cells: [2, 1]}\ndrive: {kind: plates, compression: 0.1, side: 2}"},
      {"doe", doe + "factors: []"},
      {"doe", doe + "factors: [{path: a, range: [0, 1], values: [1]}]"},
      {"doe", doe + "factors: [{path: a}]"},
      {"doe", doe + "factors: [{path: a, range: [0, 1], levels: 1}]"},
      {"doe", doe + "model: none\nfactors: [{path: a, range: [0, 1]}]"},
  };
  for (const auto& [schema, text] : bad) {
    EXPECT_THROW(read_any(text), InvalidInput) << text;
    EXPECT_NE(schema_errors(testing::as_json(targets::parse_document(text, "in.yaml")), schema), "") << text;
  }
}

/// Returns the path of a small picture: a bar on white.
std::string image_file() {
  static const testing::TemporaryFolder folder;
  std::string text = "P1 12 12\n";
  for (int row = 0; row < 12; ++row) text += "0 0 0 0 1 1 1 1 0 0 0 0\n";
  return folder.write("bar.pbm", text);
}

/// Returns the path of a small patch, 40 mm wide and bent in one direction.
std::string patch_file() {
  static const testing::TemporaryFolder folder;
  std::string text;
  for (int k = 0; k < 25; ++k)
    text += fmt::format("v {} {} {}\n", k % 5 * 10, k / 5 * 10, k % 5 * (k % 5 - 4));
  for (int k = 0; k < 16; ++k) {
    const int corner = k / 4 * 5 + k % 4 + 1;
    text += fmt::format("f {} {} {} {}\n", corner, corner + 1, corner + 6, corner + 5);
  }
  return folder.write("patch.obj", text);
}

/// Returns the path of a cube of 10 mm that begins at x.
std::string cube_file(const char* name, double x) {
  static const testing::TemporaryFolder folder;
  std::string text;
  for (int k = 0; k < 8; ++k) text += fmt::format("v {} {} {}\n", x + k % 2 * 10, k / 2 % 2 * 10, k / 4 * 10);
  text += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  return std::filesystem::relative(folder.write(name, text), source + "/targets/shapes").string();
}

/// Returns two cubes with a hinge between them.
Json two_bodies() {
  const Json bodies = Json::array({{{"name", "left"}, {"file", cube_file("left.obj", 0)}},
                                   {{"name", "right"}, {"file", cube_file("right.obj", 12)}}});
  const Json hinge = {
      {"name", "soft"}, {"bodies", {"left", "right"}}, {"point_mm", {11, 5, 5}}, {"axis", {0, 0, 1}}};
  return {{"kinetix", 1}, {"structure", {{"bodies", bodies}, {"hinges", Json::array({hinge})}}}};
}

/// Returns files in which a key of the list may be set: one for each way to fill the list.
std::vector<Json> files_of(const std::string& list) {
  const auto target = [](const char* text) { return Json{{"kinetix", 1}, {"target", Json::parse(text)}}; };
  const auto design = [](const char* drive) {
    return Json{{"kinetix", 1},
                {"structure", {{"cells", {2, 1}}}},
                {"design", {{"hinges", Json::parse(R"([{"wall": [[0, 0], [1, 0]]}])")}}},
                {"drive", Json::parse(drive)}};
  };
  const auto sweep = [](const char* factor) {
    Json file = testing::as_json(targets::parse_document(doe, "in.yaml"));
    file["model"] = "equilibrium";
    file["factors"] = Json::array({Json::parse(factor)});
    return file;
  };
  Json image = target(R"({"kind": "display"})");
  image["target"]["image"] = image_file();
  // Hinges by stiffness per direction and hinges by their manufactured shape, for the whole sheet and for a single
  // wall.
  const Json framed = Json::parse(R"({"k": {"axial": 3, "shear": 1, "along": 2, "turn": 0.1}})");
  const Json block = Json::parse(R"({"kind": "block", "gap_mm": 1,
      "material": {"E_mpa": 1, "nu": 0.4, "strain_max": 0.5}})");
  const Json pin = Json::parse(R"({"kind": "pin", "diameter_mm": 1})");
  const auto hinged = [](Json file, const Json& hinge) {
    file["hinge"] = hinge;
    if (file.contains("design")) file["design"]["hinges"][0]["hinge"] = hinge;
    return file;
  };
  // Adds files with a hinge of each kind at some of the walls only.
  const auto add_parted = [&](std::vector<Json>& files, const Json& file, const Json& at) {
    for (Json part : {Json::object(), framed, block, pin}) {
      part["at"] = at;
      files.push_back(file);
      files.back()["hinge"]["except"] = Json::array({part});
    }
  };
  // Returns a goal without hinges, with each kind of hinge, and with springs as its drive.
  const auto made = [&](const Json& goal) {
    Json heated = goal;
    heated["drive"] = {{"kind", "shape_memory"}, {"k_turn", 1}};
    std::vector<Json> files{goal, hinged(goal, framed), hinged(goal, block), hinged(goal, pin), heated};
    add_parted(files, goal, "creases");
    return files;
  };
  if (list == "target curve") {
    // The goal without a cell size, and with cells large enough for prints and pins.
    Json curve = target(R"({"kind": "curve", "points": [[0, 0], [60, 0], [60, 40]]})");
    const Json small = curve;
    curve["structure"] = {{"cell_mm", 10}};
    std::vector<Json> curves = made(curve);
    curves.push_back(small);
    return curves;
  }
  const Json letter = target(R"({"kind": "display", "glyph": "T"})");
  if (list == "target display")
    return {hinged(letter, framed),
            hinged(letter, block),
            hinged(letter, pin),
            target(R"({"kind": "display", "glyph": "T"})"),
            image,
            Json{{"kinetix", 1},
                 {"target", Json::parse(R"({"kind": "display", "glyph": "T"})")},
                 {"structure", {{"lattice", "rhombus"}}}},
            Json{{"kinetix", 1},
                 {"target", Json::parse(R"({"kind": "display", "glyph": "T"})")},
                 {"drive", {{"kind", "hinge"}}}},
            target(R"({"kind": "display", "rows": ["0110", "0110", "0000"]})")};
  if (list == "target fold") {
    std::vector<Json> folds = made(target(R"({"kind": "fold", "box": [2, 2, 2]})"));
    folds.push_back(target(R"({"kind": "fold", "box_mm": [40, 30, 30]})"));
    folds.push_back(target(R"({"kind": "fold", "solid": "tetrahedron"})"));
    folds.push_back(target(R"({"kind": "fold", "net": {"faces": [{"name": "a", "cells": [2, 2]},
                       {"name": "b", "cells": [2, 2]}],
                       "creases": [{"faces": ["a", "b"], "side": "top", "angle_deg": 90}]}})"));
    return folds;
  }
  // Sheets with a cell size, which hinges need for sizes in mm.
  const auto sized = [&](Json goal, double cell_mm) {
    goal["structure"]["cell_mm"] = cell_mm;
    return made(goal);
  };
  if (list == "target outline") {
    const Json triangle = target(R"({"kind": "outline", "points": [[0, 0], [60, 0], [60, 40]]})");
    std::vector<Json> outlines = sized(triangle, 10);
    outlines.push_back(triangle);
    outlines.push_back(triangle);
    outlines.back()["structure"] = {{"lattice", "rhombus"}};
    return outlines;
  }
  if (list == "target space_block") {
    const Json cube = target(R"({"kind": "space_block", "factor": 0.8})");
    Json box = cube;
    box["target"]["size_mm"] = {120, 120, 60};
    return {cube, box};
  }
  if (list == "target space_curve") {
    const Json arc =
        target(R"({"kind": "space_curve", "points": [[0, 0, 0], [30, 0, 4], [60, 0, 16], [90, 0, 36]]})");
    std::vector<Json> curves = sized(arc, 8);
    curves.push_back(arc);
    return curves;
  }
  Json patch = target(R"({"kind": "surface"})");
  patch["target"]["mesh"] = patch_file();
  if (list == "target surface")
    return {target(R"({"kind": "surface", "shape": "cap"})"),
            target(R"({"kind": "surface", "shape": "saddle"})"),
            target(R"({"kind": "surface", "shape": "vase"})"), patch};
  // A small head, since it is read about two hundred times.
  Json head = target(R"({"kind": "helmet", "ribs": 4, "coverage_mm": 40})");
  head["target"]["mesh"] = source + "/tests/fuzz/corpus/head/head.ply";
  if (list == "target helmet") return made(head);
  if (list == "doe")
    return {sweep(R"({"path": [{"path": "a"}], "range": [0, 1]})"),
            sweep(R"({"path": {"path": "a"}, "range": [0, 1]})"),
            sweep(R"({"path": "a", "normal": {"mean": 0, "std_dev": 1}})"),
            sweep(R"({"path": "a", "values": [1]})")};
  if (list == "assembly") {
    const Json still = two_bodies();
    Json soft = still, driven = still, pulled = still;
    soft["structure"]["hinges"][0]["k"] = {{"axial", 3}, {"shear", 1}, {"along", 2}, {"turn", 0.1}};
    driven["drive"] = {{"angle_deg", 10}};
    pulled["drive"]["poses"] = Json::parse("[[5, 5, 5, 1, 0, 0, 0], [17, 5, 5, 1, 0, 0, 0]]");
    const Json cut{{"kinetix", 1},
                   {"structure", {{"cuts", KINETIX_SOURCE "/targets/tiles/turning_squares.svg"}}}};
    return {still, soft, driven, pulled, cut};
  }
  if (list == "hinges")
    return {Json{{"kinetix", 1}, {"hinges", Json::parse(R"([{"hinge": "a", "axis": [0, 0, 1]}])")}},
            Json{{"kinetix", 1}, {"hinges", Json::parse(R"([{"bodies": ["a", "b"], "axis": [0, 0, 1]}])")}}};
  const auto of_structure = [](const Json& structure) {
    return Json{{"kinetix", 1}, {"structure", structure}};
  };
  const Json pressed = design(R"({"kind": "plates", "compression": 0.1})");
  std::vector<Json> designs{
      pressed,
      hinged(pressed, framed),
      hinged(pressed, block),
      hinged(pressed, pin),
      design(R"({"kind": "hinge", "wall": [[0, 0], [1, 0]], "angle_deg": 10})"),
      of_structure({{"lattice", "rhombus"}, {"cells", {2, 2}}}),
      of_structure({{"lattice", "sodalite"}, {"cells", {1, 1, 1}}}),
      of_structure({{"lattice", "graph"}, {"drawing", KINETIX_SOURCE "/targets/shapes/rosette.dxf"}}),
      of_structure({{"lattice", "graph"}, {"origami", KINETIX_SOURCE "/targets/shapes/miura.fold"}}),
      of_structure({{"lattice", "graph"},
                    {"vertices_mm", Json::parse("[[0, 0], [10, 0], [10, 10], [0, 10]]")},
                    {"walls", Json::parse("[[0, 1], [1, 2], [2, 3], [3, 0]]")}})};
  for (const Json& at : {Json("creases"), Json{{"column", 0}}, Json{{"row", 0}}})
    add_parted(designs, pressed, at);
  return designs;
}

struct PlacedKey {
  std::string path;
  targets::Key key;
};

void add_keys(std::vector<PlacedKey>& all, const std::string& path, const targets::ValueType& type) {
  if (type.kind == Kind::map)
    for (const targets::Key& key : type.keys->keys()) {
      const std::string inner = path + (path.empty() ? "" : ".") + key.name;
      all.push_back({inner, key});
      add_keys(all, inner, key.type);
    }
  for (const targets::ValueType& part : type.parts)
    add_keys(all, type.kind == Kind::list ? path + "[0]" : path, part);
}

/// Converts "a.b[0].c" to a JSON pointer.
Json::json_pointer pointer(std::string path) {
  for (std::size_t at = 0; (at = path.find_first_of(".[", at)) != std::string::npos;) path[at] = '/';
  path.erase(std::remove(path.begin(), path.end(), ']'), path.end());
  return Json::json_pointer("/" + path);
}

/// Returns the error for a file, or none if the file is valid.
std::optional<InvalidInput> refusal_of(const Json& file) {
  try {
    read_any(file.dump());
    return std::nullopt;
  } catch (const InvalidInput& e) {
    return e;
  }
}

/// Checks whether `wanted` accepts one of the list's files with this value at the key.
bool one_is(const std::string& list, const std::string& path, const Json& value,
            const std::function<bool(const std::optional<InvalidInput>&)>& wanted) {
  for (Json file : files_of(list)) {
    try {
      file[pointer(path)] = value;
    } catch (const Json::exception&) {
      continue;  // this file has another type of value at a parent of the key
    }
    if (wanted(refusal_of(file))) return true;
  }
  return false;
}

/// Whether only designs may use this key of a list: goals name creases alone. Outline panels have no creases
/// (matter_test.cpp tests how they refuse the others).
bool is_of_designs(const std::string& list, const std::string& path) {
  const auto under = [&](const char* key) { return path.rfind(key, 0) == 0; };
  if (list == "target outline") return under("hinge.except[0]");
  return list.rfind("target", 0) == 0 && under("hinge.except[0].at.");
}

class EveryKey : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<PlacedKey> keys() const {
    std::vector<PlacedKey> all;
    for (const KeyList& list : all_keys())
      if (list.name == GetParam()) add_keys(all, "", targets::value::map(*list.keys));
    std::erase_if(all, [](const PlacedKey& placed) { return is_of_designs(GetParam(), placed.path); });
    return all;
  }
};

TEST_P(EveryKey, IsRead) {
  ASSERT_FALSE(keys().empty());
  for (const auto& [path, key] : keys())
    EXPECT_TRUE(
        one_is(GetParam(), path, nullptr,
               [&path = path](const auto& refusal) { return refusal && refusal->place().key == path; }))
        << path << " is documented, but a value that cannot be there is not refused";
}

TEST_P(EveryKey, MayBeGivenItsDefault) {
  for (const auto& [path, key] : keys()) {
    if (key.fallback.kind != targets::Default::Kind::literal) continue;
    const Json parsed = Json::parse(key.fallback.text, nullptr, false);
    EXPECT_TRUE(one_is(GetParam(), path, parsed.is_discarded() ? Json(key.fallback.text) : parsed,
                       [](const auto& refusal) { return !refusal; }))
        << path << ": " << key.fallback.text;
  }
}

TEST_P(EveryKey, HasAMeaning) {
  for (const auto& [path, key] : keys()) EXPECT_FALSE(key.meaning.empty()) << path;
}

INSTANTIATE_TEST_SUITE_P(Files, EveryKey,
                         ::testing::Values("target curve", "target display", "target fold", "target helmet",
                                           "target outline", "target space_block", "target space_curve",
                                           "target surface", "design", "doe", "assembly", "hinges"),
                         [](const auto& list) {
                           std::string name = list.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace kinetix::app
