#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "app/goals/fold/fold_file.hpp"
#include "app/goals/fold/fold_limits.hpp"
#include "app/goals/fold/fold_outcome.hpp"
#include "app/pipeline/hinge_loads.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/run/goal_kind.hpp"
#include "model/sheet/sheet_motion.hpp"
#include "optim/fold/fit_box.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {
namespace {

/// Size of the tilts along a crease, rad: those that make up for elastic hinges differ a little.
double mean_tilt(const model::Sheet& net, const targets::PlacedCrease& crease) {
  double sum = 0;
  const std::vector<model::Wall> walls = bending_walls(crease);
  for (const model::Wall& wall : walls) sum += std::abs(net.hinge(*net.squares()->hinge_at(wall)).beta);
  return sum / static_cast<double>(walls.size());
}

// Rad: two columns a right angle, in most nets; no search tries more than four.
constexpr double most_turn_of_a_column = 45 * radians_per_degree,
                 least_turn_of_a_column = most_turn_of_a_column / 2;
constexpr double paths_to_limits =
    2;  // of elastic hinges that keep limits: one where they do, six where theta is searched
constexpr double seconds_of_175 = 0.15;  // s: a search of 175 bodies; it grows with their number to 1.5

double search_seconds(double bodies) { return seconds_of_175 * std::pow(bodies / 175, 1.5); }

// Of small boxes, for each choice of other cells: two or three, until theta and the cells agree.
constexpr double looks_a_box = 3;

double cells_of_box(const std::array<int, 3>& e) { return 2.0 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]); }

/// Of each crease: as few as tilts and theta allow, and no fewer than walls usually leave room for.
std::vector<int> usual_columns(const targets::FoldNet& net, double theta, double tilt) {
  const double turn = std::clamp(2 * std::atan(std::tan(tilt) * std::sin(theta)), least_turn_of_a_column,
                                 most_turn_of_a_column);
  std::vector<int> out;
  for (const targets::FoldCrease& crease : net.creases)
    out.push_back(crease.columns > 0
                      ? crease.columns
                      : std::max(1, static_cast<int>(std::ceil(std::abs(crease.angle) / turn - 1e-9))));
  return out;
}

/// Cells along the shortest edge of a box, at a theta: their edge, mm.
double edge_of_cells(const FoldOutcome& found, int across) {
  const optim::FoldedNet& net = found.design.folded;
  const auto& asked_mm = *found.goal.box_mm;
  const auto shortest = std::min_element(asked_mm.begin(), asked_mm.end());
  const auto edges = optim::folded_box({across, across, across}, found.goal.open, 1, net.theta,
                                       net.layout.creases[0].columns());
  return *shortest / edges[shortest - asked_mm.begin()];
}

/// A box of a given size is another one than its cells fold to: tolerance.size is for that.
std::string judged_against(const targets::FoldGoal& goal) {
  if (!goal.box_mm) return "the goal";
  return goal.open ? "the open box of these cells" : "the closed box of these cells";
}

bool looks_for_other_cells(const FoldFile& file) { return !file.robust && !file.limits.any(); }

/// What of such cells the file's process does not print, in words; empty where it prints them.
std::string too_fine(const FoldFile& file, const model::CellSize& size) {
  const auto problems = print_problems(file.process, size, file.hinge.made);
  return problems.empty() ? "" : ", where " + problems.front().what;
}

/// Other cells that give a box its size, found by a search of each; where there are none the box that these cells give.
std::string other_size(const FoldFile& file, const FoldOutcome& found, const RunOptions& options) {
  const char* looser = "a larger tolerance.size";
  if (!looks_for_other_cells(file))
    return fmt::format("try another cell edge (structure.cell_mm), or allow {}", looser);
  options.progress("other cells", -1, "");
  optim::BoxOptions box = *file.box;
  box.fold.threads = options.threads;
  box.fold.stop = options.stop;
  const auto better = optim::other_cells(box, file.size_tolerance);
  if (better)
    return fmt::format("structure.cell_mm: {:g} comes within {:.1f} %{}", better->edge_mm,
                       100 * optim::size_miss(better->folded_mm, *found.goal.box_mm),
                       too_fine(file, box.size(better->edge_mm)));
  if (options.stop.stop_requested())
    return fmt::format(
        "the search was stopped before it had tried all cells; try another cell edge (structure.cell_mm), or "
        "allow {}",
        looser);
  const auto mm = found.edges_mm();
  return fmt::format(
      "no cells of about {:.3g} to {:.3g} mm come as near; these fold to box_mm: [{:.1f}, {:.1f}, {:.1f}], "
      "which "
      "can be asked for, or {}",
      edge_of_cells(found, optim::most_cells_across), edge_of_cells(found, 1), mm[0], mm[1], mm[2], looser);
}

