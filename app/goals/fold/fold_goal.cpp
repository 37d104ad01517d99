#include "app/goals/fold/fold_goal.hpp"

#include <fmt/format.h>

#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/run/goal.hpp"
#include "app/run/run.hpp"
#include "model/base/algorithms.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app {
namespace {

/// Loads of a fold with and without limits, for FoldOutcome.
struct LimitedLoads {
  std::optional<FoldLoads> loads, unlimited;
};

constexpr int theta_halvings = 5;  // down to a degree of theta: loads of a fold change slowly with it
// rad: narrower ranges count as one theta, as in the trials of a robust search.
constexpr double one_theta = 0.5 * radians_per_degree;

/// Loads of a design compensated for its elastic hinges, and whether it still folds into its goal.
struct TrialLoads {
  FoldLoads loads;
  bool meets_goal = false;
};

TrialLoads compute_trial_loads(const FoldFile& file, SearchResult trial, const Goal& goal,
                               const optim::FoldDesign& design, const std::stop_token& stop) {
  const FoldShape shape = shape_of(file.goal, design);
  trial.design.structure = design.folded.structure;
  trial.theta = design.folded.theta;
  trial.goal = std::make_unique<FoldOutcome>(shape);
  trial = planned(std::move(trial));
  const CompensatedPath found = trace_compensated_path(trial, goal, stop);
  return {
      {model::mean_theta(found.sheet, found.path.state),
       hinge_loads(found.path, found.drive, found.sheet, trial.design.hinge, trial.design.hinge_overrides)},
      found.path.stop == model::EquilibriumPath::Stop::reached &&
          shape.violations(file, shape.error_of(found.path.state), "equilibrium").empty()};
}

/// Reduces theta, with steeper tilts, until drive and hinges stay within the file's limits and the sheet still folds
/// into its goal. Returns the loads of this design and those without limits.
///
/// The design stays as it was if no theta works, or after a stop. Loads are empty if the stop comes before the first
/// design is followed to its equilibrium.
/// @param asked_of settings of the file that apply to any design   @param goal of the file
/// @param search finds the design for a largest theta, rad
LimitedLoads keep_limits(const FoldFile& file, const SearchResult& asked_of, const Goal& goal,
                         optim::FoldDesign& design, const std::function<optim::FoldDesign(double)>& search,
                         const RunOptions& options) {
  if (!file.limits.any() || !design.folds) return {};
  const FoldLoads asked = compute_trial_loads(file, asked_of, goal, design, options.stop).loads;
  if (options.stop.stop_requested()) return {};  // an interrupted path does not reach the fold
  LimitedLoads out{asked, {}};
  if (limit_use(file.limits, asked.hinges) <= HingeLimits::safe_share) return out;
  const auto keeps = [&](double theta, double share) -> std::optional<bool> {
    options.progress("limits", share);
    optim::FoldDesign next = search(theta);
    if (options.stop.stop_requested()) return std::nullopt;
    if (!next.folds) return true;
    const TrialLoads trial_loads = compute_trial_loads(file, asked_of, goal, next, options.stop);
    if (options.stop.stop_requested()) return std::nullopt;
    if (!(limit_use(file.limits, trial_loads.loads.hinges) <= HingeLimits::safe_share)) return false;
    // A sheet that does not reach its goal strains its hinges little, which is not a way to keep the limits.
    if (!trial_loads.meets_goal) return true;
    design = std::move(next);
    out = {trial_loads.loads, asked};
    return true;
  };
  halve({file.theta.lower, design.folded.theta}, {theta_halvings, one_theta}, keeps);
  return out;
}

/// Returns the mean |tilt| of a crease, rad. Tilts compensated for elastic hinges differ a little.
double mean_tilt(const model::Lattice& net, const std::vector<int>& hinges) {
  double sum = 0;
  for (const int h : hinges) sum += std::abs(net.hinge(h).beta);
  return sum / static_cast<double>(hinges.size());
}

/// Returns the theta at which most searches for folds end, rad, for the forecast.
double typical_theta(const optim::AngleRange& allowed) {
  return std::clamp(26 * radians_per_degree, allowed.lower, allowed.upper);
}

/// Returns the options of a search: sizes, bounds of tilt and theta, threads.
optim::FoldOptions search_of(const FoldFile& file, const RunOptions& run) {
  optim::FoldOptions options;
  options.size = file.size;
  options.tilt = file.tilt;
  options.theta = file.theta;
  options.threads = run.threads;
  options.stop = run.stop;
  return options;
}

// Turn of a column, rad: most nets have two columns per right angle, and no search tries more than four.
constexpr double max_turn_per_column = 45 * radians_per_degree, min_turn_per_column = max_turn_per_column / 2;
// Mean number of equilibrium paths for limits: one if the limits are kept at once, six if theta is searched.
constexpr double paths_to_limits = 2;
constexpr double seconds_of_175 = 0.15;  // s: a search of 175 bodies; time grows as bodies^1.5

double search_seconds(double bodies) { return seconds_of_175 * std::pow(bodies / 175, 1.5); }

// Searches of a small box per choice of other cells: two or three, until theta and the cells agree.
constexpr double searches_per_box = 3;

double cells_of_box(const std::array<int, 3>& e) { return 2.0 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]); }

