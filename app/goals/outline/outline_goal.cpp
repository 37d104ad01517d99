#include "app/goals/outline/outline_goal.hpp"

#include <fmt/format.h>

#include "app/console/short_form.hpp"
#include "app/pictures/panel_picture.hpp"
#include "app/result/result_json.hpp"
#include "app/result/state_json.hpp"
#include "app/run/goal.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(const targets::OutlineError& error) {
  return {{"rms", error.rms}, {"max", error.max}, {"iou", error.iou}};
}

/// Describes the active bounds of a panel that misses its outline.
std::string binding_limit(const optim::OutlineDesign& design) {
  return fmt::format("{:.0f} % of the walls have the largest offset, {:.0f} % the largest turn",
                     100 * design.at_bounds_offset, 100 * design.at_bounds_shift);
}

/// Describes how the search ended, for a panel whose walls do not collide.
std::string describe_search_end(const optim::OutlineDesign& design) {
  const std::string moves = design.settled ? "converged" : "stopped at the iteration limit before converging";
  return moves + ", no walls collide during folding";
}

std::string describe_size(double size) {
  if (std::abs(size - 1) < 5e-3) return "as large as drawn";
  return fmt::format("{:.3g} times as large as drawn", size);
}

model::Pose turned_about_z(double angle) {
  return {Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix(), Eigen::Vector3d::Zero()};
}

/// Computes the outline error of `state` after rigid alignment with the exact state. @param edge_mm cell edge, mm
targets::OutlineError error_of(const OutlineOutcome& outline, const model::State& exact,
                               const model::State& state, double edge_mm) {
  const model::State placed = aligned(state, exact);
  std::vector<Eigen::Vector2d> rim;
  for (const int body : outline.rim) rim.push_back(placed[body].p.head<2>());
  return outline_error(targets::Outline(outline.placed(edge_mm)), rim);
}

/// Moves the outline from the frame of the search, which is the lattice, to the frame of the reported state. Each
/// lattice family has a different frame, so the first body gives the translation. @param edge_mm cell edge, mm
void move_outline(const model::State& shown, double edge_mm, double turn, optim::OutlineDesign& design) {
  const model::PlanarStructure& panel = design.panel;
  const model::Pose searched =
      model::parallel_pose(panel.graph.vertices[0], design.y[0], panel.senses[0], design.theta);
  const Eigen::Vector2d from_first = design.origin - searched.p.head<2>();
  design.origin = shown[0].p.head<2>() / edge_mm + Eigen::Rotation2Dd(-turn) * from_first;
}

/// Describes violations of shape, area, flat outline and collisions. @param who name of the reported state
std::vector<std::string> all_violations(const OutlineFile& file, const OutlineOutcome& outline,
                                        const targets::OutlineError& error, const std::string& who) {
  std::vector<std::string> why = violations(file, error, who);
  if (file.flat)
    for (const std::string& lacks : violations(file, outline.design.flat, "flat")) why.push_back(lacks);
  if (!outline.design.clear)
    why.push_back(outline.design.stopped
                      ? "walls collide before this compression, and the search was stopped"
                      : "walls collide before this compression: use thinner walls or a smaller fold angle");
  return why;
}

// Search time in s per wall, measured: for the folded outline alone, and for the folded and flat outlines.
constexpr double seconds_per_wall = 0.005, seconds_per_overlapping_wall = 0.02;

class OutlineGoal final : public Goal {
 public:
  explicit OutlineGoal(OutlineFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const Eigen::Vector2d size = model::box_of(file_.folded.points()).sizes();
    const OutlineStart start = outline_start(file_);
    Forecast out{make_sheet(file_.lattice, start.cells, file_.size(start.edge_mm))};
    if (!file_.cell_mm) out.folded_mm = {size.x(), size.y(), out.sheet.size().height_mm};
    out.search_s = out.sheet.hinges() * (file_.flat ? seconds_per_overlapping_wall : seconds_per_wall);
    add_settings(file_, out);
    return out;
  }

