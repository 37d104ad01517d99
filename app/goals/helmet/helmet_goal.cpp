#include "app/goals/helmet/helmet_goal.hpp"

#include <fmt/format.h>

#include "app/console/short_form.hpp"
#include "app/files/file_header.hpp"
#include "app/files/structure_section.hpp"
#include "app/goals/ribs/ribs_goal.hpp"
#include "app/models/model_file.hpp"
#include "app/result/result_json.hpp"
#include "app/result/state_json.hpp"
#include "app/run/goal.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr double share_of_coverage = 1.0 / 30;  // allowed error over coverage: 3 mm for the usual 90 mm
constexpr double helmet_cell_mm = 6;            // a tenth of a head's radius: ribs can follow its curves
constexpr int max_ribs = 200;                   // input limit: one rib per two millimetres of a head
constexpr double min_helmet_cell_mm = 1;        // for cells and rib spacing: less makes too many cells
constexpr double max_cell_mm = 60;              // about a head's radius: larger cells cannot follow it

targets::KeyTable helmet_target_keys() {
  using Spec = optim::RibsSpec;
  std::vector<targets::Key> keys = targets::head_keys();
  keys.insert(keys.begin(), targets::goal_kind_key("helmet"));
  keys.insert(
      keys.end(),
      {{"ribs", &Spec::ribs, value::integer(1, max_ribs), "number of ribs, evenly spaced along the spine"},
       {"spacing_mm", &Spec::spacing_mm, value::number(targets::from_to(min_helmet_cell_mm, 1000, "mm")),
        targets::otherwise("follows from `ribs`"),
        "distance of the ribs, instead of their number. The number of evenly spaced ribs with the nearest "
        "distance is used"},
       targets::coverage_key(),
       {"clearance_mm", &Spec::clearance_mm, value::number(targets::from_to(0, 100, "mm")),
        "distance of the helmet from the head"}});
  return targets::KeyTable(std::move(keys));
}

targets::KeyTable helmet_structure_keys() {
  return targets::KeyTable({cell_mm_key(targets::by_default(helmet_cell_mm),
                                        targets::from_to(min_helmet_cell_mm, max_cell_mm, "mm")),
                            wall_mm_key()});
}

void read_structure(const targets::Section& root, HelmetFile& file) {
  const auto node = root.optional("structure");
  if (const auto cells = node ? node->optional("cells") : std::nullopt)
    throw cells->key_error(
        "the cells of a helmet follow from the head. Remove the key, and set target.ribs and "
        "structure.cell_mm");
  file.spec.size = read_size(root.section("structure"), helmet_cell_mm);
}

void read_ribs(const targets::Section& target, HelmetFile& file) {
  const auto ribs = target.optional("ribs"), spacing = target.optional("spacing_mm");
  if (ribs && spacing)
    throw spacing->key_error(
        "cannot be combined with target.ribs, which also sets the distance. Remove one of the two keys");
  target.read_into(file.spec);
  if (spacing && *file.spec.spacing_mm < 2 * file.spec.size.edge_mm * std::cos(file.spec.start_theta))
    throw spacing->error("ribs at this distance overlap in the flat sheet. Give at least two cells, " +
                         targets::shortest_text(2 * file.spec.size.edge_mm) + " mm flat");
  file.spec.coverage_mm = file.head.coverage_mm;
}

void read_variables(const targets::Section& root, optim::RibsSpec& spec) {
  const NetVariables read = read_net_variables(root, spec.size, {spec.tilt, spec.theta});
  spec.tilt = read.tilt;
  spec.theta = {read.theta.lower, std::min(read.theta.upper, closing_theta(spec.size))};
  spec.start_theta = std::clamp(spec.start_theta, spec.theta.lower, spec.theta.upper);
}

/// Returns the default maximum error in mm: the value for adults, scaled down for small heads and small cells.
double default_max_mm(const HelmetFile& file) {
  return std::min({HelmetFile::default_max_mm, GoalSettings::grain * file.spec.size.edge_mm,
                   share_of_coverage * file.head.coverage_mm});
}