/// Estimates the columns of each crease: the fewest that tilts and theta allow. Walls usually limit a column to 45 deg.
std::vector<int> typical_columns(const targets::FoldNet& net, double theta, double tilt) {
  const double turn =
      std::clamp(2 * std::atan(std::tan(tilt) * std::sin(theta)), min_turn_per_column, max_turn_per_column);
  std::vector<int> out;
  for (const targets::FoldCrease& crease : net.creases)
    out.push_back(crease.columns > 0
                      ? crease.columns
                      : std::max(1, static_cast<int>(std::ceil(std::abs(crease.angle) / turn - 1e-9))));
  return out;
}

/// Returns the cell edge (mm) with which this many cells fold to the shortest edge of the box. @param across cells
double edge_of_cells(const FoldFile& file, const optim::FoldedNet& net, int across) {
  const auto& required_mm = *file.goal.box_mm;
  const auto shortest = std::min_element(required_mm.begin(), required_mm.end());
  const auto edges = optim::folded_box({across, across, across}, file.goal.open, 1, net.theta,
                                       net.layout.creases[0].columns());
  return *shortest / edges[shortest - required_mm.begin()];
}

/// Names the solid that a state is compared with. A box of given size is compared with the box that its cells fold to,
/// and tolerance.size limits the difference between the two.
std::string compared_with(const targets::FoldGoal& goal) {
  if (!goal.box_mm) return "the goal";
  return goal.open ? "the open box of these cells" : "the closed box of these cells";
}

bool searches_other_cells(const FoldFile& file) { return !file.robust && !file.limits.any(); }

/// Describes why the file's process cannot print such cells. Empty if it can.
std::string too_fine(const FoldFile& file, const model::CellSize& size) {
  const auto problems = print_problems(file.process, size, file.hinge.made);
  return problems.empty() ? "" : ", where " + problems.front().what;
}

/// Describes other cells that give the box its size, found by a search of each. If there are none, describes the size
/// that the present cells give.
std::string other_size(const FoldFile& file, const optim::FoldDesign& found, const RunOptions& options) {
  const char* looser = "a larger tolerance.size";
  if (!searches_other_cells(file))
    return fmt::format("try another cell edge (structure.cell_mm), or allow {}", looser);
  options.progress("other cells", -1, "");
  optim::BoxOptions box = *file.box;
  box.fold.threads = options.threads;
  box.fold.stop = options.stop;
  const auto better = optim::other_cells(box, file.size_tolerance);
  if (better)
    return fmt::format("structure.cell_mm: {:g} comes within {:.1f} %{}", better->edge_mm,
                       100 * optim::size_miss(better->folded_mm, *file.goal.box_mm),
                       too_fine(file, box.size(better->edge_mm)));
  if (options.stop.stop_requested())
    return fmt::format(
        "the search was stopped before it had tried all cells. Try another cell edge (structure.cell_mm), or "
        "allow {}",
        looser);
  const auto mm = edges_mm(file.goal, found);
  return fmt::format(
      "no cells of about {:.3g} to {:.3g} mm come as near; these fold to box_mm: [{:.1f}, {:.1f}, {:.1f}]. "
      "Request that box, or {}",
      edge_of_cells(file, found.folded, optim::max_cells_across), edge_of_cells(file, found.folded, 1), mm[0],
      mm[1], mm[2], looser);
}

/// Returns the edges of the box around a solid. It stands on its first face, with that face's first edge along x.
Eigen::Vector3d standing_size(const targets::Solid& solid) {
  const auto corner = [&](int k) -> const Eigen::Vector3d& { return solid.corners[solid.faces[0][k]]; };
  const Eigen::Vector3d x = (corner(1) - corner(0)).normalized();
  const Eigen::Vector3d z = x.cross(corner(2) - corner(1)).normalized();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& at : solid.corners)
    box.extend(Eigen::Vector3d(x.dot(at), z.cross(x).dot(at), z.dot(at)));
  return box.sizes();
}