  SearchResult search(const RunOptions& options) const override {
    SearchResult out;
    copy_settings(out, file_);
    out.tolerances = {{"shape", file_.shape_tolerance}, {"iou", file_.iou_tolerance}};
    auto outline = std::make_unique<OutlineOutcome>(file_);
    FoundOutline found = search_outline(file_, options);
    outline->design = std::move(found.design);
    outline->cuts = found.cuts;
    outline->turn = found.turn;
    outline->rim = outer_boundary(outline->design.panel.graph).vertices;
    out.design.structure = std::move(found.sheet);
    out.theta = outline->design.theta;
    out.plan.exact = exact_motion(out.design.structure);
    if (!out.plan.exact)
      throw InvalidInput(
          "no panel with such offsets is a one-degree-of-freedom mechanism: " + out.plan.exact.why,
          {"", 0, 0, "variables.offset_mm"});
    // Results show the orientation of the drawing; the drive acts along the lattice.
    if (outline->turn != 0) out.to_shown = turned_about_z(-outline->turn);
    const model::State exact = shown(out.plan.exact.at(out.theta), outline->turn);
    move_outline(exact, out.design.structure.size().edge_mm, outline->turn, outline->design);
    out.goal = std::move(outline);
    out.is_aligned = true;
    out.bounds = {.theta = {file_.theta[0], file_.theta[1]}};
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    const auto& outline = outcome_of<OutlineOutcome>(run);
    const double edge_mm = run.design.structure.size().edge_mm;
    auto out = std::make_shared<OutlineMeasure>();
    out->error = of == StateOf::model ? outline.design.error
                                      : error_of(outline, shown(run.own, outline.turn), state, edge_mm);
    out->distance = outline_excess(file_, out->error);
    out->violations = of == StateOf::physics ? violations(file_, out->error, describe(of))
                                             : all_violations(file_, outline, out->error, describe(of));
    return out;
  }

  /// Observes the distance of each boundary vertex from the outline.
  std::optional<Observed> observe(const SearchResult& found, const model::Lattice&,
                                  const model::State& state) const override {
    const auto& outline = outcome_of<OutlineOutcome>(found);
    const targets::Outline goal(outline.placed(found.design.structure.size().edge_mm));
    const model::Pose motion = motion_onto(state, shown(found.own, outline.turn));
    const model::State placed = moved(state, motion);
    Observed out{{}, file_.shape_tolerance * goal.diagonal()};
    for (const int body : outline.rim) {
      const Eigen::Vector3d& place = placed[body].p;
      const targets::Outline::Nearest at = goal.nearest(place.head<2>());
      const Eigen::Vector3d normal(at.normal.x(), at.normal.y(), 0);
      out.points.push_back(
          {{body}, state[body].p, motion.R.transpose() * normal, at.normal.dot(place.head<2>() - at.point)});
    }
    return out;
  }

  std::vector<targets::DocumentChanges> remedies(const Run& missed) const override {
    return outline_remedies(file_, outcome_of<OutlineOutcome>(missed).design);
  }

 private:
  /// Returns the state in the orientation of the drawing. @param own state in the frame of the lattice
  static model::State shown(model::State own, double turn) {
    return turn == 0 ? own : moved(std::move(own), turned_about_z(-turn));
  }

  OutlineFile file_;
};

}  // namespace

std::vector<Eigen::Vector2d> OutlineOutcome::placed(double edge_mm) const {
  std::vector<Eigen::Vector2d> out;
  for (const Eigen::Vector2d& p : file.folded.points())
    out.push_back(edge_mm * (p / design.scale + design.origin));
  return out;
}

void OutlineOutcome::add_sections(const Run& run, Json& result) const {
  Json target = {{"kind", "outline"}, {"points_mm", points_json(file.folded.points())}};
  if (file.flat) target["flat_mm"] = points_json(file.flat->points());
  result["target"] = target;
  const double edge = run.design.structure.size().edge_mm;
  Json section = {{"goal_mm", points_json(placed(edge))},
                  {"rim", rim},
                  {"size", size(edge)},
                  {"lattice_deg", -to_degrees(turn)},
                  {"diagonal_mm", size(edge) * file.folded.diagonal()},
                  {"exact", error_json(design.error)},
                  {"offset_mm", design.offset * edge},
                  {"turn", design.shift},
                  {"at_bounds", {{"offset", design.at_bounds_offset}, {"turn", design.at_bounds_shift}}},
                  {"walls_meet", !design.clear},
                  {"cuts", cuts},
                  {"reasons", run.violations},
                  {"reasons_physics", run.physics_violations()}};
  if (file.flat) section["flat"] = error_json(design.flat);
  if (run.by_equilibrium) section["equilibrium"] = error_json(measure_of<OutlineMeasure>(run).error);
  if (const auto* physics = physics_measure_of<OutlineMeasure>(run))
    section["physics"] = error_json(physics->error);
  result["outline"] = section;
  result["optimiser"] = {
      {"solver", "alternating directions"}, {"starts", std::max(1, cuts)}, {"evaluations", design.rounds}};
  add_end(design.stopped, design.clear, describe_search_end(design),
          fmt::format(
              "walls still collide during folding after {} rounds, each with less turning of those that did",
              design.clearance_rounds),
          result["optimiser"]);
  if (design.clear && !design.settled && !design.stopped)
    result["optimiser"]["status"] = to_string(optim::SolveStatus::evaluation_limit);
}