class FoldGoal final : public Goal {
 public:
  explicit FoldGoal(FoldFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const targets::FoldNet& net = file_.goal.nets.front();
    const double theta = usual_theta(file_.theta);
    const std::vector<int> columns = usual_columns(net, theta, file_.tilt);
    Forecast out{optim::fold_to(net, columns, theta, file_.size, file_.tilt).structure};
    if (file_.goal.box) {
      const auto mm =
          optim::folded_box(*file_.goal.box, file_.goal.open, file_.size.edge_mm, theta, columns.front());
      out.folded_mm = {mm[0], mm[1], mm[2]};
    } else if (const auto motion = exact_motion(out.sheet)) {
      out.folded_mm = size_of(out.sheet, motion.at(theta));
    }
    out.search_s = search_seconds(out.sheet.bodies());
    if (const double miss = likely_miss(); miss > file_.size_tolerance) add_other_cells(miss, out);
    add_settings(file_, out);
    if (file_.limits.any()) out.search_s += paths_to_limits * matter_seconds(file_, out.sheet);
    if (file_.robust) out.search_s *= designs_of_robust_search(file_.theta, file_.hinge);
    return out;
  }

  Found search(const RunOptions& options) const override {
    Found plain = search(file_, options);
    if (!file_.robust) return plain;
    return search_robustly(
        std::move(plain), *this, *file_.robust, file_.theta,
        [&](const RobustTrial& trial, const RunOptions& quiet) {
          FoldFile file = file_;
          file.hinge = trial.hinge;
          file.theta = trial.theta.value_or(file.theta);
          return search(file, quiet);
        },
        options);
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    const auto& found = outcome_of<FoldOutcome>(run);
    const optim::FoldedNet& net = found.design.folded;
    auto out = std::make_shared<FoldMeasure>();
    out->error = net.error;
    out->tilt = net.tilt;
    out->loads = found.loads;
    if (of == StateOf::model) {
      out->violations = found.design.folds
                            ? violations(file_, found.creases(net.error), net.error.rms, in_words(of))
                            : found.design.obstacles;
      check_size(found, out->violations);
      return out;
    }
    out->error = fold_error(net.net, net.layout, net.structure, state, net.theta);
    out->violations = violations(file_, found.creases(out->error), out->error.rms, in_words(of));
    if (of == StateOf::physics) return out;
    for (std::size_t c = 0; c < out->tilt.size(); ++c)
      out->tilt[c] = mean_tilt(run.design.structure, net.layout.creases[c]);
    check_size(found, out->violations);
    if (!found.loads) return out;
    const HingeLoads loads = hinge_loads(run.equilibrium->path, run.equilibrium->drive, run.design.structure,
                                         run.design.hinge, run.design.own_hinges);
    out->loads = FoldLoads{run.theta, loads};
    for (const std::string& why : violations(file_.limits, loads, "a smaller theta"))
      out->violations.push_back(why);
    return out;
  }

  /// Each vertex of a face, in all directions, from the solid of the size that the search chose.
  std::optional<Observed> observe(const Found& found, const model::Sheet& sheet,
                                  const model::State& state) const override {
    const optim::FoldedNet& net = outcome_of<FoldOutcome>(found).design.folded;
    if (!outcome_of<FoldOutcome>(found).design.folds || !is_finite(state)) return std::nullopt;
    double sides = 0;  // cells
    for (const model::CellRectangle& face : net.layout.faces)
      sides += (face.width + face.height) / 2.0 / static_cast<double>(net.layout.faces.size());
    Observed out{{}, file_.shape_tolerance * sides * sheet.size().edge_mm * std::cos(net.theta)};
    for (const targets::IdealPoint& v :
         ideal_vertices(net.net, net.layout, *sheet.squares(), state, net.theta))
      for (int k = 0; k < 3; ++k)
        out.points.push_back(
            {{v.body}, state[v.body].p, Eigen::Vector3d::Unit(k), (state[v.body].p - v.place)[k], 3});
    return out;
  }

