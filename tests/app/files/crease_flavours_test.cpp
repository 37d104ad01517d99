#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "app/files/origami_file.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/app/files/crease_text.hpp"
#include "tests/support/random_mesh.hpp"

namespace kinetix::app {
namespace {

using ::testing::AllOf;
using testing::crease_text;
using testing::CreaseText;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

model::QuadMesh random_sheet(int columns, int rows, unsigned seed) {
  std::mt19937 random(seed);
  return testing::random_mesh(columns, rows, 0.1, random).mesh;
}

/// A Miura sheet of parallelograms with sides 1.
CreaseText miura_text(int columns, int rows, double angle_deg = 65) {
  return crease_text(model::march(model::miura(columns, rows, angle_deg * radians_per_degree, 1)).mesh);
}

/// Returns all multipliers in the order of their sizes, and their number of valleys.
std::pair<std::vector<double>, int> multipliers(const model::QuadMesh& m) {
  std::vector<double> all = m.rising;
  all.insert(all.end(), m.level.begin(), m.level.end());
  std::sort(all.begin(), all.end());
  return {all, static_cast<int>(std::count_if(all.begin(), all.end(), [](double c) { return c > 0; }))};
}

/// Checks that two files have the same sheet, wherever it starts.
void expect_same(const OrigamiFile& found, const OrigamiFile& wanted) {
  const auto [a, valleys] = multipliers(found.mesh);
  const auto [b, wanted_valleys] = multipliers(wanted.mesh);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(valleys, wanted_valleys);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-5);
  EXPECT_NEAR(mean_edge(found.mesh), mean_edge(wanted.mesh), 1e-6);
  EXPECT_LE(fold_gap(found.mesh, 0.8), 1e-11);
}

void expect_refusal(const std::string& text, const std::string& file,
                    const ::testing::Matcher<std::string>& reason) {
  try {
    parse_origami(text, file);
    ADD_FAILURE() << "not refused";
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.reason(), reason);
    EXPECT_EQ(e.place().file, file);
  }
}

TEST(CreaseFlavours, FoldDrawingAndCpGiveOneSheet) {
  const CreaseText text = crease_text(random_sheet(4, 3, 7));
  const OrigamiFile fold = parse_origami(text.fold(), "a.fold");
  EXPECT_THAT(fold.notes, IsEmpty());
  expect_same(parse_origami(text.svg(), "a.SVG"), fold);
  expect_same(parse_origami(text.cp(), "a.cp"), fold);
}

TEST(CreaseFlavours, FacesFollowFromEdgesAndEdgesFromFaces) {
  CreaseText text = crease_text(random_sheet(4, 3, 7));
  const OrigamiFile whole = parse_origami(text.fold(), "a.fold");
  text.faces.clear();
  expect_same(parse_origami(text.fold(), "a.fold"), whole);
  // A Miura sheet folds in one way, so its faces alone are enough up to turning it over.
  text = miura_text(4, 3);
  text.edges.clear();
  const OrigamiFile bare = parse_origami(text.fold(), "a.fold");
  ASSERT_EQ(bare.notes.size(), 1u);
  EXPECT_THAT(bare.notes[0], HasSubstr("up to turning the sheet over"));
}

TEST(CreaseFlavours, LieInAnyPlane) {
  CreaseText text = crease_text(random_sheet(4, 3, 7));
  const OrigamiFile flat = parse_origami(text.fold(), "a.fold");
  const auto placed = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& from) {
    for (std::size_t v = 0; v < text.points.size(); ++v) {
      const Eigen::Vector3d p = from + text.vertices[v].x() * x + text.vertices[v].y() * y;
      text.points[v] = fmt::format("[{:.12f}, {:.12f}, {:.12f}]", p.x(), p.y(), p.z());
    }
    return text.fold();
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  expect_same(parse_origami(placed(x, y, 1e-9 * z), "a.fold"), flat);
  expect_same(parse_origami(placed(x, z, 3 * y), "a.fold"), flat);
  expect_same(parse_origami(placed(z, x, {1, 2, 3}), "a.fold"), flat);
  const Eigen::Vector3d tilted = Eigen::Vector3d(1, 2, 3).normalized();
  const Eigen::Vector3d along = tilted.unitOrthogonal();
  expect_same(parse_origami(placed(along, tilted.cross(along), {1, 2, 3}), "a.fold"), flat);
  text.points[7] = "[1, 1, 0.5]";
  expect_refusal(text.fold(), "a.fold", HasSubstr("not in a plane: this is a folded form"));
}

