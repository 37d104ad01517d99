#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "app/pipeline/physics.hpp"
#include "app/print/fit.hpp"
#include "app/print/format/print_format.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/elastic_system.hpp"
#include "model/linkage/exact_motion.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/print/folding_judge.hpp"
#include "tests/app/print/mesh_distance.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

// Upright walls with soft hinges, which spring back from the fold.
constexpr const char* soft_panel = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 14, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 20}
hinge: {kind: block, material: tpu95a, gap_mm: 1.6}
)";
// Living hinges.
constexpr const char* film_panel = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 14, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 20}
hinge: {kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4}
)";
// Leaning walls, which fold to an arch.
constexpr const char* arch = R"(kinetix: 1
structure: {cells: [4, 2], cell_mm: 16, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 12, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 20}, {wall: [[0, 1], [1, 1]], beta_deg: -20},
  {wall: [[0, 2], [1, 2]], beta_deg: 20}]}
)";

// No room for posts or eyes.
constexpr const char* tight = R"(kinetix: 1
structure: {cells: [1, 1], cell_mm: 4, wall_mm: {thickness: 1.2, height: 6}}
design: {theta_deg: 8}
hinge: {kind: block, material: tpu95a, gap_mm: 2, thickness_mm: 0.8}
)";

app::Design design_with(const char* text, const std::string& lock) {
  const Scratch scratch;
  return app::read_design(scratch.write("panel.yaml", std::string(text) + "lock: " + lock + "\n"));
}

app::PreparedPrint locked(const char* text, const std::string& lock, const char* process = "polyjet",
                          double cell_mm = 0) {
  return app::prepare_fitting_print(design_with(text, lock), *model::find_process(process),
                                    {.edge_mm = cell_mm}, false);
}

double volume_of_pieces(const model::BodySolid& body) {
  double sum = 0;
  for (const model::ConvexPiece& piece : convex_pieces(body)) {
    const model::ConvexHull hull = model::convex_hull(piece.corners);
    model::Polyhedron solid{hull.corners, {}};
    for (const auto& face : hull.faces) solid.add_face(face);
    sum += volume_mm3(solid);
  }
  return sum;
}

double post_volume(const model::Post& post) {
  const double wide = 2 * post.half_mm, hole = post.hole_mm;
  return wide * (wide * post.height_mm - hole * (post.hole_to_mm - post.hole_from_mm) - hole * hole / 4);
}

/// Returns the clip in the fold: its middle is between the posts, its bottom on their feet.
model::Polyhedron clip_in_fold(const app::PrintSheet& sheet) {
  const auto& [first, one] = *sheet.posts.begin();
  const auto& [second, other] = *sheet.posts.rbegin();
  const model::State& fold = sheet.path.back();
  const double up = sheet.bodies[first].post->base_mm;
  const Vector3d a = fold[first].R * Vector3d(0, 0, up) + fold[first].p,
                 b = fold[second].R * Vector3d(0, 0, sheet.bodies[second].post->base_mm) + fold[second].p;
  model::Pose pose;
  pose.R.col(0) = (b - a).normalized();
  pose.R.col(2) = fold[first].R.col(2);
  pose.R.col(1) = pose.R.col(2).cross(pose.R.col(0));
  pose.p = (a + b) / 2;
  return app::placed(sheet.clip, pose);
}

TEST(Lock, PostsAndEyesAreClosedAndAsLargeAsDescribed) {
  for (const char* kind : {"clip", "strap"})
    for (const char* text : {soft_panel, arch}) {
      if (text == arch && std::string(kind) == "clip") continue;  // posts of an arch lean
      const app::PrintSheet sheet = locked(text, kind).job.sheet;
      ASSERT_EQ(sheet.posts.size(), 2U);
      for (const auto& [b, requested] : sheet.posts) {
        model::BodySolid body = sheet.bodies[b];
        EXPECT_TRUE(is_closed(sheet.meshes[b])) << kind;
        if (text == soft_panel) {
          EXPECT_NEAR(volume_mm3(sheet.meshes[b]) / volume_of_pieces(body), 1, 1e-9) << kind;
        }
        const double whole = volume_mm3(sheet.meshes[b]);
        const model::Post post = *body.post;
        body.post->height_mm = post.height_mm + 1;
        EXPECT_NEAR(volume_mm3(body_mesh(body)) - whole, 4 * post.half_mm * post.half_mm, 1e-9);
        body.post->height_mm = post.height_mm;
        body.post->hole_mm = 0;
        const double filled = volume_mm3(body_mesh(body));
        EXPECT_NEAR(filled - whole, post_volume(*body.post) - post_volume(post), 1e-9) << "the hole";
        EXPECT_EQ(post.hole_mm > 0, std::string(kind) == "strap");
      }
    }
}

