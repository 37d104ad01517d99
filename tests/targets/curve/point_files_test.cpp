#include "targets/curve/point_files.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "targets/outline/outline.hpp"
#include "targets/space_curve/space_goal.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/images.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::refusal;
using testing::TemporaryFolder;

/// Goal of a target with its notes.
template <class Goal>
struct Found {
  Goal goal;
  std::vector<std::string> notes;
};

/// Reads a goal from a target section, as the program does.
class Reading {
 public:
  /// @param keys of the target, in YAML
  Found<Curve> curve(const std::string& keys) const {
    std::vector<std::string> notes;
    Curve curve = read_curve(section("curve", keys, curve_target_keys()), true, notes);
    return {std::move(curve), notes};
  }
  Found<Outline> outline(const std::string& keys) const {
    std::vector<std::string> notes;
    Outline outline = read_outline(section("outline", keys, outline_target_keys()), "points", true, notes);
    return {std::move(outline), notes};
  }
  std::vector<Eigen::Vector3d> in_space(const std::string& keys) const {
    std::vector<std::string> notes;
    return read_space_goal(section("space_curve", keys, space_curve_target_keys()), true, notes).points();
  }
  /// Reads a file as a curve. @return its points
  std::vector<Vector2d> file(const std::string& name, const std::string& content) const {
    folder.write(name, content);
    return curve("points: " + name).goal.points();
  }

  const TemporaryFolder folder;

 private:
  Section section(const std::string& kind, const std::string& keys, const KeyTable& table) const {
    const std::string text = "target: {kind: " + kind + ", " + keys + "}\n";
    return {parse_document(text, folder.path("in.yaml")).required("target", ""), table};
  }
};

// mm: points that every table gives.
const std::vector<Vector2d> arch = {{0, 0}, {30.5, 25}, {70, 38}};

TEST(PointTable, TakesEverySeparatorAndDecimalCommas) {
  const Reading read;
  for (const char* table :
       {"x,z\n0,0\n30.5,25\n70,38\n", "x;z\n0,0;0,0\n30,5;25,0\n70;38\n", "x\tz\n0\t0\n30,5\t25\n70\t38\n",
        "0,0\n30.5,25\n70,38\n", "X,Y\n0,0\n30.5,25\n70,38\n", "  0 0\n 30,5   25\n70.0 38 \n",
        "x_cm;z_cm\n0;0\n3,05;2,5\n7;3,8\n"}) {
    SCOPED_TRACE(table);
    const std::vector<Vector2d> points = read.file("a.csv", table);
    ASSERT_EQ(points.size(), arch.size());
    for (std::size_t k = 0; k < arch.size(); ++k) EXPECT_LE((points[k] - arch[k]).norm(), 1e-12);
  }
}

TEST(PointTable, TakesAirfoilsInSeligsFormAndAsksForTheirChord) {
  const Reading read;
  const std::string foil = "E 63 (4.25%)\n 1.0 0.0\n 0.5 0.08\n 0.0 0.0\n 0.5 -0.03\n 0.9 -0.01\n";
  read.folder.write("foil.dat", foil);
  EXPECT_EQ(read.curve("points: foil.dat, units: 200").goal.points()[1], Vector2d(100, 16));
  EXPECT_NEAR(read.outline("points: foil.dat, units: 200").goal.at(0).x(), 200, 1e-9);
  EXPECT_THAT(refusal([&] { read.curve("points: foil.dat"); }),
              HasSubstr("target.points: the points span 1 mm. Give `units: dm` for 100 mm, or `units: mm`"));
  read.folder.write("lednicer.dat", "FOIL\n 3. 3.\n 0 0\n 0.5 0.1\n 1 0\n 0 0\n 0.5 -0.1\n 1 0\n");
  EXPECT_THAT(refusal([&] { read.curve("points: lednicer.dat, units: 200"); }),
              HasSubstr("lednicer.dat:2:1: this airfoil is in Lednicer's form"));
}

TEST(GoalPoints, AreMergedWhereTheyRepeat) {
  const Reading read;
  read.folder.write("a.csv", "x,z\n0,0\n0,0\n30.5,25\n70,38\n70,38\n");
  const auto [curve, notes] = read.curve("points: a.csv");
  EXPECT_EQ(curve.points(), arch);
  EXPECT_THAT(notes, ElementsAre("2 points equal to the one before are left out, the first in line 3"));
}