TEST(CreaseFlavours, FacetsMergeAcrossFlatEdges) {
  for (const char* flat : {"F", "J", "f"}) {
    CreaseText text = crease_text(random_sheet(4, 3, 7));
    const OrigamiFile whole = parse_origami(text.fold(), "a.fold");
    std::vector<std::vector<int>> triangles;
    for (const auto& face : text.faces) {
      text.edges.push_back({face[0], face[2], flat});
      triangles.push_back({face[0], face[1], face[2]});
      triangles.push_back({face[0], face[2], face[3]});
    }
    text.faces = triangles;
    expect_same(parse_origami(text.fold(), "a.fold"), whole);
  }
}

TEST(CreaseFlavours, StrongerLettersOfDoubledEdgesCount) {
  CreaseText text = crease_text(random_sheet(4, 3, 7));
  const OrigamiFile whole = parse_origami(text.fold(), "a.fold");
  const auto edges = text.edges;
  for (const auto& [from, to, letter] : edges) {
    text.edges.push_back({to, from, "F"});
    text.edges.insert(text.edges.begin(), CreaseText::Edge{from, to, "U"});
  }
  expect_same(parse_origami(text.fold(), "a.fold"), whole);
  text.edges = edges;
  const auto mountain =
      std::find_if(edges.begin(), edges.end(), [](const auto& e) { return e.letter == "M"; });
  text.edges.push_back({mountain->from, mountain->to, "V"});
  expect_refusal(
      text.fold(), "a.fold",
      HasSubstr(fmt::format("the crease from vertex {} to vertex {} is both mountain and valley",
                            std::min(mountain->from, mountain->to), std::max(mountain->from, mountain->to))));
}

// A random sheet folds in one way with its angles, apart from turning it over.
TEST(CreaseFlavours, MissingLettersFollowFromTheAngles) {
  CreaseText text = crease_text(random_sheet(5, 4, 11));
  const OrigamiFile whole = parse_origami(text.fold(), "a.fold");
  int kept = 0;
  text.letter("U", [&](const auto& edge) { return edge.letter != "B" && ++kept % 3 != 0; });
  const OrigamiFile solved = parse_origami(text.fold(), "a.fold");
  expect_same(solved, whole);
  ASSERT_EQ(solved.notes.size(), 1u);
  EXPECT_THAT(solved.notes[0], HasSubstr("follows from the angles and the other creases"));
  expect_same(parse_origami(text.svg(), "a.svg"), whole);
}

TEST(CreaseFlavours, LettersThatDoNotFollowAreAskedFor) {
  model::MarchData data = model::miura(2, 2, 65 * radians_per_degree, 1);
  data.level[0] *= 1.5;
  CreaseText text = crease_text(model::march(data).mesh);
  text.letter("U", [](const auto& edge) { return edge.letter != "B"; });
  expect_refusal(
      text.fold(), "a.fold",
      AllOf(HasSubstr("fold in several ways"), HasSubstr("such as the crease from vertex 4 to vertex")));
}

TEST(CreaseFlavours, LettersThatContradictAreRefused) {
  CreaseText text = miura_text(4, 4);
  const auto inner =
      std::find_if(text.edges.begin(), text.edges.end(), [](const auto& e) { return e.letter != "B"; });
  inner->letter = inner->letter == "M" ? "V" : "M";
  expect_refusal(text.fold(), "a.fold", HasSubstr(" does not fold"));
}

/// Moves each vertex by up to `by` mean edges.
CreaseText noisy(CreaseText text, double by) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-by, by);
  for (std::size_t v = 0; v < text.vertices.size(); ++v) {
    text.vertices[v] += Eigen::Vector2d(unit(random), unit(random));
    text.points[v] = fmt::format("[{:.9f}, {:.9f}]", text.vertices[v].x(), text.vertices[v].y());
  }
  return text;
}

TEST(CreaseFlavours, RoundingIsMendedUpToThreePercent) {
  const CreaseText text = miura_text(6, 5);
  const OrigamiFile mended = parse_origami(noisy(text, 0.015).fold(), "a.fold");
  EXPECT_GT(mended.moved, 1e-3);
  EXPECT_LE(mended.moved, 0.03);
  ASSERT_EQ(mended.notes.size(), 1u);
  EXPECT_THAT(mended.notes[0], HasSubstr("% of the mean edge, so that the pattern folds flat"));
  EXPECT_LE(fold_gap(mended.mesh, 0.8), 1e-10);
  expect_refusal(noisy(text, 0.15).fold(), "a.fold", HasSubstr("3 % of the mean edge"));
}

TEST(CreaseFlavours, FramesAreSearchedForTheFlatPattern) {
  const CreaseText text = miura_text(3, 3);
  const std::string pattern = text.fold(),
                    pose =
                        "\"vertices_coords\": [[0, 0, 1], [1, 0, 0], [0, 1, 0], [1, 1, 5]], "
                        "\"faces_vertices\": [[0, 1, 3, 2]]";
  const std::string file =
      "{" + pose + ", \"frame_classes\": [\"foldedForm\"], \"file_frames\": [" + pattern + "]}";
  expect_same(parse_origami(file, "a.fold"), parse_origami(pattern, "a.fold"));
}