void read_tolerance(const targets::Section& root, HelmetFile& file) {
  file.max_mm = default_max_mm(file);
  file.rms_mm = HelmetFile::default_rms_mm * file.max_mm / HelmetFile::default_max_mm;
  root.read_into(file);
}

/// Rejects solvers and solver keys that only apply to other kinds of goals.
void check_solver(const targets::Section& root) {
  const auto solver = root.optional("solver");
  if (!solver || solver->kind() != targets::Node::Kind::map) return;
  if (const auto starts = solver->optional("starts"))
    throw starts->key_error(
        "a helmet has a single start, the net that is laid out on the head. Remove the key");
  const auto name = solver->optional("name");
  if (name && read_solver_name(*name) != optim::SolverName::ceres)
    throw name->error("the hundreds of tilts of a helmet need second-order steps. Give ceres");
}

}  // namespace

const targets::KeyTable& helmet_keys() {
  static const optim::RibsSpec usual{};
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", helmet_target_keys(), "the goal", targets::needed},
          {"structure", helmet_structure_keys(), "flat helmet"},
          {"variables", net_variables_keys(usual.tilt, usual.theta),
           "quantities that the search changes, with their ranges"},
          {"tolerance",
           targets::KeyTable({
               {"rms_mm", &HelmetFile::rms_mm, value::number(targets::above(0, "mm")),
                targets::otherwise(
                    fmt::format("{:g}; less with a smaller `max_mm` by default", HelmetFile::default_rms_mm)),
                "limit of the [distance](#distances-of-a-helmet) from head plus clearance, root mean square"},
               {"max_mm", &HelmetFile::max_mm, value::number(targets::above(0, "mm")),
                targets::otherwise(
                    fmt::format("{:g}, or less: half a cell or a thirtieth of `target.coverage_mm`",
                                HelmetFile::default_max_mm)),
                "limit of the largest distance"},
               {"covered_share", &HelmetFile::covered_share, value::number(targets::Bounds{0, 1, true, true}),
                targets::otherwise("no limit"), "minimum of [covered_share](#covered_share)"},
               verify_key(),
           }),
           "limits for a met goal"},
          {"solver", solver_keys({optim::SolverName::ceres}, {}, helmet_evaluations, "of the search"),
           "solver of the search"},
      },
      any_hinge);
  return keys;
}

HelmetFile read_helmet_file(const targets::Node& node) {
  const targets::Section root = read_root(node, helmet_keys());
  const targets::Section target = root.section("target");
  // A separate statement, because GCC 12 frees bases twice if a later initializer throws.
  targets::Head head = read_head(target, read_mesh_file);
  HelmetFile file{{}, std::move(head)};
  file.input_notes = file.head.notes;
  read_structure(root, file);
  read_variables(root, file.spec);
  read_ribs(target, file);
  check_solver(root);
  read_tolerance(root, file);
  read_settings(root, file.spec.size.edge_mm, file);
  read_hinges(root, file.spec.size, file);
  return file;
}

namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

const Vector3d crown = Vector3d::Zero();  // mm, the origin of the head's frame
constexpr int points_per_curve = 60;      // points per drawn line: about one every 6 mm over a head
constexpr int head_curves = 9;            // sections of the head in the report: enough to show its shape

/// Returns curves of the head for pictures: its profile and sections across it, in the head's frame.
std::vector<std::vector<Eigen::Vector3d>> head_curves_of(const targets::Head& head) {
  std::vector<std::vector<Eigen::Vector3d>> out = {head.profile.evenly(points_per_curve)};
  for (int k = 0; k < head_curves; ++k) {
    const double s = head.profile.first() + head.profile.length() * (k + 0.5) / head_curves;
    out.push_back(cross_section(head, s, 10).evenly(points_per_curve));
  }
  return out;
}

