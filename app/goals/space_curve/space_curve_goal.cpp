#include "app/goals/space_curve/space_curve_goal.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/files/file_header.hpp"
#include "app/files/structure_section.hpp"
#include "app/goals/strip_remedies.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/result/result_json.hpp"
#include "app/run/goal.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int min_columns = 4, most_columns = 400;  // the search takes some seconds for 400 columns
// Theta (rad) at which a strip has the length of the curve, if the file does not fix both cell edge and cells.
constexpr double default_strip_theta = 30 * radians_per_degree;
// Fewest columns by default: for a helix of two turns, 16 columns miss the tolerance and 24 meet it.
constexpr int min_usual_columns = 24;
// Length of a climbing strip in plan view, as a ratio to the length of the curve (measured: 0.96 to 1).
constexpr double seen_length = 0.95;
constexpr double smallest_cell_mm = 0.1;  // mm: smaller cells suggest that the points are in metres
// Theta, degrees: at 45 basic cells are closed.
const targets::Bounds folds = targets::between(0, 45, "degrees");
const targets::Bounds tilt = targets::between(-89, 89, "degrees");

targets::KeyTable space_curve_structure_keys(const SpaceCurveFile& usual) {
  return targets::KeyTable({
      cells_key(
          targets::by_default({static_cast<double>(usual.variables.columns), 1.0}),
          "[columns, 1]. The default is reduced, to 24 columns at least, if the process cannot print such "
          "thin walls and fewer columns can follow the curve. If only `cell_mm` is given, the number of "
          "columns follows from the length of the curve"),
      cell_mm_key(targets::otherwise("gives the strip the curve's length")),
      wall_mm_key(),
  });
}

targets::KeyTable strip_variables_keys() {
  using Variables = optim::SpaceVariables;
  static const Variables usual{};
  const targets::KeyTable beta(
      {{"range_deg", value::angle_range(tilt), targets::by_default_deg(-usual.beta, usual.beta),
        "tilts of bending columns. The end nearer to 0 limits both signs"}});
  const targets::KeyTable t({{"range", &Variables::t, value::range(targets::place_along),
                              "allowed positions of hinges of shearing columns along their walls. The end "
                              "nearer to 0.5 limits both sides"}});
  const targets::KeyTable theta(
      {{"range_deg", &Variables::theta, value::angle_range(folds),
        "fold angle of the folded state. Without `cell_mm` the search tries several within the range"}});
  return targets::KeyTable({
      targets::Key("tilt", beta, "tilts of the hinges").formerly("beta"),
      targets::Key("hinge_position", t, "positions of the hinges along their walls").formerly("t"),
      targets::Key("fold_angle", theta, "fold angle of the strip").formerly("theta"),
  });
}

int read_columns(const targets::Node& node) {
  const auto sides = as_rectangle(read_cells(node));
  if (!sides || (*sides)[1] != 1)
    throw node.error("a curve in space needs a strip of one row of cells. Give [columns, 1]");
  if ((*sides)[0] < min_columns || (*sides)[0] > most_columns)
    throw node.error(fmt::format("a strip of {} columns is not possible here. Give {} to {}", (*sides)[0],
                                 min_columns, most_columns));
  return (*sides)[0];
}

double typical_edge(const SpaceCurveFile& file) {
  return file.wanted.length() / (file.variables.columns * std::cos(default_strip_theta));
}

/// Returns the default number of columns, for a file that leaves all sizes open. It is the largest number that the
/// process can print with walls by default_size, at the lower end of theta, where cells are smallest.
///
/// The number is between 24 and the usual one. It is the usual one if such wide columns cannot follow the curve.
int printable_columns(const SpaceCurveFile& file, const model::Process& process) {
  const double min_mm = min_cell_mm(process, default_size(1), {}),
               most = seen_length * file.wanted.length() / (min_mm * std::cos(file.variables.theta.lower));
  SpaceCurveFile fewer = file;
  fewer.variables.columns = static_cast<int>(std::clamp(
      std::floor(most), static_cast<double>(min_usual_columns), static_cast<double>(file.variables.columns)));
  fewer.variables.size = default_size(typical_edge(fewer));
  return obstacle(fewer.wanted, fewer.variables) ? file.variables.columns : fewer.variables.columns;
}

// Cell edge over the thickness of given walls: less leaves no room to fold.
constexpr double least_edge_ratio = 2.5;