TEST(CreaseFlavours, DrawnLinesCrossAndBreakAnywhere) {
  // A Miura sheet whose level creases are whole lines, and whose boundary is one path.
  CreaseText text = miura_text(4, 3);
  const OrigamiFile whole = parse_origami(text.fold(), "a.fold");
  const Eigen::Vector2d middle = (text.vertices[0] + text.vertices[1]) / 2;
  text.vertices.push_back(middle);
  text.edges.push_back({0, static_cast<int>(text.vertices.size()) - 1, "B"});
  expect_same(parse_origami(text.svg(), "a.svg"), whole);
  const OrigamiFile in_cm =
      parse_origami(text.svg("width='10cm' height='10cm' viewBox='0 0 10 10'"), "a.svg");
  ASSERT_TRUE(in_cm.unit_mm);
  EXPECT_NEAR(*in_cm.unit_mm, 10, 1e-9);
  EXPECT_FALSE(whole.unit_mm);
}

TEST(CreaseFlavours, DrawnEndsThatMissAreJoinedAndReported) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.004, 0.004);
  CreaseText text = miura_text(4, 3);
  CreaseText loose = text;
  loose.vertices.clear();
  for (auto& [from, to, letter] : loose.edges)
    for (int* end : {&from, &to}) {
      loose.vertices.push_back(text.vertices[*end] + Eigen::Vector2d(unit(random), unit(random)));
      *end = static_cast<int>(loose.vertices.size()) - 1;
    }
  const OrigamiFile joined = parse_origami(loose.svg(), "a.svg");
  ASSERT_GE(joined.notes.size(), 1u);
  EXPECT_THAT(joined.notes[0], HasSubstr("apart were joined"));
  EXPECT_EQ(joined.mesh.columns * joined.mesh.rows, 12);
}

TEST(CreaseFlavours, OtherPatternsAreRefusedInOneMessage) {
  CreaseText text = miura_text(3, 3);
  const std::vector<int> face = text.faces[4];
  const CreaseText whole = text;
  text.edges.push_back({face[0], face[2], "V"});
  text.faces.clear();
  expect_refusal(text.fold(), "a.fold",
                 AllOf(HasSubstr("of 10 faces it has 2 faces of 3 corners, 2 inner vertices of 5 creases"),
                       HasSubstr("assign \"F\" to their common edges")));
  text = whole;
  text.letter("C", [&](const auto& edge) { return edge.from == face[0] && edge.to == face[1]; });
  expect_refusal(
      text.svg(), "a.svg",
      AllOf(HasSubstr("1 cut or boundary line with faces on both sides"), HasSubstr("Remove cuts")));
  text = whole;
  text.faces.pop_back();
  expect_refusal(text.fold(), "a.fold", HasSubstr("faces are missing or overlap"));
}

TEST(CreaseFlavours, WrongLinesAreNamedByTheirPlace) {
  expect_refusal("2 0 0 1 1\n2 0 0 1\n", "a.cp", HasSubstr("the line has 4 numbers"));
  expect_refusal("2 0 0 one 1\n", "a.cp", HasSubstr("not a line of a crease pattern"));
  expect_refusal("\n", "a.cp", HasSubstr("it has no lines"));
  const auto svg = [](const std::string& content) {
    return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'>" + content + "</svg>";
  };
  expect_refusal(svg("<line x2='1' y2='1' stroke='#ff8000'/>"), "a.svg",
                 HasSubstr("do not have the colour #ff8000"));
  expect_refusal(svg("<line x2='1' y2='1' stroke='gray'/>"), "a.svg",
                 HasSubstr("no creases by their colours"));
  expect_refusal(svg("<circle r='3' stroke='red'/>"), "a.svg", HasSubstr("a curve (circle) is not a crease"));
  expect_refusal(svg("<line x2='1' y2='1' stroke='black'/>"), "a.svg",
                 HasSubstr("no creases by their colours"));
}

TEST(CreaseFlavours, TailsAndPiecesAreNamed) {
  CreaseText text = miura_text(3, 3);
  text.faces.clear();
  const int inner = static_cast<int>(text.vertices.size());
  const Eigen::Vector2d p = 0.6 * text.vertices[0] + 0.4 * text.vertices[5];
  text.vertices.push_back(p);
  text.points.push_back(fmt::format("[{:.9f}, {:.9f}]", p.x(), p.y()));
  text.edges.push_back({5, inner, "M"});
  expect_refusal(text.fold(), "a.fold", HasSubstr("has no face on either side"));
  text.edges.back().letter = "F";
  EXPECT_NO_THROW(parse_origami(text.fold(), "a.fold"));
}

}  // namespace
}  // namespace kinetix::app