/// Returns the mean distance of each cell's four bodies, in the order of the structure's cells.
Json by_cell(const model::Structure& structure, const optim::RibsError& error) {
  Json cells = Json::array();
  for (const model::CellHinges& cell : structure.cell_members) {
    double sum = 0;
    for (const int body : cell.bodies) sum += error.of_body[body];
    cells.push_back(sum / 4);
  }
  return cells;
}

double worst_rib(const optim::RibsError& error) {
  return error.of_ribs.empty() ? 0 : *std::max_element(error.of_ribs.begin(), error.of_ribs.end());
}

Json error_json(const optim::RibsError& error) {
  return {{"rms_mm", error.rms}, {"max_mm", error.max}, {"rib_rms_mm", worst_rib(error)}};
}

Json error_json(const optim::RibsError& error, const targets::WallsInside& inside) {
  Json out = error_json(error);
  out["walls_inside"] = inside.hinges.size();
  out["corners_inside"] = inside.corners;
  out["inside_mm"] = inside.depth_mm;
  return out;
}

Json openings_json(const std::vector<targets::DomeOpening>& openings) {
  Json out = Json::array();
  for (const targets::DomeOpening& opening : openings)
    out.push_back({{"width_mm", opening.width_mm}, {"top_mm", opening.top_z}});
  return out;
}

std::string describe(const optim::RibsError& error) {
  return fmt::format("{} mm rms from the head plus clearance, {} mm at most", format_figures(error.rms),
                     format_figures(error.max));
}

/// Describes holes of the mesh in the covered part of the head. Empty without holes.
std::string invented(const std::vector<targets::DomeOpening>& openings) {
  if (openings.empty()) return "";
  double widest = 0;
  for (const targets::DomeOpening& opening : openings) widest = std::max(widest, opening.width_mm);
  const std::string holes = openings.size() == 1 ? "a hole" : fmt::format("{} holes", openings.size());
  return fmt::format(
      "the scan has {} in the covered part, {}{:.0f} mm across. A dome closes it, so the fit there is not to "
      "the "
      "real head",
      holes, openings.size() == 1 ? "" : "the widest ", widest);
}

/// Describes walls inside the head, and names the clearance if it is too small for the wall height.
std::string describe(const targets::WallsInside& inside, const HelmetFile& file, const std::string& who) {
  const double reach = file.spec.size.height_mm / 2;
  std::string text = fmt::format("{}: {} wall{} in the head", who, inside.hinges.size(),
                                 inside.hinges.size() == 1 ? " lies" : "s lie");
  if (inside.depth_mm > 0) text += fmt::format(", up to {:.2g} mm deep", inside.depth_mm);
  if (file.spec.clearance_mm < reach)
    text += fmt::format(": clearance_mm is {:g}, less than half the height of the walls, {:g} mm",
                        file.spec.clearance_mm, reach);
  return text;
}

/// Helmet section of a result.
class HelmetOutcome final : public RibsOutcome {
 public:
  HelmetOutcome(const RibsTask& task, HelmetFile file, optim::RibsDesign found)
      : RibsOutcome(task, std::move(found)), file_(std::move(file)) {}

  void evaluate(const model::Lattice& sheet, StateOf of, const model::State& state,
                RibsMeasure& measure) const override {
    const std::string who = app::describe(of);
    const optim::RibsError& error = measure.error;
    measure.inside = walls_inside(sheet, state, file_.head.scan);
    if (!file_.head.openings.empty()) measure.warnings = {invented(file_.head.openings)};
    std::vector<std::string>& why = measure.violations;
    if (!measure.inside.hinges.empty()) why.push_back(describe(measure.inside, file_, who));
    if (!(error.rms <= file_.rms_mm))
      why.push_back(fmt::format("{}: {:.2f} mm rms from head plus clearance; at most {:g} mm is allowed", who,
                                error.rms, file_.rms_mm));
    if (!(error.max <= file_.max_mm))
      why.push_back(fmt::format("{}: up to {:.2f} mm from head plus clearance; at most {:g} mm is allowed",
                                who, error.max, file_.max_mm));
  }

