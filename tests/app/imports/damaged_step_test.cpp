#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <atomic>
#include <cstring>
#include <random>
#include <thread>

#include "app/cad/cad_formats.hpp"
#include "app/cad/solid_bytes.hpp"
#include "app/io/reader_program.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;

/// Returns the STEP file of two cells, as the program exports it.
const std::string& two_cells() {
  static const std::string text = [] {
    const Scratch scratch;
    const std::string design = scratch.write("two_cells.yaml", R"(kinetix: 1
structure: {cells: [2, 1], cell_mm: 10, wall_mm: {thickness: 1, height: 4}}
design: {theta_deg: 20}
hinge: {kind: block, material: tango, gap_mm: 1.2}
)");
    EXPECT_EQ(kinetix_opt("export " + design + " --format step -o " + (scratch / "out").string()).code, 0);
    return text_of(scratch / "out/two_cells.step");
  }();
  return text;
}

std::string replaced_everywhere(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

void expect_damaged(const std::string& content) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("import " + scratch.write("model.step", content) + " --quiet -o " +
                                  (scratch / "out").string());
  EXPECT_EQ(run.code, 2) << run.out << run.err;
  EXPECT_THAT(run.err, HasSubstr("model.step: "));
  EXPECT_THAT(run.err, HasSubstr("damaged"));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

/// The entities name a shell, edges and directions that do not exist: the library uses null handles.
TEST(DamagedStep, IsAMessageWhereTheLibraryCrashes) {
  for (const char* word : {"EDGE_LOOP", "FACE_BOUND", "VECTOR"})
    expect_damaged(
        replaced_everywhere(two_cells(), word, std::string(word).substr(0, std::strlen(word) - 1) + "X"));
  expect_damaged(R"(ISO-10303-21;
HEADER;
ENDSEC;
DATA;
#73 = SHAPE_DEFINITION_REPRESENTATION(#74,#80);
#74 = PRODUCT_DEFINITION_SHAPE('','',#75);
#75 = PRODUCT_DEFINITION('design','',#76,#79);
#80 = ADVANCED_BREP_SHAPE_REPRESENTATION('',(#11,#81),#631);
#82 = CLOSED_SHELL('',(#83,#282,#357,#404,#519,#545,#571,#598,#624));
#192 = PLANE('',#193);
#193 = AXIS2_PLACEMENT_3D('',#194,#195,#196);
#571 = ADVANCED_FACE('',(#572),#192,.T.);
)");
}

void expect_read_or_refused(int files) {
  const Scratch scratch;
  std::mt19937 chance(7);
  for (int k = 0; k < files; ++k) {
    std::string text = two_cells();
    text[chance() % text.size()] ^= static_cast<char>(1 << chance() % 7);
    const std::string file = scratch.write("model.step", text);
    try {
      app::cad::solids_of_step(file);
    } catch (const InvalidInput& e) {
      EXPECT_THAT(e.reason(), HasSubstr("damaged"));
    }
  }
}

TEST(DamagedStep, IsReadOrRefusedWithAnyBitFlipped) { expect_read_or_refused(6); }

TEST(DamagedStepSoak, IsReadOrRefusedWithAnyOfManyBitsFlipped) { expect_read_or_refused(24); }

/// A studio or a Python session reads files while other threads work.
TEST(DamagedStep, IsReadWhileThreadsWork) {
  const Scratch scratch;
  const std::string good = scratch.write("good.step", two_cells()),
                    bad =
                        scratch.write("bad.step", replaced_everywhere(two_cells(), "EDGE_LOOP", "EDGE_LOOX"));
  const std::size_t solids = app::cad::solids_of_step(good).size();
  std::vector<std::thread> readers;
  std::atomic<int> refused = 0, read = 0;
  for (int k = 0; k < 4; ++k)
    readers.emplace_back([&, k] {
      try {
        read += app::cad::solids_of_step(k % 2 == 0 ? good : bad).size() == solids;
      } catch (const InvalidInput&) {
        ++refused;
      }
    });
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(read, 2);
  EXPECT_EQ(refused, 2);
}

TEST(ReaderProgram, IsStoppedAtItsLimits) {
  const Scratch scratch;
  const std::string good = scratch.write("good.step", two_cells());
  const auto reason = [&](const std::string& file, const app::ReaderLimits& limits) {
    try {
      app::run_reader("kinetix-read-step", {file}, limits);
    } catch (const InvalidInput& e) {
      return e.reason();
    }
    return std::string("read");
  };
  EXPECT_EQ(reason(good, {60, 4ul << 30}), "read");
  EXPECT_THAT(reason("/dev/zero", {1, 4ul << 30}), HasSubstr("it was not read within 1 s"));
#ifndef __SANITIZE_ADDRESS__  // the sanitizer reserves more addresses than any limit
  EXPECT_THAT(reason(good, {60, 1ul << 20}), HasSubstr("takes more than 1 MiB of memory"));
#endif
  EXPECT_THAT(reason((scratch / "none.step").string(), {60, 4ul << 30}), HasSubstr("damaged"));
}

TEST(ReaderProgram, ThatIsMissingIsNoFaultOfTheFile) {
  try {
    app::run_reader("kinetix-read-nothing", {"a"}, {1, 1ul << 30});
    ADD_FAILURE() << "not refused";
  } catch (const InvalidInput&) {
    ADD_FAILURE() << "the file is not to blame";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("kinetix-read-nothing, a part of this program"));
  }
}

/// A reader that crashes while it writes sends damaged bytes.
TEST(SolidBytes, AreCheckedWhenTheyAreRead) {
  const app::cad::FoundSolid solid{"a", "#ff0000", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const std::string bytes = app::cad::to_bytes({solid, solid});
  const auto back = app::cad::read_solids(bytes);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[1].name, "a");
  EXPECT_EQ(back[1].colour, "#ff0000");
  EXPECT_EQ(back[1].points, solid.points);
  EXPECT_EQ(back[1].triangles, solid.triangles);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(app::cad::read_solids(bytes.substr(0, size)), std::runtime_error) << size;
  std::mt19937 chance(3);
  for (int k = 0; k < 2000; ++k) {
    std::string other = bytes;
    other[chance() % other.size()] ^= static_cast<char>(1 << chance() % 8);
    try {
      for (const app::cad::FoundSolid& read : app::cad::read_solids(other))
        for (const auto& triangle : read.triangles)
          for (const int corner : triangle) ASSERT_LT(static_cast<std::size_t>(corner), read.points.size());
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace kinetix::testing