TEST(Lock, ClipIsClosedAndHoldsThePostsAtTheirDistance) {
  const app::PrintSheet sheet = locked(soft_panel, "clip").job.sheet;
  EXPECT_TRUE(is_closed(sheet.clip));
  const double hole = 2 * (sheet.posts.begin()->second.half_mm + sheet.process.clearance_mm);
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : sheet.clip.points) box.extend(p);
  const Vector3d size = box.sizes();
  EXPECT_NEAR(volume_mm3(sheet.clip), size.z() * (size.x() * size.y() - 2 * hole * hole), 1e-9);
  EXPECT_NEAR(box.min().z(), 0, 1e-12);
  // The outer sides of the posts touch the outer sides of the holes.
  double outer = 0;
  for (const Vector3d& p : sheet.clip.points)
    if (std::abs(p.y()) < size.y() / 2 - 1e-6) outer = std::max(outer, p.x());
  EXPECT_NEAR(2 * outer, sheet.lock->folded_mm + 2 * sheet.posts.begin()->second.half_mm, 1e-9);
}

/// The posts and their feet touch the clip. So posts are looked at where they have play, and the clip a little higher.
TEST(Lock, ClipMeetsNothingButItsPosts) {
  for (const auto& [text, process] : {std::pair{panel, "polyjet"}, {arch, "polyjet"}}) {
    const app::PrintSheet sheet = locked(text, "clip", process).job.sheet;
    const model::State& fold = sheet.path.back();
    const int first = sheet.posts.begin()->first, second = sheet.posts.rbegin()->first;
    const Vector3d along = (fold[second].p - fold[first].p).normalized();
    const double clearance = sheet.process.clearance_mm;
    model::Polyhedron clip = clip_in_fold(sheet);
    for (int b = 0; b < static_cast<int>(sheet.meshes.size()); ++b) {
      model::Polyhedron body = placed_body(sheet, fold, b);
      if (!sheet.posts.contains(b)) {
        EXPECT_GE(surface_distance(clip, body), clearance - 0.01) << process << " " << b;
        continue;
      }
      for (Vector3d& p : body.points)
        p += (b == first ? clearance : -clearance) * along - 0.05 * fold[b].R.col(2);
      EXPECT_FALSE(surfaces_cross(clip, body)) << process << " " << b;
    }
  }
}

/// FCL folds the meshes as written, and knows nothing of convex pieces.
TEST(Lock, PostsAndEyesMeetNothingOnTheWay) {
  for (const auto& [text, kind] : {std::pair{soft_panel, "clip"}, {soft_panel, "strap"}, {arch, "strap"}}) {
    const app::PreparedPrint print = locked(text, kind);
    EXPECT_TRUE(has_required_clearance(print.clearance));
    const app::PrintSheet& sheet = print.job.sheet;
    const std::string glb = app::glb_format.write(print.job).front().content;
    const Crossing found = fold_and_compare(
        glb, 201, [&](int k) { return sheet.motion(sheet.thetas.back() * k / 200.0); }, 0.05);
    EXPECT_LE(found.mm, 0.01) << kind << ": " << found.first << ", " << found.second;
    EXPECT_GT(found.tests, 0);
  }
}

/// A line through both holes, from beyond one eye to beyond the other, meets no body.
TEST(Lock, EyesAreOpenAlongTheStrap) {
  for (const char* text : {panel, arch}) {
    const app::PrintSheet sheet = locked(text, "strap").job.sheet;
    const model::State& fold = sheet.path.back();
    std::vector<Vector3d> middle;
    for (const auto& [b, requested] : sheet.posts) {
      const model::Post& post = *sheet.bodies[b].post;
      middle.push_back(fold[b].R * post.point(0, 0, (post.hole_from_mm + post.hole_to_mm) / 2) + fold[b].p);
    }
    const Vector3d along = (middle[1] - middle[0]).normalized(), from = middle[0] - 5 * along,
                   to = middle[1] + 5 * along;
    EXPECT_NEAR((middle[1] - middle[0]).norm(), sheet.lock->folded_mm, 1e-9);
    model::Polyhedron line;  // a thin strip
    const Vector3d aside = 0.1 * along.unitOrthogonal();
    for (const Vector3d& p : {from, to, Vector3d(to + aside), Vector3d(from + aside)}) line.add_point(p);
    line.add_face({0, 1, 2, 3});
    line.add_face({3, 2, 1, 0});
    for (int b = 0; b < static_cast<int>(sheet.meshes.size()); ++b)
      EXPECT_FALSE(surfaces_cross(line, placed_body(sheet, fold, b))) << b;
  }
}