  std::vector<std::string> bare() const override {
    if (is_covered()) return {};
    return {
        fmt::format("model: {:.0f} % of the head above the rim lies within a cell edge of a rib; at least "
                    "{:.0f} % is required "
                    "(`tolerance.covered_share`). Give more `target.ribs`",
                    100 * cover.share, 100 * *file_.covered_share)};
  }

  void add_sections(const Run& run, Json& result) const override {
    const auto drawn = [&](const targets::SpaceCurve& curve) { return line(curve.evenly(points_per_curve)); };
    Json sections = Json::array();
    for (const auto& [lower, upper] : design.layout.sections)
      sections.push_back({drawn(lower), drawn(upper)});
    result["target"] = {
        {"kind", "helmet"}, {"spine_mm", drawn(design.layout.spine)}, {"sections_mm", sections}};
    const auto& shape = measure_of<RibsMeasure>(run);
    const targets::Head& head = file_.head;
    result["helmet"] = {{"clearance_mm", file_.spec.clearance_mm},
                        {"coverage_mm", file_.spec.coverage_mm},
                        {"ribs", ribs()},
                        {"spine_cells", design.layout.spine_and_ribs.rows},
                        {"error", error_json(shape.error, shape.inside)},
                        {"body_mm", shape.error.of_body},
                        {"cell_mm", by_cell(design.fishbone.structure, shape.error)},
                        {"cells_trimmed", design.trimmed},
                        {"covered_share", cover.share},
                        {"goal_rms_mm", cover.rms},
                        {"goal_max_mm", cover.max},
                        {"head_mm", lines(head_curves_of(head))},
                        {"bare_mm", bare_lines(curves_above_rim())},
                        {"head_frame", poses_json({{head.to_mesh.linear(), head.to_mesh.translation()}})[0]},
                        {"closed_part", head.closed_part},
                        {"openings", openings_json(head.openings)},
                        {"invented", invented(head.openings)},
                        {"notes", design.layout.notes},
                        {"reasons", run.violations},
                        {"reasons_physics", run.physics_violations()}};
    if (const auto* physics = physics_measure_of<RibsMeasure>(run))
      result["helmet"]["physics"] = error_json(physics->error, physics->inside);
    result["optimiser"] = search_json(design.search);
  }

  void add_metrics(const Run& run, Json& metrics) const override {
    const auto& shape = measure_of<RibsMeasure>(run);
    metrics["distance_rms_mm"] = shape.error.rms;
    metrics["distance_max_mm"] = shape.error.max;
    metrics["rib_rms_mm"] = worst_rib(shape.error);
    metrics["covered_share"] = cover.share;
    metrics["goal_rms_mm"] = cover.rms;
    metrics["goal_max_mm"] = cover.max;
    metrics["walls_inside"] = shape.inside.hinges.size();
    metrics["met"] = run.met();
    const auto* physics = physics_measure_of<RibsMeasure>(run);
    if (!physics) return;
    metrics["distance_rms_mm_physics"] = physics->error.rms;
    metrics["distance_max_mm_physics"] = physics->error.max;
    metrics["walls_inside_physics"] = physics->inside.hinges.size();
  }

  std::vector<SummaryLine> summary_lines(const Run& run) const override {
    const optim::RibsError& error = measure_of<RibsMeasure>(run).error;
    std::vector<SummaryLine> out = {
        {"fit", fmt::format("{}; limits {:g} and {:g} mm", describe(error), file_.rms_mm, file_.max_mm)},
        {"", fmt::format(
                 "ribs up to {} mm rms from their sections, {:.0f} % of the head within a cell edge of a rib",
                 format_figures(worst_rib(error)), 100 * cover.share)},
        {"helmet",
         fmt::format("{} ribs on a spine of {} cells, {:g} mm over the head, {:g} mm down from the crown",
                     design.layout.spine_and_ribs.ribs.size(), design.layout.spine_and_ribs.rows,
                     file_.spec.clearance_mm, file_.spec.coverage_mm)}};
    for (const std::string& note : design.layout.notes) out.push_back({"note", note});
    out.push_back(search_line(run.timings.optimise, design.search));
    if (const auto* physics = physics_measure_of<RibsMeasure>(run))
      out.push_back({"check", "in the simulation: " + describe(physics->error)});
    return out;
  }