TEST(GoalPoints, LoseSpikesThatNobodyCanPrint) {
  const Reading read;
  const auto [square, notes] =
      read.outline("points: [[0, 0], [50, 0], [50.05, 0.001], [50, 0], [50, 50], [0, 50], [0, 0]]");
  EXPECT_EQ(square.points(), (std::vector<Vector2d>{{0, 0}, {50, 0}, {50, 50}, {0, 50}}));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 spike below 0.07")));
  const auto [comb, none] = read.outline("points: [[0, 0], [50, 0], [50.2, 50], [49.8, 1], [0, 50]]");
  EXPECT_EQ(comb.points().size(), 5u) << "a narrow part is no spike";
  EXPECT_THAT(none, IsEmpty());
}

TEST(GoalPoints, HaveTheSizeOfAThingUnlessTheFileNamesTheUnit) {
  const Reading read;
  EXPECT_THAT(refusal([&] { read.curve("points: [[0, 0], [0.5, 0.2], [1, 0]]"); }), HasSubstr("span 1 mm"));
  EXPECT_THAT(refusal([&] { read.curve("points: [[0, 0], [18000, 90], [36000, 0]]"); }),
              HasSubstr("span 36000 mm. Give `units: 0.006`"));
  EXPECT_EQ(read.curve("points: [[0, 0], [0.5, 0.2], [1, 0]], units: mm").goal.points()[2].x(), 1);
  EXPECT_EQ(read.curve("points: [[0, 0], [0.5, 0.2], [1, 0]], units: dm").goal.points()[2].x(), 100);
  EXPECT_EQ(read.curve("points: [[0, 0], [0.5, 0.2], [1, 0]], units: 30").goal.points()[2].x(), 30);
  EXPECT_THAT(refusal([&] { read.curve("points: [[0, 0], [5, 2], [9, 0]], units: km"); }),
              HasSubstr("`km` is not a known unit; allowed: mm, cm, dm, m, in"));
}

TEST(GoalPoints, OfAnOpenOutlineAreRefused) {
  const Reading read;
  std::string half = "[";
  for (int k = 0; k <= 20; ++k)
    half += "[" + std::to_string(50 * std::cos(k * 0.157)) + ", " + std::to_string(50 * std::sin(k * 0.157)) +
            "], ";
  EXPECT_THAT(
      refusal([&] { read.outline("points: " + half + "]"); }),
      HasSubstr("the outline is open: its ends are 100 mm apart. Close it, or repeat the first point"));
  EXPECT_EQ(read.outline("points: " + half + "[50, 0]]").goal.points().size(), 21u);
  EXPECT_EQ(read.outline("points: [[0, 0], [10, 0], [10, 90], [0, 90]]").goal.points().size(), 4u)
      << "the last side may be long";
}

TEST(GoalPoints, BecomeSmoothOnRequest) {
  const Reading read;
  std::string ring = "[";
  for (int k = 0; k < 12; ++k)
    ring += "[" + std::to_string(50 * std::cos(k * 0.5236)) + ", " +
            std::to_string(50 * std::sin(k * 0.5236)) + "], ";
  const Outline smooth = read.outline("points: " + ring + "], smooth: true").goal;
  EXPECT_EQ(smooth.points().size(), 96u);
  for (const Vector2d& p : smooth.points()) EXPECT_NEAR(p.norm(), 50, 0.1);
  const Curve curve =
      read.curve("points: [[0, 0], [30, 20], [60, 0], [90, -20], [120, 0]], smooth: true").goal;
  EXPECT_EQ(curve.points().size(), 33u);
  EXPECT_EQ(curve.at(curve.length()), Vector2d(120, 0));
  EXPECT_EQ(read.in_space("points: [[0, 0, 0], [30, 20, 5], [60, 0, 9]], smooth: true").size(), 17u);
}

TEST(GoalPoints, ThatAreNoisyAreReportedWithALengthToAverageOver) {
  const Reading read;
  std::string table;
  double exact = 0;
  for (int k = 0; k < 199; ++k)
    exact += std::hypot(0.5, 20 * (std::sin(0.03 * (k + 1)) - std::sin(0.03 * k)));
  for (int k = 0; k < 200; ++k)
    table += std::to_string(0.5 * k) + "," +
             std::to_string(20 * std::sin(0.03 * k) + (k * 7919 % 13 - 6) * (k % 2 == 0 ? 0.2 : -0.2)) + "\n";
  read.folder.write("noisy.csv", table);
  const auto [noisy, notes] = read.curve("points: noisy.csv");
  ASSERT_THAT(notes, ElementsAre(HasSubstr("the points are noisy: their line is")));
  const std::size_t at = notes[0].find("smooth: ") + 8;
  const std::string advice = notes[0].substr(at, notes[0].find('`', at) - at);
  const auto [smooth, quiet] = read.curve("points: noisy.csv, smooth: " + advice);
  EXPECT_THAT(quiet, IsEmpty());
  EXPECT_GT(noisy.length(), 1.5 * exact);
  EXPECT_NEAR(smooth.length(), exact, 0.05 * exact);
  for (const Vector2d& p : smooth.points()) EXPECT_NEAR(p.y(), 20 * std::sin(0.06 * p.x()), 3);
}