void OutlineOutcome::add_metrics(const Run& run, Json& metrics) const {
  const targets::OutlineError& error = measure_of<OutlineMeasure>(run).error;
  metrics["outline_rms"] = error.rms;
  metrics["outline_max"] = error.max;
  metrics["iou"] = error.iou;
  if (file.flat) {
    metrics["flat_rms"] = design.flat.rms;
    metrics["flat_iou"] = design.flat.iou;
  }
  if (const auto* physics = physics_measure_of<OutlineMeasure>(run)) {
    metrics["outline_rms_physics"] = physics->error.rms;
    metrics["iou_physics"] = physics->error.iou;
  }
  metrics["met"] = run.met();
}

std::vector<SummaryLine> OutlineOutcome::summary_lines(const Run& run) const {
  const double edge = run.design.structure.size().edge_mm;
  const double drawn_mm = size(edge) * file.folded.diagonal();
  const targets::OutlineError& error = measure_of<OutlineMeasure>(run).error;
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"outline",
       fmt::format("{} mm rms from the outline, limit {} mm; {:.1f} % area overlap, limit {:g} %; {}",
                   format_figures(error.rms * drawn_mm), format_figures(file.shape_tolerance * drawn_mm),
                   100 * error.iou, 100 * file.iou_tolerance, describe_size(size(edge)))});
  if (file.flat)
    lines.push_back({"flat", fmt::format("{} mm rms from its outline, {:.1f} % area overlap",
                                         format_figures(design.flat.rms * size(edge) * file.flat->diagonal()),
                                         100 * design.flat.iou)});
  if (!run.met()) lines.push_back({"bounds", binding_limit(design)});
  lines.push_back(
      {"hinges", fmt::format("offset from the middle of their walls up to {:.2f} mm, t from {:.2f} to {:.2f}",
                             design.offset * edge, 0.5 - design.shift / 2, 0.5 + design.shift / 2)});
  lines.push_back(
      {"search", fmt::format("{:.2g} s, {} convex problems{}", run.timings.optimise, design.rounds,
                             cuts > 0 ? fmt::format(", {} cuts of the lattice", cuts) : "")});
  return lines;
}

std::vector<NamedContent> OutlineOutcome::pictures(const Run& run, bool for_report) const {
  if (for_report) return {};
  std::vector<NamedContent> files;
  const model::State flat = rest_state(run.design.structure);
  for (const auto& [name, state] :
       {std::pair("flat", &flat), std::pair("pressed", &run.states.front().poses)})
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png})
      files.push_back({std::string(name) + (format == PictureFormat::svg ? ".svg" : ".png"),
                       panel_picture(run.design.structure, *state, {.format = format})});
  return files;
}

std::vector<std::string> violations(const OutlineFile& file, const targets::OutlineError& error,
                                    const std::string& who) {
  std::vector<std::string> why;
  if (!(error.rms <= file.shape_tolerance))
    why.push_back(fmt::format("{}: the boundary is {:.2f} % of the diagonal off the outline, limit {:.2f} %",
                              who, 100 * error.rms, 100 * file.shape_tolerance));
  if (!(error.iou >= file.iou_tolerance))
    why.push_back(fmt::format("{}: {:.1f} % of the area overlaps, at least {:.1f} % is required", who,
                              100 * error.iou, 100 * file.iou_tolerance));
  return why;
}

std::unique_ptr<Goal> make_goal(OutlineFile file) { return std::make_unique<OutlineGoal>(std::move(file)); }

extern const GoalKind outline_kind = {
    .name = "outline",
    .example = "target: {kind: outline, points: outline.csv}",
    .meaning = "panel that changes its outline",
    .file = {{"points", "x,y"}},
    .read = [](const targets::Node& root) { return make_goal(read_outline_file(root)); },
    .table = outline_keys,
    .metrics =
        {{"outline_rms", "",
          "[distance of the boundary's vertices from the outline](#outline_rms-and-iou), root mean square"},
         {"outline_max", "", "largest distance of the boundary's vertices from the outline"},
         {"iou", "", "[area that panel and outline share](#outline_rms-and-iou), relative to that of both"},
         {"flat_rms", "", "outline_rms of the flat panel, with `target.flat`"},
         {"flat_iou", "", "iou of the flat panel, with `target.flat`"},
         {"outline_rms_physics", "", "outline_rms in the simulation"},
         {"iou_physics", "", "iou in the simulation"}},
    .keeps_length = true,
    .usual_cells = {{usual_side, usual_side}}};

}  // namespace kinetix::app