/// Returns the default number of columns between walls that a file gives: as many as fit between 24 and the usual one.
int columns_between_walls(const targets::Section& structure, const SpaceCurveFile& file) {
  SpaceCurveFile fewest = file;
  fewest.variables.columns = min_usual_columns;
  const double thickness_mm = read_size(structure, typical_edge(fewest)).thickness_mm;
  const double most = seen_length * file.wanted.length() /
                      (least_edge_ratio * thickness_mm * std::cos(file.variables.theta.lower));
  return static_cast<int>(std::clamp(std::floor(most), static_cast<double>(min_usual_columns),
                                     static_cast<double>(file.variables.columns)));
}

void check_unit(const targets::Section& root, const SpaceCurveFile& file) {
  if (typical_edge(file) >= smallest_cell_mm) return;
  throw root.required("target", "")
      .error(
          fmt::format("the curve is {:.3g} mm long, and {} cells on it would have {:.3g} mm. Give points in "
                      "millimetres, or structure.cell_mm for a curve this small",
                      file.wanted.length(), file.variables.columns, typical_edge(file)));
}

/// Reads `structure`. @pre the variables are read
void read_structure(const targets::Section& root, SpaceCurveFile& file) {
  const targets::Section structure = root.section("structure");
  const double length = file.wanted.length();
  optim::SpaceVariables& v = file.variables;
  const auto cells = structure.optional("cells");
  const auto cell_mm = structure.optional("cell_mm");
  if (cells) v.columns = read_columns(*cells);
  v.free_edge = !cell_mm;
  v.free_walls = !structure.optional("wall_mm");
  if (v.free_edge) check_unit(root, file);
  if (v.free_edge && v.free_walls && !cells)
    v.columns = root.section("target").required("points", "").located([&] {
      return printable_columns(file, read_process(root));
    });
  else if (v.free_edge && !cells)
    v.columns = columns_between_walls(structure, file);
  v.size = read_size(structure, typical_edge(file));
  if (!cell_mm || cells) return;
  const double fitting = std::round(length / (v.size.edge_mm * std::cos(default_strip_theta)));
  if (!(fitting >= min_columns && fitting <= most_columns))
    throw cell_mm->error(
        fmt::format("a curve of {:.3g} mm needs {:.0f} cells of {:.3g} mm. Give cells for {} to {} columns",
                    length, fitting, v.size.edge_mm, min_columns, most_columns));
  v.columns = static_cast<int>(fitting);
}

void read_variables(const targets::Section& root, SpaceCurveFile& file) {
  const targets::Section variables = root.section("variables");
  optim::SpaceVariables& v = file.variables;
  const targets::Section beta = variables.section("tilt");
  std::array<double, 2> tilts = {-v.beta, v.beta};
  beta.read("range_deg", tilts);
  if (!(tilts[0] < 0 && tilts[1] > 0))
    throw beta.optional("range_deg")
        ->error("the range does not contain 0, an upright hinge. Give a range around 0");
  v.beta = std::min(-tilts[0], tilts[1]);
  root.read_into(v);
  if (!(v.t[0] < 0.5 && v.t[1] > 0.5))
    throw variables.section("hinge_position")
        .optional("range")
        ->error("the range does not contain 0.5, where hinges start. Give a range around 0.5");
}

/// Checks that cells of a given size and number can have the length of the curve.
void check_length(const targets::Section& root, const SpaceCurveFile& file) {
  const optim::SpaceVariables& v = file.variables;
  if (v.free_edge) return;
  const double straight = v.columns * v.size.edge_mm;
  const double least = straight * std::cos(v.theta.upper), most = straight * std::cos(v.theta.lower);
  // A climbing curve is longer than the strip below it, by up to a third at the steepest slope.
  if (file.wanted.length() >= 0.9 * least && file.wanted.length() <= 1.33 * most) return;
  throw root.section("structure")
      .optional("cell_mm")
      ->error(fmt::format("{} cells of {:.3g} mm span {:.3g} to {:.3g} mm within the range of the fold "
                          "angle, and the curve is {:.3g} mm long. Change cell_mm or cells",
                          v.columns, v.size.edge_mm, least, most, file.wanted.length()));
}

}  // namespace