/// Elastic sheet in the plane with a lock, as a stiff spring that only pulls at the posts.
class LockedSheet {
 public:
  explicit LockedSheet(const app::PrintSheet& sheet, bool is_locked)
      : sheet_(sheet),
        elasticity_(elasticity_of(sheet.hinges.front().made)),
        system_(sheet.linkage, elasticity_, true, false),
        unit_(elasticity_.k_point * std::pow(sheet.linkage.size.edge_mm, 2)),
        is_locked_(is_locked) {}

  /// Distance of the posts, mm.
  double distance(const model::State& state) const {
    const int a = sheet_.posts.begin()->first, b = sheet_.posts.rbegin()->first;
    return (state[a].p - state[b].p).norm();
  }
  double tension(const model::State& state) const {  // N
    return is_locked_ ? spring_N_mm * std::max(0.0, distance(state) - sheet_.lock->folded_mm) : 0;
  }

  /// Minimises the energy by Newton's method, with second derivatives by differences.
  model::State settled(model::State state) const {
    const auto count = static_cast<Eigen::Index>(3 * state.size());
    for (int round = 0; round < 60; ++round) {
      const Eigen::VectorXd g = gradient(state);
      if (g.lpNorm<Eigen::Infinity>() < 1e-7) break;
      Eigen::MatrixXd H(count, count);
      constexpr double part = 1e-6;
      for (Eigen::Index k = 0; k < count; ++k)
        H.col(k) = (gradient(moved(state, part * Eigen::VectorXd::Unit(count, k))) - g) / part;
      H = (H + H.transpose()).eval() / 2;
      // Rigid motion has no stiffness: the least step is taken.
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factor;
      factor.setThreshold(1e-7);
      factor.compute(H);
      const Eigen::VectorXd step = -factor.solve(g);
      double share = std::min(1.0, 0.1 / step.lpNorm<Eigen::Infinity>());
      while (share > 1e-9 && energy(moved(state, share * step)) > energy(state)) share /= 2;
      state = moved(state, share * step);
    }
    return state;
  }

 private:
  static constexpr double spring_N_mm = 1e3;  // N/mm, of a clip

  /// Moves bodies in the plane: turns, rad, and shifts, cell edges.
  model::State moved(const model::State& state, const Eigen::VectorXd& step) const {
    Eigen::VectorXd twists = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(state.size()));
    for (Eigen::Index b = 0; b < static_cast<Eigen::Index>(state.size()); ++b) {
      twists[6 * b + 2] = step[3 * b];
      twists.segment<2>(6 * b + 3) = step.segment<2>(3 * b + 1);
    }
    return system_.retract(state, twists);
  }
  double energy(const model::State& state) const {  // N mm
    const double longer = is_locked_ ? std::max(0.0, distance(state) - sheet_.lock->folded_mm) : 0;
    return unit_ * system_.elastic_energy(state) + spring_N_mm * longer * longer / 2;
  }
  Eigen::VectorXd gradient(const model::State& state) const {
    const auto count = static_cast<Eigen::Index>(3 * state.size());
    Eigen::VectorXd out(count);
    constexpr double part = 1e-5;
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::VectorXd step = part * Eigen::VectorXd::Unit(count, k);
      out[k] = (energy(moved(state, step)) - energy(moved(state, -step))) / (2 * part);
    }
    return out;
  }

  const app::PrintSheet& sheet_;
  const model::Elasticity elasticity_;
  const model::ElasticSystem system_;
  const double unit_;  // N mm
  const bool is_locked_;
};

/// Another minimiser than the program's, of the whole sheet in its plane.
TEST(Lock, HoldsTheFoldAgainstTheSpringsOfAllHinges) {
  for (const char* kind : {"clip", "strap"}) {
    const app::PrintSheet sheet = locked(soft_panel, kind).job.sheet;
    const model::State& fold = sheet.path.back();
    const LockedSheet free(sheet, false), held(sheet, true);
    EXPECT_LE(std::abs(mean_theta(sheet.linkage, free.settled(fold))), 1e-3)
        << "without a lock it springs back";
    const model::State settled = held.settled(fold);
    EXPECT_NEAR(to_degrees(mean_theta(sheet.linkage, settled)), to_degrees(sheet.thetas.back()), 0.2) << kind;
    EXPECT_LE(aligned_distance(sheet.linkage, settled, fold).rms, 0.02) << kind << ", cell edges";
    EXPECT_NEAR(held.tension(settled) / sheet.lock->force_N, 1, 0.02) << kind;
    EXPECT_LT(sheet.lock->force_N, sheet.lock->strength_N);
    EXPECT_LT(sheet.lock->folded_mm, held.distance(fold)) << "hinges stretch";
  }
}

