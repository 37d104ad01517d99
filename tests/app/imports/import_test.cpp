#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/cad/cad_formats.hpp"
#include "app/files/design_file.hpp"
#include "app/print/format/zip_text.hpp"
#include "model/assembly/assembly.hpp"
#include "model/base/geometry.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Isometry3d;
using ::testing::HasSubstr;
using Json = nlohmann::json;
using model::Polyhedron;

/// An OBJ file of several objects, each with a material.
class Obj {
 public:
  Obj& add(const std::string& name, const std::string& material, const Polyhedron& solid) {
    text_ += "o " + name + "\nusemtl " + material + "\n";
    for (const auto& p : solid.points) text_ += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    for (const auto& t : solid.triangles)
      text_ += fmt::format("f {} {} {}\n", t[0] + count_, t[1] + count_, t[2] + count_);
    count_ += static_cast<int>(solid.points.size());
    return *this;
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
  int count_ = 1;
};

Polyhedron left() { return box_solid(-9, -0.5, 0.8, 6); }
Polyhedron right() { return box_solid(0.5, 9, 0.8, 6); }
Polyhedron block(double height = 6) { return box_solid(-0.5, 0.5, 0.8, height); }

std::string pair_of_walls(const Polyhedron& soft = block()) {
  return Obj()
      .add("left wall", "PLA", left())
      .add("right wall", "PLA", right())
      .add("joint", "TPU", soft)
      .text();
}

/// Expects one line on stderr, exit code 2 and no files. Uses --quiet, since a slow machine may print its progress
/// first.
void expect_refused(const Scratch& scratch, const std::string& arguments, const std::string& says) {
  const Outcome run = kinetix_opt("import " + arguments + " --quiet -o " + (scratch / "out").string());
  EXPECT_EQ(run.code, 2) << run.out << run.err;
  EXPECT_THAT(run.err, HasSubstr(says));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_FALSE(fs::exists(scratch / "out")) << says;
}

void expect_refused(const std::string& name, const std::string& content, const std::string& says,
                    const std::string& options = "") {
  const Scratch scratch;
  expect_refused(scratch, scratch.write(name, content) + " " + options, says);
}

Json imported(const Scratch& scratch, const std::string& arguments) {
  const Outcome run = kinetix_opt("import " + arguments + " --json -o " + (scratch / "out").string());
  EXPECT_EQ(run.code, 0) << run.err;
  return Json::parse(run.out);
}

std::string threemf(const std::string& resources, const std::string& build) {
  return app::zip_text({{"3D/3dmodel.model", "<model unit=\"millimeter\"><resources>" + resources +
                                                 "</resources><build>" + build + "</build></model>"}});
}

TEST(Import, TakesMaterialsAndNamesOfObj) {
  const Scratch scratch;
  const Json found = imported(scratch, scratch.write("pair.obj", pair_of_walls()));
  ASSERT_EQ(found["hinges"].size(), 1u);
  const Json& hinge = found["hinges"][0];
  EXPECT_EQ(hinge["name"], "joint");
  EXPECT_EQ(hinge["bodies"], Json({"left_wall", "right_wall"}));
  EXPECT_EQ(hinge["axis"], Json({0, 0, 1}));
  EXPECT_EQ(found["unit"],
            "millimetres, inferred: the file has no unit, and the model is 18 of them long. Give --unit for "
            "another one");
  EXPECT_TRUE(fs::exists(scratch / "out/parts/left_wall.stl"));
  EXPECT_EQ(kinetix_opt("check " + (scratch / "out/design.yaml").string()).code, 0);
}

/// The block's range does not limit its rocking and twist.
TEST(Import, WritesTheRockingAndTwistOfABlock) {
  const Scratch scratch;
  imported(scratch, scratch.write("pair.obj", pair_of_walls()));
  const std::string design = (scratch / "out/design.yaml").string();
  const model::HingeStiffness k = app::read_design(design).structure.assembly()->hinges.front().k;
  const model::HingeStiffness block =
      stiffness(model::ManufacturedHinge{.kind = model::HingeKind::block,
                                         .material = *model::find_material("tango"),
                                         .gap_mm = 1,
                                         .thickness_mm = 0.8,
                                         .height_mm = 6});
  ASSERT_TRUE(k.rock && k.twist);
  EXPECT_NEAR(*k.rock / *block.rock, 1, 1e-6);
  EXPECT_NEAR(*k.twist / *block.twist, 1, 1e-6);
  ASSERT_EQ(kinetix_opt("simulate " + design + " -o " + (scratch / "run").string()).code, 0);
  const Json result = Json::parse(text_of(scratch / "run/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(double(result["structure"]["hinges"][0]["k"]["twist"]), *k.twist);
}

TEST(Import, ScalesByTheUnitThatIsAskedFor) {
  const Scratch scratch;
  const std::string file = scratch.write("pair.obj", pair_of_walls(block(5)));
  imported(scratch, file + " --unit in");
  const std::string text = text_of(scratch / "out/design.yaml");
  EXPECT_THAT(text, HasSubstr("position_mm: [120.65, 0, 0]"));  // 4.75 inches
  fs::remove_all(scratch / "out");
  expect_refused(scratch, file + " --unit yard", "--unit: unknown unit `yard`; allowed: mm, cm, m, in, ft");
}

TEST(Import, TakesSmallModelsForInches) {
  Polyhedron small = block(), a = left(), b = right();
  for (Polyhedron* solid : {&small, &a, &b})
    for (auto& p : solid->points) p /= 25.4 / 10;
  const Scratch scratch;
  const Json found = imported(
      scratch, scratch.write("pair.obj",
                             Obj().add("a", "hard", a).add("b", "hard", b).add("c", "soft", small).text()));
  EXPECT_THAT(found["unit"].get<std::string>(), HasSubstr("inches, inferred"));
}

/// Returns a 3MF file of one solid, in centimetres.
std::string threemf_in_cm(const Polyhedron& solid) {
  std::string points, triangles;
  for (const auto& p : solid.points)
    points += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x(), p.y(), p.z());
  for (const auto& t : solid.triangles)
    triangles += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>", t[0], t[1], t[2]);
  return app::zip_text(
      {{"3D/3dmodel.model", "<model unit=\"centimeter\"><resources><object id=\"1\"><mesh><vertices>" +
                                points + "</vertices><triangles>" + triangles +
                                "</triangles></mesh></object></resources>"
                                "<build><item objectid=\"1\"/></build></model>"}});
}

/// Slicers write each object of a plate into a separate model with separate numbers.
TEST(Import, TakesObjectsFromOtherModelsOfAPackage) {
  const auto mesh = [](const Polyhedron& solid) {
    std::string points, triangles;
    for (const auto& p : solid.points)
      points += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x(), p.y(), p.z());
    for (const auto& t : solid.triangles)
      triangles += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>", t[0], t[1], t[2]);
    return "<mesh><vertices>" + points + "</vertices><triangles>" + triangles + "</triangles></mesh>";
  };
  const std::string materials =
      "<basematerials id=\"9\"><base name=\"hard\" displaycolor=\"#999999\"/>"
      "<base name=\"soft\" displaycolor=\"#000000\"/></basematerials>";
  const auto part = [&](const Polyhedron& solid, const std::string& name, int material,
                        const std::string& unit) {
    return fmt::format(
        "<model unit=\"{}\"><resources>{}<object id=\"1\" name=\"{}\" pid=\"9\" "
        "pindex=\"{}\">{}</object></resources><build/></model>",
        unit, materials, name, material, mesh(solid));
  };
  const auto package = [&](const std::string& unit) {
    return app::zip_text(
        {{"3D/3dmodel.model",
          "<model unit=\"millimeter\" xmlns:p=\"production\"><resources><object id=\"1\"><components>"
          "<component p:path=\"/3D/Objects/a.model\" objectid=\"1\"/></components></object></resources>"
          "<build><item objectid=\"1\"/><item p:path=\"/3D/Objects/b.model\" objectid=\"1\"/>"
          "<item p:path=\"/3D/Objects/c.model\" objectid=\"1\"/></build></model>"},
         {"3D/Objects/a.model", part(left(), "left_wall", 0, "millimeter")},
         {"3D/Objects/b.model", part(right(), "right_wall", 0, "millimeter")},
         {"3D/Objects/c.model", part(block(), "joint", 1, unit)}});
  };
  const Scratch scratch;
  const Json found = imported(scratch, scratch.write("plate.3mf", package("millimeter")));
  ASSERT_EQ(found["hinges"].size(), 1u);
  EXPECT_EQ(found["hinges"][0]["name"], "joint");
  EXPECT_EQ(found["hinges"][0]["bodies"], Json({"left_wall", "right_wall"}));
  fs::remove_all(scratch / "out");
  expect_refused("plate.3mf", package("inch"), "holds objects of another unit in `3D/Objects/c.model`");
}

// Regression: the file without a unit was assumed to be in mm, and the summary reported the other file's unit for both.
TEST(Import, OfTwoFilesInCommonCoordinatesTakesTheUnitThatOneOfThemSays) {
  const Scratch scratch;
  const std::string hard =
      scratch.write("hard.obj", Obj().add("a", "hard", left()).add("b", "hard", right()).text());
  const std::string soft = scratch.write("soft.3mf", threemf_in_cm(block()));
  const Json found = imported(scratch, "--hard " + hard + " --soft " + soft);
  EXPECT_EQ(found["hinges"].size(), 1u);
  EXPECT_EQ(found["unit"], "10 mm, from the file");
  EXPECT_THAT(text_of(scratch / "out/design.yaml"), HasSubstr("position_mm: [-47.5, 0, 0]"));
}

TEST(Import, AsksForTheAxisOfACubeAndTakesItFromASideFile) {
  const Scratch scratch;
  const std::string model = scratch.write("cube.obj", pair_of_walls(box_solid(-0.5, 0.5, 0.8, 0.8)));
  expect_refused(scratch, model,
                 "soft part `joint` between `left_wall` and `right_wall` bends about either of two axes");
  for (const char* hinges : {"kinetix: 1\nhinges: [{hinge: joint, axis: [0, 2, 0]}]\n",
                             "kinetix: 1\nhinges: [{bodies: [right_wall, left_wall], axis: [0, 1, 0]}]\n",
                             "kinetix: 1\ntowards: [0.1, 1, 0.2]\n"})
    EXPECT_EQ(
        imported(scratch, model + " --hinges " + scratch.write("hinges.yaml", hinges))["hinges"][0]["axis"],
        Json({0, 1, 0}))
        << hinges;
  fs::remove_all(scratch / "out");
  expect_refused(scratch,
                 model + " --hinges " +
                     scratch.write("hinges.yaml", "kinetix: 1\nhinges: [{hinge: elbow, axis: [0, 1, 0]}]\n"),
                 "bends about either of two axes");
  expect_refused(
      scratch, scratch.write("pair.obj", pair_of_walls()) + " --hinges " + (scratch / "hinges.yaml").string(),
      "--hinges names `elbow`, which is neither a soft part");
  expect_refused(
      scratch, model + " --hinges " + scratch.write("hinges.yaml", "kinetix: 1\nhinges: [{hinge: joint}]\n"),
      "hinges.yaml:2:10: hinges[0]");
  expect_refused(scratch,
                 model + " --hinges " +
                     scratch.write("hinges.yaml", "kinetix: 1\nhinges: [{hinge: joint, axis: [1, 0, 0]}]\n"),
                 "runs along the soft part");
}

TEST(Import, SaysWhichMaterialsThereAreWhereNoneIsSaidToBeSoft) {
  const std::string colours =
      Obj().add("a", "red", left()).add("b", "red", right()).add("c", "blue", block()).text();
  expect_refused("pair.obj", colours,
                 "the soft material is not clear: `blue`, `red`. Name it with --soft-material");
  expect_refused("pair.obj", colours, "no material, colour or part has the name `green`: `blue`, `red`",
                 "--soft-material green");
  const Scratch scratch;
  EXPECT_EQ(
      imported(scratch, scratch.write("pair.obj", colours) + " --soft-material Blue")["hinges"][0]["name"],
      "c");
  expect_refused("pair.obj", pair_of_walls(), "--material: unknown material `tang` (did you mean `tango`?)",
                 "--material tang");
}

/// A rod of one colour in the bore of another: no part is soft.
TEST(Import, TakesColouredPartsWithPinsAsHard) {
  const Polyhedron rod = tube(ring(1.5, 24, true), {}, -8, 8),
                   eye = tube(ring(4, 24, true), ring(1.8, 24, false), -3, 3);
  const std::string text = Obj().add("rod", "red PLA", rod).add("eye", "blue PLA", eye).text();
  for (const char* option : {"", " --soft-material none"}) {
    const Scratch scratch;
    const Json found = imported(scratch, scratch.write("pin.obj", text) + option);
    ASSERT_EQ(found["hinges"].size(), 1u);
    EXPECT_EQ(found["hinges"][0]["kind"], "pin");
  }
  expect_refused("pair.obj", pair_of_walls(), "hard part", "--soft-material none");
}

/// Each face of a wall has its colour; each body is one part all the same.
TEST(Import, JoinsPaintedFacesOfAnObject) {
  const auto object = [](int id, const Polyhedron& solid) {
    std::string points, triangles;
    for (const auto& p : solid.points)
      points += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x() / 1000, p.y() / 1000, p.z() / 1000);
    for (std::size_t k = 0; k < solid.triangles.size(); ++k)
      triangles += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\" pid=\"9\" p1=\"{}\"/>",
                               solid.triangles[k][0], solid.triangles[k][1], solid.triangles[k][2], k % 2);
    return fmt::format(
        "<object id=\"{}\"><mesh><vertices>{}</vertices><triangles>{}</triangles></mesh></object>", id,
        points, triangles);
  };
  const Polyhedron rod = tube(ring(1.5, 24, true), {}, -8, 8),
                   eye = tube(ring(4, 24, true), ring(1.8, 24, false), -3, 3);
  const std::string text = app::zip_text(
      {{"3D/3dmodel.model",
        "<model unit=\"meter\"><resources><basematerials id=\"9\"><base name=\"red\"/><base name=\"blue\"/>"
        "</basematerials>" +
            object(1, rod) + object(2, eye) +
            "<object id=\"3\"><components><component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 0.01 0.02 "
            "0.03\"/><component objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 0.01 0.02 0.03\"/></components>"
            "</object></resources><build><item objectid=\"3\"/></build></model>"}});
  const Scratch scratch;
  const Json found = imported(scratch, scratch.write("painted.3mf", text));
  EXPECT_EQ(found["bodies"], 2);
  ASSERT_EQ(found["hinges"].size(), 1u);
  EXPECT_EQ(found["hinges"][0]["kind"], "pin");
  EXPECT_NEAR(found["hinges"][0]["point_mm"][0].get<double>(), 10, 1e-6);
  EXPECT_NEAR(found["hinges"][0]["point_mm"][2].get<double>(), 30, 1e-6);
}