const targets::KeyTable& space_curve_keys() {
  static const SpaceCurveFile usual(targets::SpaceGoal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::space_curve_target_keys(), "the goal", targets::needed},
          {"structure", space_curve_structure_keys(usual), "flat strip"},
          {"variables", strip_variables_keys(), "quantities that the search changes, with their ranges"},
          {"tolerance",
           targets::KeyTable({
               {"shape", &SpaceCurveFile::shape_tolerance, value::number(targets::part_of_one),
                targets::by_default(usual.shape_tolerance),
                "limit of [shape_rms](#shape_rms-and-shape_max), relative to the diagonal of the curve's "
                "bounding box"},
               verify_key(),
           }),
           "limits for a met goal"},
      },
      sized_hinge, {robust_key()});
  return keys;
}

SpaceCurveFile read_space_curve_file(const targets::Node& node) {
  const targets::Section root = read_root(node, space_curve_keys());
  const targets::Section target = root.section("target");
  const targets::Node points =
      target.required("points", "the path of a file or a list of points [[x, y, z], ...] in mm");
  std::vector<std::string> notes;
  SpaceCurveFile file(
      targets::read_space_goal(target, !root.section("structure").optional("cell_mm"), notes));
  file.input_notes = std::move(notes);
  read_variables(root, file);
  read_structure(root, file);
  root.read_into(file);
  check_length(root, file);
  file.obstacle = points.located([&] { return obstacle(file.wanted, file.variables); });
  read_hinges(root, file.variables.free_edge ? std::nullopt : std::optional(file.variables.size), file);
  read_settings(root, file.variables.size.edge_mm, file);
  return file;
}

namespace {

using Json = nlohmann::ordered_json;

class SpaceCurveMeasure final : public Measure {
 public:
  std::vector<Eigen::Vector3d> midline;  ///< in the frame of the model's state, mm
  targets::SpaceError error;
};

Json space_points_json(const std::vector<Eigen::Vector3d>& points) {
  Json out = Json::array();
  for (const Eigen::Vector3d& p : points) out.push_back({p.x(), p.y(), p.z()});
  return out;
}

Json distances_json(const targets::SpaceError& error) {
  Json out = Json::array();
  for (std::size_t k = 0; k < error.arc_mm.size(); ++k)
    out.push_back({error.arc_mm[k], error.distance_mm[k]});
  return out;
}

/// Lists the turn of each bending column and the climb of each shearing column. The midline of a bending column has
/// half of the column's turn. @param midline of a state whose width is along y
Json columns_json(const std::vector<Eigen::Vector3d>& midline) {
  Json out = Json::array();
  double before = 0;  // heading, rad
  for (int k = 0; k + 1 < static_cast<int>(midline.size()); ++k) {
    const Eigen::Vector3d chord = midline[k + 1] - midline[k];
    const double heading = std::atan2(chord.z(), chord.x());
    if (optim::SpaceStrip::bends(k))
      out.push_back({{"column", k}, {"turn_deg", to_degrees(2 * std::remainder(heading - before, 2 * pi))}});
    else
      out.push_back({{"column", k}, {"climb", chord.y() / std::hypot(chord.x(), chord.z())}});
    before = heading;
  }
  return out;
}

/// Section of a result for a curve in space. The goal is met if the shape is within tolerance and no walls collide.
struct SpaceCurveOutcome final : GoalOutcome {
  explicit SpaceCurveOutcome(SpaceCurveFile asked) : file(std::move(asked)) {}

  SpaceCurveFile file;
  optim::SpaceDesign found;
  model::Pose place;  ///< pose of the goal in the frame of the model's state, mm

