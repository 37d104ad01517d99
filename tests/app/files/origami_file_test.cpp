#include "app/files/origami_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "model/closure/mobility.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/random_mesh.hpp"

namespace kinetix::app {
namespace {

using ::testing::HasSubstr;

/// Writes a mesh as a FOLD file with `digits` digits; its vertices are numbered backwards.
std::string fold_text(const model::QuadMesh& m, int digits) {
  const auto number = [&](int i, int j) { return static_cast<int>(m.vertices.size() - 1 - m.vertex(i, j)); };
  std::vector<std::string> points(m.vertices.size());
  std::string faces, edges, words;
  const auto edge = [&](int i, int j, int to_i, int to_j, double c) {
    edges += fmt::format("{}[{}, {}]", edges.empty() ? "" : ", ", number(i, j), number(to_i, to_j));
    words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", c > 0 ? "V" : c < 0 ? "M" : "B");
  };
  for (int j = 0; j <= m.rows; ++j)
    for (int i = 0; i <= m.columns; ++i) {
      points[number(i, j)] =
          fmt::format("[{:.{}f}, {:.{}f}]", m.at(i, j).x(), digits, m.at(i, j).y(), digits);
      if (i < m.columns) edge(i, j, i + 1, j, j > 0 && j < m.rows ? m.level[m.level_crease(i, j)] : 0);
      if (j < m.rows) edge(i, j, i, j + 1, i > 0 && i < m.columns ? m.rising[m.rising_crease(i, j)] : 0);
      if (i < m.columns && j < m.rows)
        faces += fmt::format("{}[{}, {}, {}, {}]", faces.empty() ? "" : ", ", number(i, j), number(i + 1, j),
                             number(i + 1, j + 1), number(i, j + 1));
    }
  return fmt::format(
      "{{\"file_spec\": 1.1, \"vertices_coords\": [{}], \"faces_vertices\": [{}], \"edges_vertices\": [{}], "
      "\"edges_assignment\": [{}]}}",
      fmt::join(points, ", "), faces, edges, words);
}

model::QuadMesh mesh_of(int columns, int rows, unsigned seed) {
  std::mt19937 random(seed);
  return testing::random_mesh(columns, rows, 0.1, random).mesh;
}

TEST(OrigamiFile, OfSixDigitsBecomesASheetThatClosesToTheLast) {
  for (const auto& [columns, rows] : {std::pair(2, 2), {5, 4}, {8, 8}}) {
    const OrigamiFile pattern = parse_origami(fold_text(mesh_of(columns, rows, 3), 6), "a.fold");
    EXPECT_LE(pattern.moved, 1e-4);
    const model::PlanarStructure s = origami_sheet(tilted(pattern, 0.8), {}).structure;
    EXPECT_EQ(s.graph.vertices.size(), 4u * columns * rows);
    const model::ExactMotion motion = exact_motion(s);
    ASSERT_TRUE(motion) << motion.why;
    EXPECT_EQ(motion.name, "creased");
    for (const double theta : {-0.7, 0.3, 0.9}) {
      EXPECT_LE(hinge_gaps(s, motion.at(theta)).max, 1e-11);
      EXPECT_LE(hinge_gaps(s, motion.at(theta)).axis_max, 1e-11);
    }
    EXPECT_EQ(null_space(s, motion.at(0.4)).dofs(), 1);
  }
}

// Finds all multipliers up to a common factor, which a crease pattern does not determine.
TEST(OrigamiFile, FindsTheMultipliersThatThePatternWasDrawnWith) {
  const model::QuadMesh mesh = mesh_of(4, 3, 5);
  const OrigamiFile pattern = parse_origami(fold_text(mesh, 12), "a.fold");
  const auto sorted = [](const model::QuadMesh& m) {
    std::vector<double> all = m.rising;
    all.insert(all.end(), m.level.begin(), m.level.end());
    std::sort(all.begin(), all.end());
    const double most = std::max(all.back(), -all.front());
    for (double& c : all) c /= most;
    return all;
  };
  const std::vector<double> found = sorted(pattern.mesh), drawn = sorted(mesh);
  ASSERT_EQ(found.size(), drawn.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], drawn[k], 1e-9);
}

void expect_refused(const std::string& text, const std::string& what) {
  try {
    parse_origami(text, "a.fold");
    ADD_FAILURE() << "not refused: " << what;
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.reason(), HasSubstr(what));
    EXPECT_EQ(e.place().file, "a.fold");
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return text;
}

TEST(OrigamiFile, SaysWhichVertexFaceOrEdgeIsWrong) {
  model::QuadMesh mesh = mesh_of(3, 3, 2);
  const std::string good = fold_text(mesh, 9);
  expect_refused("{", "is not JSON");
  expect_refused("{\"vertices_coords\": [[1e999, 0]]}", "too large");
  expect_refused("[]", "its JSON is not an object");
  expect_refused(replaced(good, "edges_vertices", "edges"), "it has no `edges_vertices`");
  expect_refused(replaced(good, "[15, 14, 10, 11]", "[15, 14, 10]"), "faces_vertices covers ");
  expect_refused(replaced(good, "[15, 14, 10, 11]", "[15, 14, 10, 99]"), "face 0 refers to a missing vertex");
  mesh.at(1, 1) += Eigen::Vector2d(0.15, 0.08);
  expect_refused(fold_text(mesh, 9),
                 "vertex 9 is not flat-foldable: opposite angles between its creases add up to 185.832 deg");
  std::string unlike = good;
  const std::size_t at = unlike.find("edges_assignment");
  for (std::size_t k = at; k < unlike.size(); ++k)
    if (unlike[k] == 'M') unlike[k] = 'V';
  expect_refused(unlike, "does not fold. Give its opposite creases");
  expect_refused(replaced(good, "\"V\"", "\"X\""), "has the letter `X`");
}

TEST(OrigamiFile, SaysWhereMountainAndValleyMustChangePlaces) {
  std::string text = fold_text(mesh_of(2, 2, 4), 9);
  std::vector<std::size_t> inner;  // vertices below, left of, right of and above the inner one
  for (std::size_t k = text.find("edges_assignment"); k < text.size(); ++k)
    if (text[k] == 'M' || text[k] == 'V') inner.push_back(k);
  ASSERT_EQ(inner.size(), 4u);
  const bool level = text[inner[1]] != text[inner[2]];
  std::swap(text[inner[level ? 1 : 0]], text[inner[level ? 2 : 3]]);
  expect_refused(text, "vertex 4 does not fold. Exchange the mountain and the valley of its unequal pair");
}

TEST(OrigamiFile, KnowsItsUnit) {
  const std::string good = fold_text(mesh_of(3, 3, 2), 9), version = "\"file_spec\": 1.1";
  const auto unit = [&](const std::string& word) {
    return parse_origami(replaced(good, version, version + ", \"frame_unit\": \"" + word + "\""), "a.fold")
        .unit_mm;
  };
  EXPECT_EQ(parse_origami(good, "a.fold").unit_mm, std::nullopt);
  EXPECT_EQ(unit("unit"), std::nullopt);
  EXPECT_EQ(unit("mm"), 1);
  EXPECT_EQ(unit("in"), 25.4);
  expect_refused(replaced(good, version, version + ", \"frame_unit\": \"nm\""), "the unit `nm`");
}

/// A frame inherits from its parent the keys that it does not give itself.
TEST(OrigamiFile, FramesInheritFromTheirParents) {
  const std::string good = fold_text(mesh_of(3, 3, 2), 9);
  const std::string body = good.substr(good.find('{') + 1);
  const auto file = [&](const std::string& top, const std::string& first) {
    return "{" + top + "\"file_frames\": [{" + first + body.substr(0, body.rfind('}')) + "}]}";
  };
  const auto unit = [&](const std::string& top, const std::string& first) {
    return parse_origami(file(top, first), "a.fold").unit_mm;
  };
  const std::string cm = "\"frame_unit\": \"cm\", ",
                    inherits = "\"frame_inherit\": true, \"frame_parent\": 0, ";
  EXPECT_EQ(unit(cm, ""), std::nullopt);
  EXPECT_EQ(unit(cm, inherits), 10);
  EXPECT_EQ(unit(cm, inherits + "\"frame_unit\": \"mm\", "), 1);
  expect_refused(file("", "\"frame_inherit\": true, \"frame_parent\": 1, "),
                 "frame 1 inherits from a missing frame, from itself");
  expect_refused(file("", "\"frame_inherit\": true, \"frame_parent\": 7, "),
                 "frame 1 inherits from a missing frame");
}

TEST(OrigamiFile, IsRefusedWhereItIsNestedTooDeep) {
  const auto nested = [](int depth, const std::string& open, const std::string& close) {
    std::string text;
    for (int k = 0; k < depth; ++k) text += open;
    text += "1";
    for (int k = 0; k < depth; ++k) text += close;
    return text;
  };
  const std::string too_deep = "the lists are nested too deep. Give a FOLD file of at most 64 levels";
  for (const int depth : {64, 100'000, 1'000'000}) {  // plus one level for the file itself
    expect_refused("{\"a\": " + nested(depth, "[", "]") + "}", too_deep);
    expect_refused("{\"a\": " + nested(depth, "{\"a\": ", "}") + "}", too_deep);
    expect_refused("{\"a\": " + nested(depth / 2, "[{\"a\": ", "}]") + "}", too_deep);
    expect_refused("{\"a\": " + std::string(static_cast<std::size_t>(depth), '['), too_deep);
  }
  expect_refused("{\"a\": " + nested(63, "[", "]") + "}", "it has no `vertices_coords`");
  const std::string good = fold_text(mesh_of(3, 3, 2), 9), version = "\"file_spec\": 1.1";
  EXPECT_NO_THROW(parse_origami(
      replaced(good, version, version + ", \"file_title\": \"\\\"" + std::string(100'000, '[') + "\""),
      "a.fold"));
  try {
    parse_origami("{\"a\":\n" + nested(70, "[", "]") + "}", "a.fold");
    ADD_FAILURE() << "not refused";
  } catch (const InvalidInput& e) {
    EXPECT_EQ(e.place().line, 2);
    EXPECT_EQ(e.place().column, 64);
  }
}

/// Each frame is the parent of the next.
TEST(OrigamiFile, IsRefusedWhereFramesInheritOverTooMany) {
  const auto chain = [](int length) {
    std::string frames;
    for (int k = length; k > 0; --k)
      frames += fmt::format("{}{{\"frame_inherit\": true, \"frame_parent\": {}}}", frames.empty() ? "" : ", ",
                            k == 1 ? 0 : length - k + 2);
    return "{\"file_frames\": [" + frames + "]}";
  };
  expect_refused(chain(20), "it has no `vertices_coords`");
  for (const int length : {100, 100'000}) expect_refused(chain(length), "Give at most 64 ancestors");
}

TEST(OrigamiFile, CountsInnerVerticesOfAnotherDegree) {
  std::string points = "[0, 0]", faces, edges;
  for (int k = 0; k < 5; ++k) {
    const double a = 2 * pi * k / 5, b = a + pi / 5;
    points +=
        fmt::format(", [{}, {}], [{}, {}]", std::cos(a), std::sin(a), 1.5 * std::cos(b), 1.5 * std::sin(b));
    const int next = 2 * ((k + 1) % 5) + 1;
    faces += fmt::format("{}[0, {}, {}, {}]", k ? ", " : "", 2 * k + 1, 2 * k + 2, next);
    edges += fmt::format("{}[0, {}], [{}, {}], [{}, {}]", k ? ", " : "", 2 * k + 1, 2 * k + 1, 2 * k + 2,
                         2 * k + 2, next);
  }
  expect_refused(
      fmt::format("{{\"vertices_coords\": [{}], \"faces_vertices\": [{}], \"edges_vertices\": [{}], "
                  "\"edges_foldAngle\": []}}",
                  points, faces, edges),
      "of 5 faces it has 1 inner vertex of 5 creases");
}

}  // namespace
}  // namespace kinetix::app