/// Two squares that share vertex 3 but no edge.
TEST(Import, TakesFlatPolygonsThatShareCornersAsTiles) {
  const std::string tiles =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nf 1 2 3 4\nf 3// 5// 6// 7//\n";
  const Scratch scratch;
  const Json found = imported(scratch, scratch.write("tiles.obj", tiles) + " --tile-mm 10");
  EXPECT_EQ(found["bodies"], 2);
  EXPECT_EQ(found["hinges"], 1);
  EXPECT_EQ(found["balls"], 0);
  EXPECT_EQ(found["scale_mm"], 10);
  expect_refused("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n",
                 "is open");
}

TEST(Import, RefusesWhatIsNoModel) {
  const Scratch scratch;
  expect_refused(scratch, "", "the model is missing. Give MODEL, or --hard FILE and --soft FILE");
  expect_refused(scratch, (scratch / "none.stl").string(), "none.stl");
  expect_refused(scratch, (scratch / "none.3d").string(), "none.3d: no such file");
  expect_refused(scratch, scratch.path(), "is a folder without vertices.txt");
  expect_refused("model.doc", "x", "the ending is not that of a model");
  expect_refused("model.3mf", "no zip", "is not a 3MF file, or is damaged");
  expect_refused("model.step", "ISO-10303-20;", "is not a STEP file");
  expect_refused(
      "model.step",
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
      "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n",
      "model.step");
  expect_refused("model.glb", "glTF and no more than that", "is binary glTF of another version than 2");
  expect_refused("model.glb", std::string("glTF\2\0\0\0abcd", 12), "is damaged: it ends early");
  expect_refused("model.obj", "v 0 0 nan\n", "model.obj:1");
  expect_refused("model.obj", "v 0 0 0\nf 1 2 3\n", "model.obj:2");
  expect_refused("model.obj", "v 0 0 0\n", "has no triangles");
}