  void add_sections(const Run& run, Json& result) const override {
    result["target"] = {{"kind", "space_curve"}, {"points_mm", space_points_json(file.wanted.points())}};
    const auto& shape = measure_of<SpaceCurveMeasure>(run);
    const targets::SpaceError& error = shape.error;
    Json section = {
        {"goal_mm", space_points_json(error.goal_mm)},
        {"error", distances_json(error)},
        {"diagonal_mm", error.scale_mm},
        {"slope", found.across.slope},
        {"across", {found.across.direction.x(), found.across.direction.y(), found.across.direction.z()}},
        {"columns", columns_json(shape.midline)},
        {"walls_meet", found.contact.touches},
        {"reasons", run.violations},
        {"reasons_physics", run.physics_violations()}};
    if (const auto* physics = physics_measure_of<SpaceCurveMeasure>(run))
      section["physics"] = {{"rms", physics->error.rms}, {"max", physics->error.max}};
    result["space_curve"] = section;
    result["optimiser"] = search_json(found.search, std::max(1, found.tried));
  }
  void add_metrics(const Run& run, Json& metrics) const override {
    const targets::SpaceError& error = measure_of<SpaceCurveMeasure>(run).error;
    metrics["shape_rms"] = error.rms;
    metrics["shape_max"] = error.max;
    if (const auto* physics = physics_measure_of<SpaceCurveMeasure>(run))
      metrics["shape_rms_physics"] = physics->error.rms;
    metrics["met"] = run.met();
  }
  std::vector<SummaryLine> summary_lines(const Run& run) const override {
    const targets::SpaceError& error = measure_of<SpaceCurveMeasure>(run).error;
    std::vector<SummaryLine> lines = {
        describe_shape(error.rms, error.max, error.scale_mm, file.shape_tolerance)};
    const Eigen::Vector3d& y = found.across.direction;
    lines.push_back(
        {"across",
         fmt::format("strip width along [{:.3f}, {:.3f}, {:.3f}]; slope of the curve in this direction at "
                     "most {:.3f}",
                     y.x(), y.y(), y.z(), found.across.slope)});
    lines.push_back({"search", fmt::format("{:.2g} s, {} evaluations, {}", run.timings.optimise,
                                           found.search.evaluations, to_string(found.search.status))});
    return lines;
  }
};

/// Describes violations of the shape tolerance. @param who "model", "equilibrium" or "simulation"
std::vector<std::string> violations(const SpaceCurveOutcome& outcome, const targets::SpaceError& error,
                                    const std::string& who) {
  const double tolerance = outcome.file.shape_tolerance;
  if (error.rms <= tolerance) return {};
  return {fmt::format("{}: rms {:.3g} of the goal's diagonal; at most {:g} is allowed{}", who, error.rms,
                      tolerance, outcome.found.obstacle ? "; " + outcome.found.obstacle->why : "")};
}

// Search time in s for 96 columns, measured; it grows with the third power of their number.
constexpr double seconds_of_96 = 0.3;

// Searches for a goal out of reach at most: two directions, and up to four narrowings at each of five fold angles.
constexpr double searches_of_nearest = 26;

// Simulated time in s per column until the ends of a strip driven at its middle are at rest, measured.
constexpr double settling_seconds_per_column = 0.06;

// Half width of the interval that gives the goal's direction at a point, as a ratio to the goal's length.
constexpr double direction_reach = 1e-3;

class SpaceCurveGoal final : public Goal {
 public:
  explicit SpaceCurveGoal(SpaceCurveFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const int columns = file_.variables.columns;
    Forecast out{sheet_of(model::ExactDesign<double>::basic(columns, 1), file_.variables.size)};
    out.folded_mm = model::box_of(file_.wanted.points()).sizes();
    out.search_s = seconds_of_96 * std::pow(columns / 96.0, 3);
    if (file_.obstacle) {
      out.search_s *= searches_of_nearest;
      out.notes.push_back("the strip will miss the curve or be at its limits: " + file_.obstacle->why);
    }
    add_settings(file_, out);
    if (file_.robust) out.search_s *= designs_of_robust_search(tried_theta(), file_.hinge);
    return out;
  }

  SearchResult search(const RunOptions& options) const override {
    SearchResult plain = search(file_, options);
    if (!file_.robust) return plain;
    return search_robustly(
        std::move(plain), *this, *file_.robust, tried_theta(),
        [&](const RobustTrial& trial, const RunOptions& quiet) {
          SpaceCurveFile file = file_;
          file.hinge = trial.hinge;
          file.variables.theta = trial.theta.value_or(file.variables.theta);
          if (trial.theta) file.variables.thetas = 1;
          return search(file, quiet);
        },
        options);
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    const auto& outcome = outcome_of<SpaceCurveOutcome>(run);
    auto out = std::make_shared<SpaceCurveMeasure>();
    out->midline = optim::space_midline(aligned(state, run.own));
    out->error = space_error(out->midline, file_.wanted, outcome.place);
    out->violations = violations(outcome, out->error, describe(of));
    out->distance = out->error.rms / outcome.file.shape_tolerance;
    const model::ContactLimit& contact = outcome.found.contact;
    if (of != StateOf::physics && contact.touches)
      out->violations.push_back(describe_overlap(contact, outcome.found.design.theta, run.design.structure));
    return out;
  }