 private:
  Found search(const FoldFile& file, const RunOptions& options) const {
    Found out;
    take_settings(out, file);
    out.tolerances = {{"angle_deg", std::stod(targets::degrees_text(file.angle_tolerance))},
                      {"shape", file.shape_tolerance}};
    if (file.goal.box_mm) out.tolerances.emplace_back("size", file.size_tolerance);
    out.physics.when = PhysicsWish::When::if_met;
    out.bounds = {file_.tilt, file_.theta};
    out.judged_against = judged_against(file.goal);
    auto found = std::make_unique<FoldOutcome>();
    found->goal = file.goal;
    optim::FoldOptions first = search_of(file);
    first.threads = options.threads;
    first.stop = options.stop;
    found->design = fit_fold(file.goal, first, options.progress);
    const auto narrower = [&](double largest_theta) {
      optim::FoldOptions narrowed = first;
      narrowed.theta.upper = largest_theta;
      return fit_fold(file.goal, narrowed);
    };
    keep_limits(file, out, *this, *found, narrower, options);
    if (is_size_missed(*found)) found->instead = other_size(file, *found, options);
    out.design.structure = found->design.folded.structure;
    out.theta = found->design.folded.theta;
    out.goal = std::move(found);
    return out;
  }

  /// Of edges, over those that are asked for; 0 of what is asked for in cells.
  double likely_miss() const {
    return file_.box ? optim::size_miss(file_.box_folded_mm, file_.box->asked_mm) : 0;
  }

  /// What other_size() takes: looks at small boxes, and for cells that nearly fit a search of the whole one.
  void add_other_cells(double miss, Forecast& forecast) const {
    const std::string off =
        fmt::format("with these cells the box would be off by {:.1f} %; {:.1f} % is allowed", 100 * miss,
                    100 * file_.size_tolerance);
    if (!looks_for_other_cells(file_)) return forecast.notes.push_back(off);
    const double bodies_a_cell = forecast.sheet.bodies() / cells_of_box(*file_.goal.box);
    double looks = 0, folds = 0;  // s
    for (std::array<int, 3> edges : optim::tried_cells(*file_.box, file_.size_tolerance)) {
      folds += search_seconds(bodies_a_cell * cells_of_box(edges));
      for (int& edge : edges) edge = std::min(edge, optim::telling_cells);
      looks += looks_a_box * search_seconds(bodies_a_cell * cells_of_box(edges));
    }
    forecast.search_s += looks;
    forecast.notes.push_back(fmt::format(
        "{}: the search goes on with other cells, for {}, or up to {} where many of them nearly fit", off,
        about(looks), about(looks + folds)));
  }

  bool is_size_missed(const FoldOutcome& found) const {
    return found.goal.box_mm && found.design.folds &&
           !(optim::size_miss(found.edges_mm(), *found.goal.box_mm) <= file_.size_tolerance);
  }

  void check_size(const FoldOutcome& found, std::vector<std::string>& why) const {
    if (!is_size_missed(found)) return;
    why.push_back(fmt::format(
        "an edge of the box is {:.1f} % longer or shorter than asked for; at most {:.1f} % is allowed: {}",
        100 * optim::size_miss(found.edges_mm(), *found.goal.box_mm), 100 * file_.size_tolerance,
        found.instead));
  }

  FoldFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(FoldFile file) { return std::make_unique<FoldGoal>(std::move(file)); }

extern const GoalKind fold_kind = {
    .name = "fold",
    .example = "target: {kind: fold, box: [4, 4, 4]}",
    .read =
        [](const targets::Node& root) {
          FoldFile file = read_fold_file(root);
          return file.goal.solid ? make_solid_goal(std::move(file)) : make_goal(std::move(file));
        },
    .table = fold_keys,
    .metrics = {
        {"fold_deg", "deg", "[fold of each crease](#face_rms), a list"},
        {"fold_miss_deg", "deg", "the largest difference from what a crease was to fold by"},
        {"face_rms", "", "[vertices of the faces from the ideal solid](#face_rms), over the edge of a face"},
        {"fold_physics_deg", "deg", "fold of each crease in the physics run, a list"},
        {"fold_miss_physics_deg", "deg", "the largest difference in the physics run"},
        {"face_rms_physics", "", "face_rms in the physics run"}}};

}  // namespace kinetix::app