/// Replaces the size to which the one file of a zip archive unpacks, in both of its headers.
std::string with_unpacked_size(std::string zip, std::size_t bytes) {
  for (const auto& [header, field] : {std::pair{"PK\3\4", 22}, {"PK\1\2", 24}}) {
    const std::size_t at = zip.find(header) + static_cast<std::size_t>(field);
    for (std::size_t k = 0; k < 4; ++k) zip.at(at + k) = static_cast<char>(bytes >> 8 * k);
  }
  return zip;
}

constexpr std::size_t too_many_bytes = std::size_t{513} << 20;  // bytes: the limit is 512 MiB

TEST(ImportSoak, RefusesAPackageThatUnpacksToTooMuch) {
  expect_refused("model.3mf", app::zip_text({{"3D/3dmodel.model", std::string(too_many_bytes, ' ')}}),
                 "unpacks to 513 MiB");
}

TEST(Import, RefusesPackagesThatMeanHarm) {
  expect_refused("model.3mf", app::zip_text({{"../../etc/model", "x"}}),
                 "holds a file whose path leads outside, `../../etc/model`");
  expect_refused("model.3mf", app::zip_text({{"3D/other", "x"}}), "has no `3D/3dmodel.model` inside");
  expect_refused("model.3mf", with_unpacked_size(app::zip_text({{"3D/3dmodel.model", " "}}), too_many_bytes),
                 "unpacks to 513 MiB");
  expect_refused("model.3mf",
                 threemf("<object id=\"1\"><components><component objectid=\"1\"/></components></object>",
                         "<item objectid=\"1\"/>"),
                 "has an object 1 that is a part of itself");
  std::string doubled =
      "<object id=\"40\"/>";  // each object contains the next one twice: 2^30 copies of the last
  for (int id = 10; id < 40; ++id)
    doubled += fmt::format(
        "<object id=\"{0}\"><components><component objectid=\"{1}\"/><component "
        "objectid=\"{1}\"/></components></object>",
        id, id + 1);
  expect_refused("model.3mf", threemf(doubled, "<item objectid=\"10\"/>"),
                 "places objects more than 100000 times");
  expect_refused("model.3mf", threemf("", "<item objectid=\"7\"/>"), "names an object 7 that is not there");
  expect_refused(
      "model.3mf",
      threemf(
          "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"inf\"/></vertices></mesh></object>",
          "<item objectid=\"1\"/>"),
      "has a vertex whose z is not a finite number: `inf`");
}

