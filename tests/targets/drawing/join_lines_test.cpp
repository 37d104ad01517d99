#include "targets/drawing/join_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "tests/support/bad_input.hpp"

namespace kinetix::targets {
namespace {

using ::testing::HasSubstr;
using testing::refusal;

std::vector<DrawnLine> lines_of(const std::vector<std::array<double, 4>>& ends) {
  std::vector<DrawnLine> lines;
  for (const auto& [x0, y0, x1, y1] : ends) lines.push_back({{x0, y0}, {x1, y1}});
  return lines;
}

/// Expects a planar graph that model::validate() accepts, with these numbers of vertices and edges.
void expect_graph(const std::vector<std::array<double, 4>>& ends, std::size_t vertices, std::size_t edges) {
  const JoinedLines joined = join_lines(lines_of(ends));
  EXPECT_EQ(joined.graph.vertices.size(), vertices);
  EXPECT_EQ(joined.graph.edges.size(), edges);
  EXPECT_EQ(joined.line_of.size(), edges);
  EXPECT_NO_THROW(validate(joined.graph));
}

TEST(JoinLines, JoinsEndsThatAreNear) {
  expect_graph({{0, 0, 10, 0}, {10.01, 0.01, 10, 10}, {0.01, 10, 9.99, 9.99}, {0, 0.01, 0, 10}}, 4, 4);
}

TEST(JoinLines, SplitsLinesWhereOthersEnd) {
  expect_graph({{0, 0, 20, 0}, {20, 0, 20, 10}, {20, 10, 0, 10}, {0, 10, 0, 0}, {10, 0, 10, 10}}, 6, 7);
  expect_graph({{0, 0, 20, 0}, {10, 0.01, 10, 10}}, 4, 3);
}

TEST(JoinLines, SplitsLinesWhereTheyCross) {
  expect_graph({{0, 0, 10, 10}, {0, 10, 10, 0}}, 5, 4);
  expect_graph({{0, 0, 30, 0}, {0, 10, 30, 10}, {10, -5, 10, 15}, {20, -5, 20, 15}}, 12, 12);
  expect_graph({{-10, 0, 10, 0}, {0, -10, 0, 10}, {-10, -10, 10, 10}}, 7, 6);
}

TEST(JoinLines, MergesLinesThatOverlap) {
  expect_graph({{0, 0, 10, 0}, {10, 0.001, 0, 0}, {10, 0, 10, 10}}, 3, 2);
  expect_graph({{0, 0, 20, 0}, {5, 0, 7, 0}, {15, 0, 20, 0.01}}, 2, 1);
  expect_graph({{0, 0, 20, 0}, {10, 0, 30, 0}, {20, 0, 20, 10}}, 4, 3);
  expect_graph({{0, 0, 10, 0}, {10, 0, 20, 0}}, 3, 2);
}

TEST(JoinLines, OmitsLinesWithoutLength) {
  expect_graph({{0, 0, 10, 0}, {5, 5, 5, 5}, {0, 0, 0.001, 0}}, 2, 1);
  EXPECT_THAT(refusal([] { join_lines(lines_of({{1, 1, 1, 1}})); }), HasSubstr("no lines with a length"));
  EXPECT_THAT(refusal([] { join_lines({}); }), HasSubstr("no lines with a length"));
}

TEST(JoinLines, TakesASmallerDistanceIfLinesAreNearerToEachOther) {
  const auto bundle = lines_of({{0.00465, 0.00407, 1.00467, 0.00143},
                                {0.00233, 0.00379, 1.00234, 0.00204},
                                {0.00561, 0.00044, 1.00352, 0.00369},
                                {0.00034, 0.00402, 1.00209, 0.00307}});
  EXPECT_THAT(refusal([&] { join_lines(bundle, 0.002); }), HasSubstr("Change structure.join_mm"));
  EXPECT_LT(join_lines(bundle).join, 0.002);
}

TEST(JoinLines, NamesTheLastLineOfEachEdge) {
  const JoinedLines joined = join_lines(lines_of({{0, 0, 20, 0}, {10, 0, 20, 0}, {10, 0, 10, 5}}));
  EXPECT_EQ(joined.line_of, (std::vector<int>{0, 1, 2}));
}

/// Ends are joined up to a share of the walls, not of the long lines that cross and form them.
TEST(JoinLines, MeasuresByTheMedianWall) {
  std::vector<std::array<double, 4>> grid;
  for (int k = 0; k <= 10; ++k) {
    grid.push_back({0, 10.0 * k, 100, 10.0 * k});
    grid.push_back({10.0 * k, 0, 10.0 * k, 100});
  }
  const JoinedLines joined = join_lines(lines_of(grid));
  EXPECT_NEAR(joined.join, 10 * default_join, 1e-9);
  EXPECT_EQ(joined.graph.vertices.size(), 121u);
  EXPECT_EQ(joined.graph.edges.size(), 220u);
}

TEST(JoinLines, JoinsAsFarAsRequested) {
  const std::vector<DrawnLine> lines = lines_of({{0, 0, 10, 0}, {10.3, 0, 10, 10}});
  EXPECT_EQ(join_lines(lines).graph.vertices.size(), 4u);
  EXPECT_EQ(join_lines(lines, 0.4).graph.vertices.size(), 3u);
}

TEST(JoinLines, FindsNearMisses) {
  const auto misses = [](const std::vector<std::array<double, 4>>& ends) {
    return find_near_misses(join_lines(lines_of(ends)));
  };
  EXPECT_TRUE(misses({{0, 0, 10, 0}, {10, 0, 10, 10}}).empty());
  EXPECT_TRUE(misses({{0, 0, 10, 0}, {11, 0, 11, 10}}).empty()) << "far apart";
  const std::vector<NearMiss> ends = misses({{0, 0, 10, 0}, {10.1, 0, 10.1, 10}});
  ASSERT_FALSE(ends.empty());
  EXPECT_NEAR(ends[0].gap(), 0.1, 1e-9);
  EXPECT_FALSE(misses({{0, 0, 10, 0}, {5, 0.1, 5, 10}}).empty()) << "an end near a wall";
  EXPECT_FALSE(misses({{0, 0, 10, 0}, {5, -0.08, 5, 10}}).empty()) << "a tail beyond a wall";
  EXPECT_TRUE(misses({{0, 0, 10, 0}, {10, 0, 10, 0.1}, {10, 0.1, 0, 5}, {0, 5, 0, 0}}).empty())
      << "a short wall";
}

/// Random lines always give a planar graph, and joining the graph again does not change it.
TEST(JoinLines, GivesPlanarGraphsOfRandomLines) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 100);
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    std::vector<DrawnLine> lines;
    for (int k = 0; k < 40; ++k)
      lines.push_back({{place(random), place(random)}, {place(random), place(random)}});
    const JoinedLines joined = join_lines(lines, 0.05);
    std::vector<DrawnLine> again;
    for (const auto& [from, to] : joined.graph.edges)
      again.push_back({joined.graph.vertices[from], joined.graph.vertices[to]});
    const JoinedLines same = join_lines(again, 0.05);
    EXPECT_EQ(same.graph.vertices.size(), joined.graph.vertices.size());
    EXPECT_EQ(same.graph.edges.size(), joined.graph.edges.size());
    EXPECT_EQ(refusal([&] { validate(joined.graph); }).find("crosses"), std::string::npos)
        << refusal([&] { validate(joined.graph); });
  }
}

TEST(JoinLines, RefusesLinesThatCrossTooOften) {
  std::vector<DrawnLine> lines;
  for (int k = 0; k < 1100; ++k) {
    lines.push_back({{0, 1.0 * k}, {1100, 1.0 * k}});
    lines.push_back({{0.5 + k, -1}, {0.5 + k, 1101}});
  }
  EXPECT_THAT(refusal([&] { join_lines(lines); }), HasSubstr("more than a million walls"));
}

}  // namespace
}  // namespace kinetix::targets
