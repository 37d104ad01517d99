#include "targets/fold/fold_goal.hpp"

#include <gmock/gmock.h>

#include "targets/fold/fold_net.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::targets {
namespace {

using testing::BadInput;
using testing::expect_refused;

FoldGoal fold_of(const std::string& target) {
  return read_fold(parse_document("target: " + target + "\n", "in.yaml").required("target", ""));
}

std::string net(const std::string& creases) {
  return "{kind: fold, net: {faces: [{name: base, cells: [4, 4]}, {name: a, cells: [4, 2]},\n"
         "{name: b, cells: [3, 4]}, {name: c, cells: [3, 2]}], creases: [\n" +
         creases + "]}}";
}

// Creases of the net below, between two faces each.
const std::string base_a = "{faces: [base, a], side: top, angle_deg: 90}";
const std::string base_b = ",\n{faces: [base, b], side: right, angle_deg: -60}";
const std::string a_c = ",\n{faces: [a, c], side: right, angle_deg: 30}";

TEST(ReadFold, TakesABoxInAllItsUnfoldings) {
  const FoldGoal goal = fold_of("{kind: fold, box: [4, 4, 4], crease_columns: 2}");
  EXPECT_EQ(goal.box, (std::array{4, 4, 4}));
  EXPECT_EQ(goal.nets.size(), 11u);
  for (const FoldCrease& crease : goal.nets[3].creases) EXPECT_EQ(crease.columns, 2);
}

TEST(ReadFold, LeavesOutTheOpenFace) {
  const FoldGoal goal = fold_of("{kind: fold, box: [3, 2, 1], open: top}");
  for (const FoldFace& face : goal.nets[0].faces) EXPECT_NE(face.name, "top");
  EXPECT_EQ(goal.nets[0].faces.size(), 5u);
}

TEST(ReadFold, TakesABoxInMillimetres) {
  const FoldGoal goal = fold_of("{kind: fold, box_mm: [120, 80.5, 40], open: top}");
  EXPECT_EQ(goal.box_mm, (std::array{120.0, 80.5, 40.0}));
  EXPECT_EQ(goal.open, 1);
}

TEST(ReadFold, TakesANetWithAnglesOfBothSigns) {
  const FoldGoal goal = fold_of(net(base_a + base_b + a_c));
  ASSERT_EQ(goal.nets.size(), 1u);
  EXPECT_DOUBLE_EQ(goal.nets[0].creases[1].angle, -pi / 3);
  const NetLayout layout = lay_out(goal.nets[0], {1, 2, 1});
  EXPECT_EQ(layout.cells.size(), 16u + 8 + 12 + 6 + 4 + 8 + 2);
}

TEST(ReadFold, TakesARingThatFoldsInOneDirection) {
  const std::string ring = base_a + ",\n{faces: [base, b], side: right, angle_deg: 0}" +
                           ",\n{faces: [a, c], side: right, angle_deg: 0}" +
                           ",\n{faces: [b, c], side: top, angle_deg: 90}";
  EXPECT_EQ(fold_of(net(ring)).nets[0].creases.size(), 4u);
}

TEST(ReadFold, RefusesARingThatOpensWhenItFolds) {
  const std::string ring = base_a + ",\n{faces: [base, b], side: right, angle_deg: 0}" +
                           ",\n{faces: [a, c], side: right, angle_deg: 0}" +
                           ",\n{faces: [b, c], side: top, angle_deg: 80}";
  EXPECT_THAT(testing::refusal([&] { fold_of(net(ring)); }), ::testing::HasSubstr("does not close"));
}

TEST(ReadFold, RefusesWhatIsNoFold) {
  const BadInput cases[] = {
      {"{kind: fold}", 1, 9, "target", {"`box: [a, b, c]`"}},
      {"{kind: fold, box: [4, 4, 4], net: {}}", 1, 9, "target", {"more than one shape"}},
      {"{kind: fold, box: [4, 0, 4]}", 1, 31, "target.box[1]", {"0", "1"}},
      {"{kind: fold, box: [120, 80, 40]}", 1, 27, "target.box", {"35200 cells", "box_mm: [120, 80, 40]"}},
      {"{kind: fold, box_mm: [120, 0, 40]}", 1, 36, "target.box_mm[1]", {"1", "mm"}},
      {"{kind: fold, box: [4, 4]}", 1, 27, "target.box", {"edge lengths"}},
      {"{kind: fold, box: [4, 4, 4], open: lid}", 1, 44, "target.open", {"`lid`", "top"}},
      {net("{faces: [base, d], side: top, angle_deg: 90}"), 3, 16, "target.net.creases[0].faces[1]", {"`d`"}},
      {net("{faces: [base, a], side: top, angle_deg: 190}"),
       3,
       42,
       "target.net.creases[0].angle_deg",
       {"180"}},
      {net("{faces: [a, a], side: top, angle_deg: 90}"), 3, 13, "target.net.creases[0].faces[1]", {"itself"}},
      {net(base_a + base_b), 1, 27, "target.net", {"face `c`", "Connect all faces"}},
      {net(base_a + base_b + ",\n{faces: [base, c], side: top, angle_deg: 9}"),
       1,
       27,
       "target.net",
       {"crease `base-a`", "crease `base-c`", "overlap"}},
      {net(base_a + base_b + a_c + ",\n{faces: [b, c], side: top, angle_deg: 90}"),
       1,
       27,
       "target.net",
       {"ring", "`b-c`", "both ways"}},
      {net(base_a + base_b + a_c + ",\n{faces: [b, c], side: left, angle_deg: 90}"),
       1,
       27,
       "target.net",
       {"`b-c`", "not a neighbour"}},
      {net(base_a + base_b + ",\n{faces: [a, c], side: top, angle_deg: 9, shift: 5}"),
       1,
       27,
       "target.net",
       {"`a-c`", "not neighbours"}},
  };
  for (const BadInput& bad : cases) expect_refused(bad, "in.yaml", [&] { fold_of(bad.text); });
}

TEST(FoldNet, SaysWhatIsWrongWithIt) {
  const FoldNet good = fold_of(net(base_a + base_b + a_c)).nets.front();
  const auto refused = [](const FoldNet& bad) { return testing::refusal([&] { validate(bad); }); };
  validate(good);
  FoldNet bad = good;
  bad.faces[1].width = 0;
  EXPECT_THAT(refused(bad), ::testing::HasSubstr("face `a` has 0 x"));
  bad = good;
  bad.faces[2].name = "a";
  EXPECT_THAT(refused(bad), ::testing::HasSubstr("two faces are named `a`"));
  bad = good;
  bad.creases.push_back(bad.creases.front());
  EXPECT_THAT(refused(bad), ::testing::HasSubstr("is listed twice"));
  bad = good;
  bad.creases.front().angle = 4;
  EXPECT_THAT(refused(bad), ::testing::HasSubstr("turns by 229"));
}

TEST(ReadFold, RefusesCreasesThatNeedBothDirectionsInOneCell) {
  const std::string text =
      "{kind: fold, net: {faces: [{name: base, cells: [4, 4]}, {name: a, cells: [4, 4]},\n"
      "{name: b, cells: [4, 4]}, {name: c, cells: [2, 2]}, {name: d, cells: [2, 2]}], creases: [\n"
      "{faces: [base, a], side: right, angle_deg: 90, columns: 3},\n"
      "{faces: [base, b], side: top, angle_deg: 90},\n"
      "{faces: [b, c], side: right, angle_deg: 90},\n"
      "{faces: [c, d], side: bottom, angle_deg: 90, columns: 3}]}}";
  const std::string why = testing::refusal([&] { fold_of(text); });
  for (const char* words : {"`base-a`", "`c-d`", "cell [5, 2]", "both ways"})
    EXPECT_THAT(why, ::testing::HasSubstr(words));
}

TEST(ReadFold, TakesASolidFromAFile) {
  testing::TemporaryFolder folder;
  folder.write("tent.off",
               "OFF\n6 5 9\n0 0 0\n0 40 0\n0 20 30\n60 0 0\n60 40 0\n60 20 30\n3 0 2 1\n3 3 4 5\n4 0 1 4 3\n"
               "4 1 2 5 4\n4 0 3 5 2\n");
  const std::string document = folder.path("in.yaml");
  const FoldGoal goal =
      read_fold(parse_document("target: {kind: fold, solid: tent.off}\n", document).required("target", ""));
  EXPECT_EQ(goal.solid->name, "tent.off");
  EXPECT_EQ(goal.solid->shape.faces.size(), 5u);
  EXPECT_THAT(
      testing::refusal([&] {
        read_fold(parse_document("target: {kind: fold, solid: none.off}\n", document).required("target", ""));
      }),
      ::testing::HasSubstr("target.solid: "));
}

TEST(ReadFold, TakesASolidByItsName) {
  const FoldGoal goal = fold_of("{kind: fold, solid: icosahedron, cells: 3, crease_columns: 2}");
  ASSERT_TRUE(goal.solid);
  EXPECT_EQ(goal.solid->name, "icosahedron");
  EXPECT_EQ(goal.solid->shape.faces.size(), 20u);
  EXPECT_EQ(goal.solid->cells, 3);
  EXPECT_EQ(goal.solid->columns, 2);
  EXPECT_THAT(testing::refusal([] { fold_of("{kind: fold, solid: cone}"); }),
              ::testing::HasSubstr("icosahedron"));
  EXPECT_THAT(testing::refusal([] { fold_of("{kind: fold, solid: octahedron, cells: 1}"); }),
              ::testing::HasSubstr("2 to 8"));
  EXPECT_THAT(testing::refusal([] { fold_of("{kind: fold, solid: octahedron, box: [1, 1, 1]}"); }),
              ::testing::HasSubstr("more than one shape"));
}

}  // namespace
}  // namespace kinetix::targets