/// Returns a glTF file of one node with the mesh of one triangle. The arguments are its JSON.
std::string glb(const std::string& nodes, const std::string& accessors, const std::string& primitive) {
  std::string json = fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{}], "meshes": [{{"primitives": [{}]}}],
          "accessors": [{}], "bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"byteLength": 36}}]}})",
      nodes, primitive, accessors);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t number) {
    const auto value = static_cast<std::uint32_t>(number);
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + 36) + word(json.size()) + "JSON" + json +
         word(36) + std::string("BIN\0", 4) + std::string(36, '\0');
}

TEST(Import, RefusesGltfThatNamesWhatIsNotThere) {
  const std::string node = R"({"mesh": 0})",
                    three = R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})",
                    corners = R"({"bufferView": 0, "componentType": 5125, "count": 3, "type": "SCALAR"})",
                    mesh = R"({"attributes": {"POSITION": 0}})";
  const auto with = [](std::string text, const std::string& old, const std::string& other) {
    return text.replace(text.find(old), old.size(), other);
  };
  expect_refused("model.glb", glb(node, with(three, "3,", "4,"), mesh), "its buffer ends early");
  expect_refused("model.glb", glb(node, with(three, "\"bufferView\": 0", "\"bufferView\": 1"), mesh),
                 "names one of `bufferViews` that is not there");
  expect_refused("model.glb", glb(node, with(three, "\"bufferView\": 0, ", ""), mesh),
                 "compressed or sparse");
  expect_refused("model.glb", glb(R"({"mesh": 0, "children": [0]})", three, mesh), "over 256 deep");
  expect_refused("model.glb", glb(R"({"mesh": 0, "scale": [1, 1]})", three, mesh), "a node's `scale`");
  expect_refused("model.glb",
                 glb(R"({"mesh": 0, "skin": 0})", three,
                     R"({"attributes": {"POSITION": 0, "JOINTS_0": 0, "WEIGHTS_0": 0}})"),
                 "names one of `skins` that is not there");
  const std::string two = with(three, "3,", "2,");
  std::string far = glb(node, two + ", " + corners, R"({"attributes": {"POSITION": 0}, "indices": 1})");
  far[far.size() - 28] = 2;  // the third corner, although only points 0 and 1 exist
  expect_refused("model.glb", far, "names a point that is not there");
  const std::string deep =
      R"({"attributes": {"POSITION": 0}, "extras": )" + std::string(100, '[') + std::string(100, ']') + "}";
  expect_refused("model.glb", glb(node, three, deep), "lists in one another, over 64 deep");
}