TEST(PointFiles, TakeTheOnlyPathOfADrawing) {
  const Reading read;
  const std::string svg =
      "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='50mm' viewBox='0 0 100 50'>";
  EXPECT_EQ(read.file("a.svg", svg + "<path d='M 0 50 L 30 20 70 10'/></svg>"),
            (std::vector<Vector2d>{{0, -50}, {30, -20}, {70, -10}}));
  read.folder.write("b.svg", svg + "<path d='M 0 0 H 40 V 30 H 0 Z'/></svg>");
  EXPECT_EQ(read.outline("points: b.svg").goal.area(), 1200);
  read.folder.write("two.svg", svg + "<path d='M 0 0 L 40 0 M 0 20 L 40 20'/></svg>");
  EXPECT_THAT(refusal([&] { read.curve("points: two.svg"); }), HasSubstr("several separate paths"));
  read.folder.write("tee.svg", svg + "<path d='M 0 0 L 40 0 80 0 M 40 0 L 40 20'/></svg>");
  EXPECT_THAT(refusal([&] { read.curve("points: tee.svg"); }),
              HasSubstr("more than two lines meet at [40, 0] of the drawing"));
  read.folder.write("none.svg", svg + "</svg>");
  EXPECT_THAT(refusal([&] { read.curve("points: none.svg"); }), HasSubstr("has no lines"));
  EXPECT_EQ(read.outline("points: b.svg, units: 2").goal.area(), 4800) << "a unit of the target counts";
}

TEST(PointFiles, JoinLinesOfADxfInAnyOrder) {
  const Reading read;
  const auto line = [](const char* from, const char* to) {
    return std::string("0\nLINE\n10\n") + from + "\n11\n" + to + "\n";
  };
  const std::string lines = line("70\n20\n10", "30\n21\n20") + line("0\n20\n0", "30\n21\n20");
  const std::vector<Vector2d> points =
      read.file("a.dxf", "0\nSECTION\n2\nENTITIES\n" + lines + "0\nENDSEC\n0\nEOF\n");
  EXPECT_EQ(points, (std::vector<Vector2d>{{70, 10}, {30, 20}, {0, 0}}));
}

TEST(PointFiles, TakeTheSilhouetteOfAPicture) {
  const Reading read;
  std::vector<std::string> rows(60, std::string(80, '.'));
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x)
      if (std::hypot(x + 0.5 - 40, y + 0.5 - 30) < 20) rows[y][x] = '#';
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 7; ++x) rows[y][x] = '#';
  testing::write_image(read.folder.path("disc.png"), testing::drawn(rows));
  const auto [disc, notes] = read.outline("points: disc.png, units: 2");
  EXPECT_NEAR(disc.area(), 3.1416 * 40 * 40, 100);
  EXPECT_NEAR(disc.middle().x(), 80, 0.5);
  EXPECT_NEAR(disc.middle().y(), 60, 0.5);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("without 1 smaller part and without holes")));
  EXPECT_THAT(refusal([&] { read.outline("points: disc.png"); }),
              HasSubstr("the size of a pixel is not known"));
  EXPECT_THAT(refusal([&] { read.curve("points: disc.png, units: 2"); }),
              HasSubstr("this goal is an open line"));
}

TEST(PointFiles, TakeATrackAsAMap) {
  const Reading read;
  std::string gpx = "<gpx><trk><trkseg>\n";
  for (const char* p :
       {"lat='47.0000' lon='8.0000'", "lat='47.0010' lon='8.0000'", "lat='47.0010' lon='8.0020'"})
    gpx += "<trkpt " + std::string(p) + "><ele>500</ele></trkpt>\n";
  read.folder.write("walk.gpx", gpx + "</trkseg></trk></gpx>");
  const Curve walk = read.curve("points: walk.gpx, units: 1").goal;
  EXPECT_NEAR(walk.points()[1].y(), 111.2, 0.1);
  EXPECT_NEAR(walk.points()[2].x(), 151.7, 0.1);
  EXPECT_THAT(refusal([&] { read.curve("points: walk.gpx"); }), HasSubstr("span 151"));
  EXPECT_EQ(read.in_space("points: walk.gpx, units: 1").size(), 3u);
  read.folder.write("bad.gpx", gpx + "<trkpt lat='x' lon='8'/>\n</trkseg></trk></gpx>");
  EXPECT_THAT(refusal([&] { read.curve("points: bad.gpx, units: 1"); }),
              HasSubstr("bad.gpx:5:1: `x` is not a number"));
}

}  // namespace
}  // namespace kinetix::targets