 private:
  bool is_covered() const { return !file_.covered_share || cover.share >= *file_.covered_share; }

  std::vector<std::vector<Vector3d>> curves_above_rim() const {
    std::vector<std::vector<Vector3d>> out = head_curves_of(file_.head);
    for (std::vector<Vector3d>& curve : out)
      std::erase_if(curve, [&](const Vector3d& p) { return p.z() < -file_.spec.coverage_mm; });
    return out;
  }

  HelmetFile file_;
};

/// Returns the size of the covered part of the head plus the walls around it. The clearance is measured to the middle
/// of the walls.
Eigen::Vector3d covered_size(const HelmetFile& file) {
  Eigen::AlignedBox3d head;
  for (const Vector3d& vertex : file.head.dome.mesh().vertices)
    if (vertex.z() >= crown.z() - file.head.coverage_mm) head.extend(vertex);
  const double around = file.spec.clearance_mm + file.spec.size.height_mm / 2;
  return head.sizes() + Vector3d(2 * around, 2 * around, around);
}

}  // namespace

std::unique_ptr<Goal> make_goal(HelmetFile file) {
  RibsTask task{.name = file.name,
                .settings = file,
                .spec = file.spec,
                .over = file.head.dome,
                .to_given = file.head.to_mesh};
  task.plan = [file] { return plan_helmet(file.head.dome, crown, file.spec); };
  task.solver.max_evaluations = file.solver.max_evaluations.value_or(helmet_evaluations);
  task.rms_mm = file.rms_mm;
  task.tolerances = {{"rms_mm", file.rms_mm}, {"max_mm", file.max_mm}};
  if (file.covered_share) task.tolerances.emplace_back("covered_share", *file.covered_share);
  task.bounds = {file.spec.tilt, file.spec.theta};
  task.is_aligned = task.has_notes = true;
  task.folded_mm = covered_size(file);
  task.lowest_z = -file.spec.coverage_mm;
  task.outcome = [task, file](optim::RibsDesign found) {
    return std::make_unique<HelmetOutcome>(task, file, std::move(found));
  };
  return make_ribs_goal(std::move(task));
}

extern const GoalKind helmet_kind = {
    .name = "helmet",
    .example = "target: {kind: helmet, mesh: head.obj}",
    .meaning = "flat sheet that folds onto a head",
    .file = {{"mesh", "mesh"}},
    .read = [](const targets::Node& root) { return make_goal(read_helmet_file(root)); },
    .table = helmet_keys,
    .metrics = {
        {"distance_rms_mm", "mm",
         "[distance from head plus clearance](#distances-of-a-helmet), root mean square"},
        {"distance_max_mm", "mm", "largest distance from head plus clearance"},
        {"rib_rms_mm", "mm", "distance of the worst rib's midline from its section curve"},
        {"covered_share", "",
         "[share of the head's area above the rim within a cell edge of a rib](#covered_share)"},
        {"goal_rms_mm", "mm", "distance of the head, plus clearance, from the nearest rib, root mean square"},
        {"goal_max_mm", "mm", "largest distance of the head, plus clearance, from the nearest rib"},
        {"walls_inside", "", "number of walls inside the head"},
        {"walls_inside_physics", "", "walls_inside in the simulation"},
        {"distance_rms_mm_physics", "mm", "distance_rms_mm in the simulation"},
        {"distance_max_mm_physics", "mm", "distance_max_mm in the simulation"}}};

}  // namespace kinetix::app