/// Returns the glTF file with its nodes' poses as matrices in column-major order.
std::string with_matrices(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  Json json = Json::parse(glb.substr(20, length));
  for (Json& node : json["nodes"]) {
    const auto p = node.value("translation", std::vector{0.0, 0.0, 0.0});
    const auto q = node.value("rotation", std::vector{0.0, 0.0, 0.0, 1.0});
    const Eigen::Isometry3d place =
        Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
    for (const char* key : {"translation", "rotation"}) node.erase(key);
    node["matrix"] = std::vector<double>(place.matrix().data(), place.matrix().data() + 16);
  }
  json.erase("animations");
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto words = static_cast<std::uint32_t>(text.size());
  const auto whole = static_cast<std::uint32_t>(glb.size() - length + words);
  std::string out = glb.substr(0, 20) + text + glb.substr(20 + length);
  std::memcpy(out.data() + 8, &whole, sizeof whole);
  std::memcpy(out.data() + 12, &words, sizeof words);
  return out;
}

TEST(Import, TakesPlacesOfGltfAsMatrices) {
  const Scratch scratch;
  imported(scratch, scratch.write("pair.obj", pair_of_walls()));
  const Outcome made = kinetix_opt("export " + (scratch / "out").string() + " --format glb --quiet -o " +
                                   (scratch / "made").string());
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string plain = (scratch / "made/pair.glb").string();
  const std::string matrices = scratch.write("matrices.glb", with_matrices(text_of(plain)));
  const Json by_parts = imported(scratch, plain)["hinges"], by_matrix = imported(scratch, matrices)["hinges"];
  ASSERT_EQ(by_matrix.size(), by_parts.size());
  for (const char* key : {"axis", "point_mm"})
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(by_matrix[0][key][k].get<double>(), by_parts[0][key][k].get<double>(), 1e-5) << key;
}