/// Thin films give way when they are pressed: no state at the fold is found.
TEST(Lock, SaysWhereItsHoldIsNotKnown) {
  const app::PrintSheet sheet = locked(film_panel, "clip").job.sheet;
  EXPECT_THAT(fmt::format("{}", fmt::join(sheet.warnings, "; ")), HasSubstr("holds the fold is not known"));
  EXPECT_GT(sheet.lock->force_N, 0);
}

TEST(Lock, IsInFilesAndInPrintJson) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, soft_panel, "--format stl,3mf,step --lock clip").code, 0);
  const auto lock = print_json_of(scratch)["lock"];
  EXPECT_EQ(lock["kind"], "clip");
  EXPECT_LT(double(lock["distance_folded_mm"]), double(lock["distance_flat_mm"]));
  EXPECT_GT(double(lock["force_N"]), 0);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("a clip, printed apart, fits over the posts"));
  EXPECT_TRUE(fs::exists(scratch / "out/clip.stl"));
  EXPECT_TRUE(fs::exists(scratch / "out/panel_clip.3mf"));
  ASSERT_EQ(exported(scratch, soft_panel, "--format stl,3mf --lock strap").code, 0);
  EXPECT_EQ(print_json_of(scratch)["lock"]["kind"], "strap");
  EXPECT_FALSE(fs::exists(scratch / "out/clip.stl")) << "of the export before";
  ASSERT_EQ(exported(scratch, std::string(soft_panel) + "lock: clip\n", "--format stl --lock none").code, 0);
  EXPECT_TRUE(print_json_of(scratch)["lock"].is_null());
}

TEST(Lock, OfPinsIsNotLoaded) {
  const app::PrintSheet sheet = locked(panel, "clip").job.sheet;
  EXPECT_EQ(sheet.kind(), model::HingeKind::pin);
  EXPECT_EQ(sheet.lock->force_N, 0);
  EXPECT_GT(sheet.lock->strength_N, 0);
}

TEST(Lock, IsRefusedWhereItDoesNotFit) {
  for (const char* kind : {"clip", "strap"})
    expect_refused(std::string(tight) + "lock: " + kind + "\n", "--format stl",
                   std::string("lock: ") + kind + " does not fit", not_printable);
  const std::string flat = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 14}
lock: strap
)";
  expect_refused(flat, "--format stl", "lock: strap needs a fold", not_printable);
  expect_refused(soft_panel, "--format stl --lock glue", "--lock: unknown lock");
}

// A clip where there is room for one, else a strap. A sheet without room for either stays as it is.
TEST(Lock, OfAnOpenSearchIsTheFirstThatFits) {
  const auto kind_of_default = [](const std::string& text) {
    const Scratch scratch;
    const auto lock = app::answer_of_export(app::read_design(scratch.write("panel.yaml", text))).add_lock();
    return lock ? lock->kind : "none";
  };
  EXPECT_EQ(kind_of_default(panel), "clip");
  EXPECT_EQ(kind_of_default(soft_panel), "clip");
  EXPECT_EQ(kind_of_default(arch), "clip");
  EXPECT_EQ(kind_of_default(tight), "none");
}

TEST(Lock, IsLeftOutIfOtherHingesHaveNoRoom) {
  const Scratch scratch;
  const std::string locked_panel = std::string(panel) + "lock: clip\n",
                    cut = "--format dxf --process laser --cell-mm 30";
  ASSERT_EQ(exported(scratch, locked_panel, cut).code, 0);
  EXPECT_TRUE(print_json_of(scratch)["lock"].is_null());
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), HasSubstr("the print has no lock: lock: clip"));
  expect_refused(locked_panel, cut + " --lock clip", "laser cuts flat sheets", not_printable);
}

TEST(Lock, IsKeptByDesigns) {
  for (const char* kind : {"clip", "strap", "none"})
    EXPECT_THAT(design_text(design_with(soft_panel, kind)), HasSubstr(std::string("\nlock: ") + kind + "\n"));
  const Scratch scratch;
  EXPECT_FALSE(app::read_design(scratch.write("panel.yaml", soft_panel)).lock.has_value());
}

}  // namespace
}  // namespace kinetix::testing