// Typical final theta (rad) of searches for solids that the tilts limit. A smaller theta would need larger tilts.
constexpr double steep_theta = 22 * radians_per_degree;

/// Returns the columns of a crease at the start of a search: the fewest that fold the sharpest edge at steep_theta.
int columns_of_solid(const targets::Solid& solid, const FoldFile& file) {
  if (file.goal.solid->columns > 0) return file.goal.solid->columns;
  double sharpest = 0;
  for (const targets::SolidEdge& edge : edges_of(solid)) sharpest = std::max(sharpest, edge.turn);
  const double theta = std::clamp(steep_theta, file.theta.lower, file.theta.upper),
               turn = 2 * std::atan(std::tan(file.tilt) * std::sin(theta));
  return static_cast<int>(std::clamp(std::ceil(sharpest / turn), 1.0, 1.0 * optim::max_solid_columns));
}

constexpr double seconds_per_solid_body = 0.005;  // s per body, measured: search of columns and theta

class FoldGoal final : public Goal {
 public:
  explicit FoldGoal(FoldFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    if (file_.goal.solid) return forecast_solid();
    const targets::FoldNet& net = file_.goal.nets.front();
    const double theta = typical_theta(file_.theta);
    const std::vector<int> columns = typical_columns(net, theta, file_.tilt);
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
    if (file_.limits.any()) out.search_s += paths_to_limits * compensation_seconds(file_, out.sheet);
    if (file_.robust) out.search_s *= designs_of_robust_search(file_.theta, file_.hinge);
    return out;
  }

  SearchResult search(const RunOptions& options) const override {
    if (file_.goal.solid) return search_solid(options);
    SearchResult plain = search(file_, options);
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
    const FoldShape& shape = found.shape;
    auto out = std::make_shared<FoldMeasure>();
    out->error = of == StateOf::model ? shape.error : shape.error_of(state);
    out->tilt = shape.tilt;
    out->loads = found.loads;
    out->violations = of == StateOf::model && !shape.folds
                          ? shape.obstacles
                          : shape.violations(file_, out->error, describe(of));
    if (of == StateOf::physics) return out;
    if (!found.size_error_text.empty()) out->violations.push_back(found.size_error_text);
    if (of == StateOf::model) return out;
    for (std::size_t c = 0; c < out->tilt.size(); ++c)
      out->tilt[c] = mean_tilt(run.design.structure, shape.creases[c].hinges);
    if (!found.loads) return out;
    const HingeLoads loads = hinge_loads(run.equilibrium->path, run.equilibrium->drive, run.design.structure,
                                         run.design.hinge, run.design.hinge_overrides);
    out->loads = FoldLoads{run.theta, loads};
    model::append(app::violations(file_.limits, loads, "a smaller fold angle"), out->violations);
    return out;
  }

  /// Observes the offset of each face's vertices, in all directions, from the solid of the size that the search chose.
  std::optional<Observed> observe(const SearchResult& found, const model::Lattice& sheet,
                                  const model::State& state) const override {
    const FoldShape& shape = outcome_of<FoldOutcome>(found).shape;
    if (!shape.folds || !is_finite(state)) return std::nullopt;
    Observed out{{}, file_.shape_tolerance * shape.side * sheet.size().edge_mm * std::cos(shape.theta)};
    for (const targets::IdealPoint& v : shape.ideal(sheet, state))
      for (int k = 0; k < 3; ++k)
        out.points.push_back(
            {{v.body}, state[v.body].p, Eigen::Vector3d::Unit(k), (state[v.body].p - v.place)[k], 3});
    return out;
  }

 private:
  /// Returns the settings of the file that apply to any design.
  static SearchResult asked(const FoldFile& file) {
    SearchResult out;
    copy_settings(out, file);
    out.tolerances = {{"angle_deg", std::stod(targets::degrees_text(file.angle_tolerance))},
                      {"shape", file.shape_tolerance}};
    if (file.goal.box_mm) out.tolerances.emplace_back("size", file.size_tolerance);
    out.physics.when = PhysicsRequest::When::if_met;
    out.compared_with = compared_with(file.goal);
    return out;
  }

  SearchResult with_outcome(SearchResult out, FoldShape shape, LimitedLoads loads = {},
                            std::string size_error_text = {}) const {
    out.bounds = {file_.tilt, file_.theta};
    out.design.structure = shape.sheet;
    out.theta = shape.theta;
    auto found = std::make_unique<FoldOutcome>(std::move(shape));
    found->loads = std::move(loads.loads);
    found->unlimited = std::move(loads.unlimited);
    found->size_error_text = std::move(size_error_text);
    out.goal = std::move(found);
    return out;
  }

