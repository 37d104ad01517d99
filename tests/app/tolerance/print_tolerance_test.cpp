#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cstdlib>
#include <numeric>

#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/pipeline/print_tolerance.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/app/tolerance/free_prints.hpp"
#include "tests/app/tolerance/wall_solids.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using Eigen::VectorXd;
using testing::FreeErrors;
using testing::FreeSheet;
using testing::TemporaryFolder;
using testing::WallSolids;

/// Returns the number of prints. The figures of hinges.md need 1000: KINETIX_PRINTS=1000 test_print_tolerance.
int count_prints() {
  const char* asked = std::getenv("KINETIX_PRINTS");
  return asked ? std::atoi(asked) : 40;
}

/// Returns the number of states up to the fold, inclusive, in which prints are checked for contact.
int count_states() { return std::getenv("KINETIX_PRINTS") ? 8 : 4; }

struct Tried {
  Target target;
  Run run;
};

Tried tried(const std::string& text) {
  const TemporaryFolder folder;
  Tried out{read_target(folder.write("t.yaml", "kinetix: 1\n" + text)), {}};
  RunOptions options;
  options.verify = false;
  options.threads = 1;
  out.run = run_goal(*out.target.goal, options);
  return out;
}

model::State design_state(const Tried& one) {
  return one.run.compensation ? one.run.equilibrium->path.state : one.run.own;
}

/// Computes the distances of a state from its goal. Each point has its directions, and the goal finds the nearest
/// places again.
VectorXd distances(const Tried& one, const model::Lattice& sheet, const model::State& state) {
  const auto judged = one.target.goal->observe(one.run, sheet, state);
  VectorXd out(judged->points.size());
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = judged->points[k].miss_mm;
  return out;
}

/// Rms distance of a print over its points, after the best small rigid motion of the errors. Consecutive rows with the
/// same bodies and place are directions of one point.
class FreeDistance {
 public:
  FreeDistance(const Tried& one, const model::State& design) {
    const auto points = one.target.goal->observe(one.run, one.run.design.structure, design)->points;
    designed_ = distances(one, one.run.design.structure, design);
    Eigen::MatrixXd rigid(points.size(), 6);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& p : points) middle += p.place / static_cast<double>(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto& p = points[k];
      const bool again =
          k > 0 && p.bodies == points[k - 1].bodies && (p.place - points[k - 1].place).norm() < 1e-9;
      if (!again) ++count_;
      rigid.row(static_cast<Eigen::Index>(k)) << p.normal.transpose(),
          (p.place - middle).cross(p.normal).transpose() / 10;
    }
    solver_.compute(rigid);
    rigid_ = rigid;
  }

  double points() const { return count_; }
  double operator()(const VectorXd& print) const {
    // A line's second direction rotates with the first, so only the lengths of the residuals are compared.
    VectorXd moved = print - designed_;
    moved -= rigid_ * solver_.solve(moved);
    return (designed_ + moved).norm() / std::sqrt(count_);
  }
  /// Computes the rms distance without rigid motion.
  double plain(const VectorXd& print) const { return print.norm() / std::sqrt(count_); }

 private:
  VectorXd designed_;
  Eigen::MatrixXd rigid_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver_;
  double count_ = 0;
};

struct Sampled {
  double rms = 0, rms_error = 0, p95 = 0;  ///< `rms`, `p95`: mm; `rms_error`: standard error of rms, mm
  double touching = 0;                     ///< share of prints that touch
  int failed = 0, prints = 0;
};

/// The hinges of a run's prints, in the form that these tests use.
struct FreeHinge {
  model::HingeStiffness k;
  double reach_mm = 0;
};

FreeHinge hinge_of(const Run& run) {
  const model::Elasticity e =
      run.printed->soft ? elasticity_of(run.printed->soft->made) : elasticity_of(*run.design.hinge.made);
  return {stiffness_of(e), e.reach_mm};
}