TEST(Import, RefusesMoreThanAMillionTriangles) {
  Polyhedron soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.triangles.assign(1'000'001, {0, 1, 2});
  expect_refused("model.stl", app::stl_text("many", soup), "has 1000001 triangles, and the limit is 1000000");
}

TEST(Import, NamesFileAndPartOfWhatIsNoSolid) {
  Polyhedron open = right();
  open.triangles.pop_back();
  const auto with = [](const Polyhedron& other) {
    return Obj().add("left", "PLA", left()).add("right", "PLA", other).add("joint", "TPU", block()).text();
  };
  expect_refused("pair.obj", with(open), "pair.obj: hard part `right` is open");
  Polyhedron inverted = right();
  for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
  expect_refused("pair.obj", with(inverted), "pair.obj: hard part `right` is inside out");
  expect_refused("pair.obj", with(moved(right(), Isometry3d(Eigen::Translation3d(3, 0, 0)))),
                 "soft part `joint` touches 1 hard part: `left`");
  expect_refused("pair.obj", with(moved(right(), Isometry3d(Eigen::Translation3d(-4, 0.2, 0)))),
                 "hard parts `left` and `right` overlap");
}

// A body's name is also a file name in the results folder.
TEST(Import, NamesThatLeadElsewhereAreRefusedInItsDesign) {
  const Scratch scratch;
  imported(scratch, scratch.write("pair.obj", pair_of_walls()));
  std::string design = text_of(scratch / "out/design.yaml");
  const std::string old = "{name: left_wall,", other = "{name: ../../left,";
  ASSERT_NE(design.find(old), std::string::npos) << design;
  scratch.write("out/design.yaml", design.replace(design.find(old), old.size(), other));
  const Outcome run = kinetix_opt("simulate " + (scratch / "out/design.yaml").string() + " --quiet -o " +
                                  (scratch / "results").string());
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("the name cannot be the name of a folder"));
  EXPECT_FALSE(fs::exists(scratch / "left.stl"));
}

TEST(Import, IsExportedAndImportedAgain) {
  const Scratch scratch;
  const Json found = imported(scratch, scratch.write("pair.obj", pair_of_walls()));
  const std::string design = (scratch / "out").string();
  for (const char* format : {"3mf", "glb", "stl"}) {
    const Outcome run =
        kinetix_opt("export " + design + " --json --format " + format + " -o " + (scratch / "made").string());
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(schema_errors(Json::parse(run.out), "print"), "");
    EXPECT_THAT(text_of(scratch / "made/print.txt"), HasSubstr("2 bodies, 1 hinges"));
  }
  for (const std::string again : {"made/pair.3mf", "made/pair.glb"}) {
    const Outcome run =
        kinetix_opt("import " + (scratch / again).string() + " --json -o " + (scratch / "again").string());
    ASSERT_EQ(run.code, 0) << run.err;
    const Json hinge = Json::parse(run.out)["hinges"][0];
    for (int k = 0; k < 3; ++k)  // a turned glTF has its quaternion in floats
      EXPECT_NEAR(hinge["axis"][k].get<double>(), found["hinges"][0]["axis"][k].get<double>(), 1e-6) << again;
    EXPECT_NEAR(hinge["point_mm"][0].get<double>(), 0, 1e-6) << again;
  }
  const Outcome refused =
      kinetix_opt("export " + design + " --format step -o " + (scratch / "step").string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("`step` only applies to sheets, and this is a design of bodies. Give stl, 3mf, glb"));
}

/// Parts of a sheet whose loops do not close are not exported folded if the drive ends before that fold.
TEST(Import, IsNotExportedFoldedWhereItsDriveEndsBefore) {
  const Scratch scratch;
  const std::string sheet = scratch.write("sheet.yaml", R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.42}, {wall: [[0, 1], [1, 1]], t: 0.47}]}