  SearchResult search(const FoldFile& file, const RunOptions& options) const {
    SearchResult out = asked(file);
    out.bounds = {file_.tilt, file_.theta};
    const optim::FoldOptions first = search_of(file, options);
    optim::FoldDesign design = fit_fold(file.goal, first, options.progress);
    const auto narrower = [&](double largest_theta) {
      optim::FoldOptions narrowed = first;
      narrowed.theta.upper = largest_theta;
      return fit_fold(file.goal, narrowed);
    };
    LimitedLoads loads = keep_limits(file, out, *this, design, narrower, options);
    std::string size_error_text = describe_size_miss(file, design, options);
    return with_outcome(std::move(out), shape_of(file.goal, design), std::move(loads),
                        std::move(size_error_text));
  }

  SearchResult search_solid(const RunOptions& options) const {
    const targets::SolidGoal& goal = *file_.goal.solid;
    return with_outcome(asked(file_), shape_of(goal, fit_solid(goal.shape, goal.cells, goal.columns,
                                                               search_of(file_, options), options.progress)));
  }

  Forecast forecast_solid() const {
    const targets::SolidGoal& goal = *file_.goal.solid;
    const targets::Solid solid = goal.shape;
    const auto net = lay_out(solid, goal.cells, columns_of_solid(solid, file_), file_.size);
    Forecast out{net.structure};
    out.folded_mm =
        net.edge * file_.size.edge_mm * std::cos(typical_theta(file_.theta)) * standing_size(solid);
    out.search_s = out.sheet.bodies() * seconds_per_solid_body;
    add_settings(file_, out);
    return out;
  }

  /// Returns the expected error of a box's edges as a ratio to those required; 0 if the box is given in cells.
  double likely_miss() const {
    return file_.box ? optim::size_miss(file_.box_folded_mm, file_.box->required_mm) : 0;
  }

  /// Adds the time of other_size() to a forecast: searches of small boxes, and of whole boxes if cells nearly fit.
  void add_other_cells(double miss, Forecast& forecast) const {
    const std::string off =
        fmt::format("with these cells the box would be off by {:.1f} %; {:.1f} % is allowed", 100 * miss,
                    100 * file_.size_tolerance);
    if (!searches_other_cells(file_)) return forecast.notes.push_back(off);
    const double bodies_per_cell = forecast.sheet.bodies() / cells_of_box(*file_.goal.box);
    double box_searches = 0, folds = 0;  // s: searches of small boxes and of whole boxes
    for (std::array<int, 3> edges : optim::tried_cells(*file_.box, file_.size_tolerance)) {
      folds += search_seconds(bodies_per_cell * cells_of_box(edges));
      for (int& edge : edges) edge = std::min(edge, optim::test_box_cells);
      box_searches += searches_per_box * search_seconds(bodies_per_cell * cells_of_box(edges));
    }
    forecast.search_s += box_searches;
    forecast.notes.push_back(fmt::format(
        "{}: the search continues with other cells, for {}, or up to {} where many of them nearly fit", off,
        about(box_searches), about(box_searches + folds)));
  }

  /// Describes the size error of the box, with advice. Empty if the size is met.
  std::string describe_size_miss(const FoldFile& file, const optim::FoldDesign& design,
                                 const RunOptions& options) const {
    if (!file.goal.box_mm || !design.folds) return "";
    const double miss = optim::size_miss(edges_mm(file.goal, design), *file.goal.box_mm);
    if (miss <= file_.size_tolerance) return "";
    return fmt::format(
        "an edge of the box is {:.1f} % longer or shorter than requested; at most {:.1f} % is allowed: {}",
        100 * miss, 100 * file_.size_tolerance, other_size(file, design, options));
  }

  FoldFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(FoldFile file) { return std::make_unique<FoldGoal>(std::move(file)); }

extern const GoalKind fold_kind = {
    .name = "fold",
    .example = "target: {kind: fold, box: [4, 4, 4]}",
    .meaning = "net that folds into a box, a tray or a solid",
    .read = [](const targets::Node& root) { return make_goal(read_fold_file(root)); },
    .table = fold_keys,
    .metrics = {
        {"fold_deg", "deg", "[fold of each crease](#face_rms), a list"},
        {"fold_miss_deg", "deg", "largest difference between the fold of a crease and its goal"},
        {"face_rms", "",
         "[distance of the faces' vertices from the ideal solid](#face_rms), relative to the edge of a face"},
        {"fold_physics_deg", "deg", "fold of each crease in the simulation, a list"},
        {"fold_miss_physics_deg", "deg", "fold_miss_deg in the simulation"},
        {"face_rms_physics", "", "face_rms in the simulation"}}};

}  // namespace kinetix::app