FreeSheet free_sheet(const Run& run, const model::Lattice& sheet, const model::State& design, bool is_fold) {
  const FreeHinge hinge = hinge_of(run);
  const std::vector<double> none(static_cast<std::size_t>(run.design.structure.hinges()), 0.0);
  FreeSheet own(model::Linkage(run.design.structure), hinge.k, hinge.reach_mm, none);
  const std::vector<double> at = own.turns(design);
  if (!run.compensation || !is_fold) return {model::Linkage(sheet), hinge.k, hinge.reach_mm, at};
  FreeSheet out(model::Linkage(sheet), hinge.k, hinge.reach_mm, none);
  // The sheet reaches run.theta. The springs rest at a larger theta.
  const model::LinkageDrive& drive = run.equilibrium->drive;
  const model::Linkage linkage(run.design.structure);
  std::vector<double> rests;
  for (const model::RestHinge& h : linkage.hinges)
    rests.push_back(-linkage.bodies[h.lower].sense * drive.angle);
  out.add_springs(drive.k_spring, rests);
  return out;
}

Sampled sample(const Tried& one, bool planar, unsigned seed) {
  const Run& run = one.run;
  const FreeErrors sd{run.design.process.sd.t_mm, run.design.process.sd.tilt_deg * radians_per_degree};
  const model::State design = design_state(one);
  std::vector<model::State> way;
  if (run.compensation)
    for (const NamedState& state : run.states)
      if (state.name == "frame") way.push_back(state.poses);
  for (int k = 1; !run.compensation && k < count_states(); ++k)
    way.push_back(run.plan.exact.at(run.theta * k / count_states()));
  const WallSolids designed{model::Linkage(run.design.structure)};
  const auto built = designed.touching(model::rest_state(run.design.structure), {});
  const FreeDistance distance(one, design);
  std::mt19937_64 random(seed);
  Sampled out;
  std::vector<double> all;
  for (int k = 0; k < count_prints(); ++k) {
    const model::Lattice print = with_errors(run.design.structure, sd, random);
    model::State state = design;
    if (!free_sheet(run, print, design, true).settle(state, planar)) {
      ++out.failed;
      continue;
    }
    all.push_back(distance(distances(one, print, state)));
    const WallSolids walls{model::Linkage(print)};
    bool touches = !walls.touching(state, built, 1).empty();
    for (std::size_t w = 0; w < way.size() && !touches; ++w) {
      model::State on_the_way = way[w];
      if (free_sheet(run, print, way[w], false).settle(on_the_way, planar))
        touches = !walls.touching(on_the_way, built, 1).empty();
    }
    out.touching += touches;
  }
  out.prints = static_cast<int>(all.size());
  if (all.empty()) return out;
  out.touching /= out.prints;
  double mean = 0, fourth = 0;
  for (const double d : all) mean += d * d / out.prints, fourth += std::pow(d, 4) / out.prints;
  out.rms = std::sqrt(mean);
  out.rms_error = std::sqrt(std::max(0.0, fourth - mean * mean) / out.prints) / (2 * out.rms);
  std::sort(all.begin(), all.end());
  out.p95 = all[std::min(all.size() - 1, all.size() * 95 / 100)];
  return out;
}

struct Case {
  std::string name, text;
  bool planar = false;
};

std::string shipped(const std::string& file) {
  return std::string(KINETIX_SOURCE) + "/targets/shapes/" + file;
}

/// Returns a ring with an opening of `gap_mm`.
std::string ring(double radius_mm, double gap_mm, int columns, const std::string& process) {
  std::string points;
  constexpr int count = 120;
  for (int k = 0; k <= count; ++k) {
    const double angle = (2 * pi - gap_mm / radius_mm) * k / count;
    points += fmt::format("{}[{:.6f}, {:.6f}]", k ? ", " : "", radius_mm * std::cos(angle),
                          radius_mm * std::sin(angle));
  }
  return fmt::format(
      "target: {{kind: curve, points: [{}]}}\nstructure: {{cells: [{}, 1], wall_mm: {{thickness: 0.8, "
      "height: 5}}}}\nprocess: {}\n",
      points, columns, process);
}