  std::vector<targets::DocumentChanges> remedies(const Run& missed) const override {
    const optim::SpaceVariables& v = file_.variables;
    MissedStrip strip{.columns = v.columns,
                      .tilt = v.beta,
                      .fold_angle = v.theta,
                      .hinge_position = std::min(v.t[1], 1 - v.t[0]),
                      .walls_meet = outcome_of<SpaceCurveOutcome>(missed).found.contact.touches,
                      .size = missed.design.structure.size()};
    if (!v.free_edge) strip.cell_mm = v.size.edge_mm;
    strip.is_steep = file_.obstacle && file_.obstacle->climbs;
    return strip_remedies(strip);
  }

  /// Observes the offset of each column from the nearest point of the goal, in two directions.
  std::optional<Observed> observe(const SearchResult& found, const model::Lattice& sheet,
                                  const model::State& state) const override {
    const auto& outcome = outcome_of<SpaceCurveOutcome>(found);
    const model::Pose motion = motion_onto(state, found.own);
    const std::vector<Eigen::Vector3d> midline = optim::space_midline(moved(state, motion));
    const targets::SpaceCurve goal(space_error(midline, file_.wanted, outcome.place).goal_mm);
    const std::vector<std::vector<int>> columns = body_columns(sheet);
    Observed out{{}, file_.shape_tolerance * file_.wanted.diagonal()};
    const Eigen::Matrix3d back = motion.R.transpose();
    for (std::size_t k = 0; k < midline.size(); ++k) {
      const double s = goal.nearest(midline[k]);
      const Eigen::Vector3d place = back * (midline[k] - motion.p), off = midline[k] - goal.at(s);
      // Both directions are perpendicular to the goal: a motion along it does not change the distance.
      const Eigen::Vector3d along = goal.direction(s, direction_reach * file_.wanted.length());
      const Eigen::Vector3d square = off - off.dot(along) * along;
      const Eigen::Vector3d away =
          square.norm() > 0 ? Eigen::Vector3d(square.normalized()) : along.unitOrthogonal();
      out.points.push_back({columns[k], place, back * away, off.dot(away), 2});
      out.points.push_back({columns[k], place, back * along.cross(away), 0, 2});
    }
    return out;
  }

 private:
  SearchResult search(const SpaceCurveFile& file, const RunOptions& options) const {
    SearchResult out;
    copy_settings(out, file);
    options.progress("search", 0);
    auto outcome = std::make_unique<SpaceCurveOutcome>(file);
    out.tolerances = {{"shape", file.shape_tolerance}};
    optim::SolverOptions solver;
    follow(options, file.wanted.diagonal(), solver);
    outcome->found = fit_space_curve(file.wanted, file.variables, solver);
    const model::Structure strip = sheet_of(outcome->found.design, outcome->found.size);
    out.design.structure = strip;
    out.theta = outcome->found.design.theta;
    out.plan.exact = exact_motion(strip);
    const model::Pose motion = motion_onto(fold(outcome->found.design, strip), out.plan.exact.at(out.theta));
    outcome->place = {motion.R * outcome->found.place.R, motion.R * outcome->found.place.p + motion.p};
    out.goal = std::move(outcome);
    out.is_strip = true;
    out.is_aligned = true;
    out.bounds = {file_.variables.beta, file_.variables.theta};
    const model::Wall middle = {{file_.variables.columns / 2, 0}, model::Axis::y};
    out.physics = {.drive = drive_on(strip, hinge_drive_to(strip, middle, out.theta)),
                   .min_settle_s = settling_seconds_per_column * file_.variables.columns};
    return out;
  }

  /// Returns the range of theta for a robust search; nullopt if the cell edge is fixed.
  std::optional<optim::AngleRange> tried_theta() const {
    return file_.variables.free_edge ? std::optional(file_.variables.theta) : std::nullopt;
  }

  SpaceCurveFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(SpaceCurveFile file) {
  return std::make_unique<SpaceCurveGoal>(std::move(file));
}

extern const GoalKind space_curve_kind = {
    .name = "space_curve",
    .example = "target: {kind: space_curve, points: helix.csv}",
    .meaning = "strip that folds into a curve in space",
    .file = {{"points", "x,y,z"}},
    .read = [](const targets::Node& root) { return make_goal(read_space_curve_file(root)); },
    .table = space_curve_keys,
    .metrics = {{"shape_rms", "",
                 "[distance of midline and goal](#shape_rms-and-shape_max), root mean square"},
                {"shape_max", "", "largest distance of midline and goal"},
                {"shape_rms_physics", "", "shape_rms in the simulation"}},
    .keeps_length = true};

}  // namespace kinetix::app
