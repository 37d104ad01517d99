#include "targets/curve/read_curve.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>

#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::targets {
namespace {

using testing::BadInput;
using testing::expect_refused;
using ::testing::HasSubstr;
using testing::refusal;
using testing::TemporaryFolder;

Curve read_inline(const std::string& list) {
  return read_curve(parse_document("points: " + list + "\n", "in.yaml").required("points", ""));
}

TEST(ReadCurve, TakesPointsFromAListOrFromAFileBesideTheDocument) {
  TemporaryFolder folder;
  folder.write("rib.csv", "x,z\n0,0\n10,2.5\n20,-1e-3\n");
  const auto document = folder.write("in.yaml", "points: rib.csv\n");
  const Curve curve = read_curve(read_document(document).required("points", ""));
  const Curve same = read_inline("[[0, 0], [10, 2.5], [20, -1e-3]]");
  EXPECT_EQ(curve.points(), same.points());
  EXPECT_EQ(curve.points()[2], Eigen::Vector2d(20, -1e-3));
}

TEST(ReadCurve, ToleratesCommentsBlankLinesSpacesCrlfAndByteOrderMark) {
  TemporaryFolder folder;
  const auto file = folder.write(
      "a.csv",
      "\xEF\xBB\xBF# a rib, caf\xC3\xA9\r\n\r\n X [mm] , z_mm\r\n 0 , +0\r\n\t\r\n  # end\r\n1,\t2\r\n3,4");
  EXPECT_EQ(read_curve_csv(file).points(), (std::vector<Eigen::Vector2d>{{0, 0}, {1, 2}, {3, 4}}));
}

TEST(ReadCurve, NamesLineAndColumnOfTheCsv) {
  TemporaryFolder folder;
  const std::vector<BadInput> cases = {
      {"x_km,z_km\n0,0\n", 1, 1, "", {"unknown unit", "mm, cm, dm, m, in"}},
      {"# top\nx_mm,z_cm\n0,0\n", 2, 6, "", {"different units"}},
      {"x,w\n0,0\n", 1, 3, "", {"`w` is not the name `z`", "header `x,z`"}},
      {"z,x\n0,0\n", 1, 1, "", {"`z` is not the name `x`"}},
      {"x,y,z\n0,0,0\n", 1, 1, "", {"not a header of two columns"}},
      {"lon;lat\n0;0\n", 1, 1, "", {"not a point or a header of two columns", "`x,z`"}},
      {"E63\nE64\n0 0\n", 2, 1, "", {"not a point or a header"}},
      {"x z\nx z\n0 0\n", 2, 1, "", {"second header"}},
      {"x,z\n0,0\n1,abc\n", 3, 3, "", {"`abc` is not a number", "in mm"}},
      {"x,z\n0,0\n1 cm,2\n", 3, 1, "", {"has a unit", "in mm"}},
      {"x,z\n0,0\n1,\n", 3, 3, "", {"is empty", "a number from -1000000 to 1000000, in mm"}},
      {"x,z\n0,0\n1\n", 3, 1, "", {"has 1 column", "Give two"}},
      {"x,z\n0,0,\n", 2, 1, "", {"has 3 columns", "with decimal points, or with `;` between columns"}},
      {"0 0\n1;1\n", 2, 1, "", {"separated as in the first line"}},
      {"x,z\n0,nan\n", 2, 3, "", {"not a finite number"}},
      {"x,z\n0,1e300\n", 2, 3, "", {"out of range", "1000000"}},
      {"x,z\n0,1e999\n", 2, 3, "", {"too large for a number"}},
      {"x,z\n0,0\n1,1\n2,0\n0,0\n", 5, 1, "", {"closed", "open curve"}},
      {"x,z\n0,0\n1,1\n2,0\n0,1e-15\n", 5, 1, "", {"closed", "open curve"}},
      {"x,z\n0,0\n2,0\n1,1\n1,-1\n", 4, 1, "", {"crosses itself", "segment 1-2", "segment 3-4"}},
      {"x,z\n0,0\n2,0\n1,0\n", 3, 1, "", {"turns back", "point 2"}},
      {"x,z\n0,0\n1,1\n", 0, 0, "", {"at least 3 points", "has 2"}},
      {"x,z\n", 0, 0, "", {"at least 3 points", "has 0"}},
      {"", 0, 0, "", {"no points", "header `x,z`"}},
      {"x_m,z_m\n0,0\n1,2000\n2,0\n", 3, 1, "", {"more than a kilometre from 0"}},
      {"x,z\n0,\xE9\n", 2, 3, "", {"UTF-8"}},
  };
  const std::string file = folder.path("a.csv");
  for (const BadInput& bad : cases) {
    folder.write("a.csv", bad.text);
    expect_refused(bad, file, [&] { read_curve_csv(file); });
  }
}

TEST(ReadCurve, NamesThePlaceInTheDocument) {
  const std::vector<BadInput> cases = {
      {"[[0, 0], [1, x], [2, 0]]", 1, 22, "points[1][1]", {"`x` is not a number"}},
      {"[[0, 0], [1], [2, 0]]", 1, 18, "points[1]", {"has 1 entry", "[x, z], in mm"}},
      {"[[0, 0], [1, 1]]", 1, 9, "points", {"at least 3 points"}},
      {"[0, 1]", 1, 10, "points[0]", {"[x, z], in mm"}},
      {"{x: 1}", 1, 9, "points", {"the path of a CSV, SVG, DXF, GPX or DAT file, or a list"}},
      {"none.csv", 1, 9, "points", {"none.csv: no such file"}},
      {"/", 1, 9, "points", {"folder"}},
      {"/dev/zero", 1, 9, "points", {"device"}},
  };
  for (const BadInput& bad : cases) expect_refused(bad, "in.yaml", [&] { read_inline(bad.text); });
}

TEST(ReadCurve, RefusesTooMuch) {
  TemporaryFolder folder;
  const auto file = folder.write("big.csv", "x,z\n");
  std::filesystem::resize_file(file, 100 << 20);
  EXPECT_THAT(refusal([&] { read_curve_csv(file); }), HasSubstr("100 MiB; at most 16 MiB"));
  std::string rows = "x,z\n";
  for (int k = 0; k <= 200'000; ++k) rows += std::to_string(k) + ",0\n";
  folder.write("long.csv", rows);
  EXPECT_THAT(refusal([&] { read_curve_csv(folder.path("long.csv")); }),
              HasSubstr("long.csv:200002:1: there are too many points. Give at most 200000"));
}

TEST(ReadCurve, ReadsTheLongestStraightLineUprightAsFastAsLyingDown) {
  TemporaryFolder folder;
  std::string rows = "x,z\n";
  for (int k = 0; k < 200'000; ++k) rows += "0," + std::to_string(k) + "\n";
  EXPECT_EQ(read_curve_csv(folder.write("long.csv", rows)).length(), 199'999);
}

TEST(ReadCurve, SurvivesRandomMutationsOfAValidCsv) {
  TemporaryFolder folder;
  const std::string valid = "# rib\nx,z\n0,0\n10,2.5\n20,-1e-3\n30, 4\n";
  std::mt19937 random(99);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  for (int round = 0; round < 2000; ++round) {
    std::string text = valid;
    for (std::size_t n = 1 + below(4); n > 0; --n)
      text[below(text.size())] = below(2) ? static_cast<char>(below(256)) : ",;.-+e0\n\r#x "[below(12)];
    const auto file = folder.write("m.csv", text);
    try {
      const Curve curve = read_curve_csv(file);
      for (const auto& point : curve.points()) EXPECT_TRUE(point.allFinite());
    } catch (const InvalidInput&) {
    }
  }
}

}  // namespace
}  // namespace kinetix::targets