/// Returns the cases. The first few are quick; the others run only if many prints are requested.
const std::vector<Case>& cases() {
  static const std::vector<Case> every = {
      {"curve",
       "target: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\nstructure: {cells: "
       "[12, 1]}\n"},
      {"space_curve",
       "target: {kind: space_curve, points: [[0, 0, 0], [50, 0, 10], [100, 15, 12], [150, 40, 10]]}\n"
       "structure: {cells: [30, 1]}\n"},
      {"box", "target: {kind: fold, box: [3, 3, 3]}\ntolerance: {angle_deg: 1}\n"},
      {"solid", "target: {kind: fold, solid: tetrahedron}\n"},
      {"panel", "target: {kind: fold, net: {faces: [{name: a, cells: [2, 2]}], creases: []}}\n"},
      {"outline",
       "target: {kind: outline, points: [[10, 0], [7.1, 7.1], [0, 10], [-7.1, 7.1], [-10, 0], [-7.1, -7.1], "
       "[0, "
       "-10], [7.1, -7.1], [10, 0]]}\nstructure: {cells: [8, 8], trim: none, cell_mm: 10}\n",
       true},
      {"surface", "target: {kind: surface, shape: cap}\nstructure: {facets: [4, 4]}\n"},
      {"ribs", "target: {kind: surface, shape: cap, ribs: 3}\n"},
      {"helmet", "target: {kind: helmet, mesh: " + shipped("headform.obj") + ", ribs: 2, coverage_mm: 60}\n"},
      {"space_block",
       "target: {kind: space_block, factor: [0.86, 0.82, 0.88], size_mm: [60, 60, 60]}\nstructure: {cells: "
       "[1, 1, 1]}\n"},
      {"ring_2", ring(60, 2.2, 48, "sla")},
      {"ring_5", ring(60, 5, 48, "sla")},
      {"ring_1", ring(40, 1, 32, "polyjet")},
      {"ring_fdm", ring(80, 8, 40, "fdm")},
      {"springs",
       "target: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\nstructure: {cells: "
       "[12, 1]}\n"
       "hinge: {kind: block, material: tango, gap_mm: 1}\ndrive: {kind: shape_memory, k_turn: 5}\n"},
  };
  static const std::vector<Case> quick(every.begin(), every.begin() + 5);
  return std::getenv("KINETIX_PRINTS") ? every : quick;
}

class PrintTolerance : public ::testing::TestWithParam<Case> {};

TEST_P(PrintTolerance, IsThatOfPrintsFoundAnotherWay) {
  const Tried one = tried(GetParam().text);
  ASSERT_TRUE(one.run.printed) << one.run.prints_unknown;
  const PrintedGoal& printed = *one.run.printed;
  const Sampled seen = sample(one, GetParam().planar, 7);
  const double share = printed.touching ? printed.touching->share() : NAN;
  fmt::print(
      "{:12} bodies {:4}  designed {:.4f}  rms {:.4f} prints {:.4f} +- {:.4f} ratio {:.3f}  p95 {:.4f} "
      "prints {:.4f} ratio {:.3f}  touching {:.3f} +- {:.3f} of {} ({}) prints {:.3f}  failed {}\n",
      GetParam().name, one.run.design.structure.bodies(), printed.made.designed_mm, printed.rms_mm(),
      seen.rms, seen.rms_error, printed.rms_mm() / seen.rms, printed.p95_mm(), seen.p95,
      printed.p95_mm() / seen.p95, share, printed.touching ? printed.touching->error() : NAN,
      printed.touching ? printed.touching->prints : 0, printed.touching ? printed.touching->settled : 0,
      seen.touching, seen.failed);
  if (printed.runs)
    fmt::print(
        "             first order {:.4f}  of {} prints {:.4f}, to first order {:.4f}, ratio +- {:.3f}\n",
        printed.made.rms_mm, printed.runs->prints, printed.runs->rms_mm, printed.runs->first_order_rms_mm,
        printed.runs->ratio_error);
  std::fflush(stdout);
  ASSERT_TRUE(printed.touching);
  ASSERT_LE(seen.failed, 0.02 * count_prints()) << "by the other way";
  EXPECT_NEAR(printed.rms_mm(), seen.rms, 0.1 * seen.rms + 3 * seen.rms_error);
  if (seen.prints >= 500) {
    EXPECT_NEAR(printed.p95_mm(), seen.p95, 0.15 * seen.p95);
  }
  const double of_seen = (seen.touching * seen.prints + 1) / (seen.prints + 2);
  EXPECT_NEAR(
      share, seen.touching,
      3 * std::hypot(printed.touching->error(), std::sqrt(of_seen * (1 - of_seen) / (seen.prints + 2))));
}

INSTANTIATE_TEST_SUITE_P(Kinds, PrintTolerance, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace kinetix::app