hinge: {kind: block, material: tango, gap_mm: 3}
)");
  const std::string made = scratch / "made", out = scratch / "out";
  ASSERT_EQ(kinetix_opt("export " + sheet + " --format 3mf -o " + made).code, 0);
  ASSERT_EQ(kinetix_opt("import " + made + "/sheet.3mf -o " + out).code, 0);
  std::ofstream(out + "/design.yaml", std::ios::app) << "drive: {hinge: hinge_1, angle_deg: -40}\n";
  const std::string command = "export " + out + " --format stl -o " + std::string(scratch / "parts");
  const Outcome folded = kinetix_opt(command + " --state folded --quiet");
  EXPECT_EQ(folded.code, 2);
  EXPECT_THAT(folded.err,
              HasSubstr("--state folded: it does not reach the goal of its drive: `hinge_1` turns by"));
  EXPECT_FALSE(fs::exists(scratch / "parts"));
  const Outcome flat = kinetix_opt(command);
  EXPECT_EQ(flat.code, 0) << flat.err;
  EXPECT_THAT(flat.out, HasSubstr("it does not reach the goal of its drive"));
}

TEST(Import, IsSimulatedInEquilibriumAndVerified) {
  const Scratch scratch;
  imported(scratch, scratch.write("pair.obj", pair_of_walls()) + " --material tpu95a");
  const std::string design = (scratch / "out/design.yaml").string();
  for (const char* command :
       {"simulate", "simulate --model equilibrium", "simulate --model bullet --theta-deg -20", "verify"}) {
    const Outcome run =
        kinetix_opt(std::string(command) + " " + design + " --json -o " + (scratch / "run").string());
    EXPECT_EQ(run.code, 0) << command << run.err;
    const Json result = Json::parse(run.out);
    EXPECT_EQ(schema_errors(result), "") << command;
    EXPECT_EQ(result["structure"]["bodies"][0]["name"], "left_wall");
  }
  // A hinge turned against its spring alone stores half k_turn angle^2. The spring is a block of TPU.
  const Outcome run = kinetix_opt("simulate --model equilibrium --theta-deg 10 " + design + " --json -o " +
                                  (scratch / "run").string());
  const Json result = Json::parse(run.out);
  const double k_turn = result["structure"]["hinges"][0]["k"]["turn"], angle = 20 * pi / 180;
  EXPECT_NEAR(result["metrics"]["energy_Nmm"].get<double>(), k_turn * angle * angle / 2, 1e-9 * k_turn);
  EXPECT_EQ(result["equilibrium"]["stop"], "reached");
  EXPECT_LT(result["metrics"]["exact_rms"], 1e-9);
  EXPECT_EQ(result["states"][1]["model"], "exact");
  const Outcome reported = kinetix_opt("simulate --model equilibrium --theta-deg 10 " + design + " -o " +
                                       (scratch / "run").string());
  EXPECT_THAT(reported.out, HasSubstr(fmt::format("load       {:.3g} N mm at hinge angle", -k_turn * angle)));
  EXPECT_THAT(reported.out, HasSubstr(fmt::format("energy     {:.3g} N mm", k_turn * angle * angle / 2)));
  const Outcome drives = kinetix_opt("simulate --model equilibrium --drives " + design);
  EXPECT_EQ(drives.code, 2);
  EXPECT_THAT(drives.err, HasSubstr("--drives only applies to sheets"));
  const std::string page = text_of(scratch / "run/report.html");
  EXPECT_THAT(page, HasSubstr(R"("name":"left_wall")"));
  EXPECT_THAT(page, HasSubstr(R"("meshes":{"bodies":[{"points":")"));
  EXPECT_FALSE(result.contains("meshes")) << "they are beside it";
  const Outcome coarser =
      kinetix_opt("verify " + design + " --fidelity --json -o " + (scratch / "run").string());
  EXPECT_EQ(coarser.code, 0) << coarser.err;
  EXPECT_GE(Json::parse(coarser.out)["fidelity"].size(), 3u);
}

/// No part is cut, whatever bed is given.
TEST(Import, OfPartsThatNoUsualBedHoldsSaysSoWithoutTiles) {
  const Scratch scratch;
  imported(scratch, scratch.write("pair.obj", pair_of_walls()) + " --unit m");
  const Outcome run =
      kinetix_opt("export " + (scratch / "out").string() + " --format stl -o " + (scratch / "made").string());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("larger than the bed of a usual polyjet printer"));
  EXPECT_EQ(run.out.find("--bed"), std::string::npos) << run.out;
}

/// Returns a wall from one point of the plane to another, shortened by the room of the blocks at its ends.
Polyhedron wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double room, double thickness = 0.8) {
  const Eigen::Vector2d middle = (from + to) / 2, along = to - from;
  const double half = along.norm() / 2 - room;
  return moved(box_solid(-half, half, thickness, 6),
               Eigen::Translation3d(middle.x(), middle.y(), 0) *
                   Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Eigen::Vector3d::UnitZ()));
}

TEST(Import, OfWhatCannotTurnSaysWhichHingeHoldsIt) {
  // Two walls form a bar, and a third wall beside it is joined to it by two blocks. Three hinges in a ring are rigid.
  const Scratch scratch;
  const auto at = [](double x, double y, const Polyhedron& solid) {
    return moved(solid, Isometry3d(Eigen::Translation3d(x, y, 0)));
  };
  const std::string ring = Obj()
                               .add("left", "hard", wall({-20, 0}, {0, 0}, 1))
                               .add("right", "hard", wall({0, 0}, {20, 0}, 1))
                               .add("beside", "hard", wall({-15, 5}, {15, 5}, 0, 2))
                               .add("middle", "soft", at(0, 0, box_solid(-1, 1, 0.8, 6)))
                               .add("first", "soft", at(-10, 2.2, box_solid(-0.4, 0.4, 3.6, 6)))
                               .add("last", "soft", at(10, 2.2, box_solid(-0.4, 0.4, 3.6, 6)))
                               .text();
  const Json found = imported(scratch, scratch.write("ring.obj", ring));
  EXPECT_EQ(found["mobility"]["flat"], 0);
  EXPECT_EQ(found["mobility"]["broken"], "last");
  EXPECT_THAT(found["mobility"]["why"].get<std::string>(),
              HasSubstr("rigid: every motion at rest would open a hinge"));
}

/// FDM prints films as parts of the walls: one volume in 3MF, separate files in STL.
TEST(Import, SaysHowToReadASheetWithFilmsOfTheWallsMaterial) {
  const Scratch scratch;
  const std::string design = scratch.write(
      "panel.yaml",
      "kinetix: 1\nstructure: {cells: [2, 1], cell_mm: 20, wall_mm: {thickness: 0.8, height: 6}}\n"
      "design: {theta_deg: 10}\n");
  const std::string made = (scratch / "made").string(), to = " -o " + (scratch / "again").string();
  ASSERT_EQ(kinetix_opt("export " + design + " --process fdm --hinge film --format stl,3mf -o " + made).code,
            0);
  const Outcome refused = kinetix_opt("import " + made + "/panel.3mf" + to);
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--hard hard.stl --soft soft.stl"));
  const Outcome read =
      kinetix_opt("import --hard " + made + "/hard.stl --soft " + made + "/soft.stl --json" + to);
  ASSERT_EQ(read.code, 0) << read.err;
  EXPECT_EQ(Json::parse(read.out)["hinges"].size(), 7u);
}

// Regression: the hinge of a repeated part was twice as stiff, without a message.
TEST(Import, RefusesTheSamePartTwice) {
  const std::string twice = "the same part is twice in one place";
  const auto walls = [] { return Obj().add("left wall", "PLA", left()).add("right wall", "PLA", right()); };
  expect_refused("soft.obj", walls().add("joint", "TPU", block()).add("copy", "TPU", block()).text(), twice);
  expect_refused("hard.obj", walls().add("joint", "TPU", block()).add("copy", "PLA", left()).text(), twice);
  Polyhedron nearly = block();
  for (Eigen::Vector3d& p : nearly.points) p *= 1 + 1e-8;
  expect_refused("nearly.obj", walls().add("joint", "TPU", block()).add("copy", "TPU", nearly).text(), twice);
  const Scratch scratch;
  Polyhedron both = block();
  append(block(), both);
  expect_refused(scratch,
                 "--hard " +
                     scratch.write("a.stl", app::stl_text("a",
                                                          [] {
                                                            Polyhedron hard = left();
                                                            append(right(), hard);
                                                            return hard;
                                                          }())) +
                     " --soft " + scratch.write("b.stl", app::stl_text("b", both)),
                 twice);
}

TEST(Import, OfTwoFilesTakesTheSoftPartsFromTheSecond) {
  const Scratch scratch;
  Polyhedron hard = left();
  append(right(), hard);
  const Json found = imported(scratch, "--hard " + scratch.write("a.stl", app::stl_text("a", hard)) +
                                           " --soft " + scratch.write("b.stl", app::stl_text("b", block())));
  EXPECT_EQ(found["bodies"], 2);
  EXPECT_EQ(found["hinges"][0]["name"], "hinge_1");
}

}  // namespace
}  // namespace kinetix::testing
