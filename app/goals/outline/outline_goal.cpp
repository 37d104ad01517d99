#include <Eigen/Geometry>

#include "app/goals/outline/outline_kind.hpp"
#include "app/goals/outline/outline_outcome.hpp"
#include "model/base/invalid_input.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

model::Pose turned_about_z(double angle) {
  return {Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix(), Eigen::Vector3d::Zero()};
}

/// Of a state anywhere in space, laid over the exact one.
targets::OutlineError error_of(const OutlineOutcome& outline, const model::State& exact,
                               const model::State& state, double edge_mm) {
  const model::State placed = aligned(state, exact);
  std::vector<Eigen::Vector2d> rim;
  for (const int body : outline.rim) rim.push_back(placed[body].p.head<2>());
  return outline_error(targets::Outline(outline.placed(edge_mm)), rim);
}

/// Families lay a sheet down each in their own place, and the search has the outline as it lies on the lattice: the outline
/// goes where the first body of the state is that results show. @param edge_mm cell edge of the sheet, mm
void move_outline(const model::State& shown, double edge_mm, double turn, optim::OutlineDesign& design) {
  const model::PlanarStructure& panel = design.panel;
  const model::Pose searched =
      model::redrawn_pose(panel.graph.vertices[0], design.y[0], panel.senses[0], design.theta);
  const Eigen::Vector2d from_first = design.origin - searched.p.head<2>();
  design.origin = shown[0].p.head<2>() / edge_mm + Eigen::Rotation2Dd(-turn) * from_first;
}

/// @param who the state is of that results show
std::vector<std::string> all_violations(const OutlineFile& file, const OutlineOutcome& outline,
                                        const targets::OutlineError& error, const std::string& who) {
  std::vector<std::string> why = violations(file, error, who);
  if (file.flat)
    for (const std::string& lacks : violations(file, outline.design.flat, "flat")) why.push_back(lacks);
  if (!outline.design.clear)
    why.push_back(
        outline.design.stopped
            ? "walls meet before the panel is pressed so far, where the search was stopped"
            : "walls meet before the panel is pressed so far: use thinner walls or a smaller theta");
  return why;
}

// Measured, s: where the folded outline alone is asked for, and where the flat one is, too.
constexpr double seconds_a_wall = 0.005, seconds_a_wall_of_both = 0.02;

class OutlineGoal final : public Goal {
 public:
  explicit OutlineGoal(OutlineFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& point : file_.folded.points()) box.extend(point);
    const OutlineStart start = outline_start(file_);
    Forecast out{make_sheet(file_.lattice, start.cells, file_.size(start.edge_mm))};
    if (!file_.cell_mm) out.folded_mm = {box.sizes().x(), box.sizes().y(), out.sheet.size().height_mm};
    out.search_s = out.sheet.hinges() * (file_.flat ? seconds_a_wall_of_both : seconds_a_wall);
    add_settings(file_, out);
    return out;
  }

  Found search(const RunOptions& options) const override {
    Found out;
    take_settings(out, file_);
    out.tolerances = {{"shape", file_.shape_tolerance}, {"iou", file_.iou_tolerance}};
    auto outline = std::make_unique<OutlineOutcome>(file_);
    FoundOutline found = search_outline(file_, options);
    outline->design = std::move(found.design);
    outline->cuts = found.cuts;
    outline->turn = found.turn;
    outline->rim = outer_rim(outline->design.panel.graph).vertices;
    out.design.structure = std::move(found.sheet);
    out.theta = outline->design.theta;
    const model::ExactMotion motion = exact_motion(out.design.structure);
    if (!motion)
      throw InvalidInput("no panel with such offsets moves exactly: " + motion.why,
                         {"", 0, 0, "variables.offset_mm"});
    // As the outline was drawn; along the lattice its drive goes.
    if (outline->turn != 0) out.to_shown = turned_about_z(-outline->turn);
    const model::State exact = shown(motion.at(out.theta), outline->turn);
    move_outline(exact, out.design.structure.size().edge_mm, outline->turn, outline->design);
    out.goal = std::move(outline);
    out.is_laid_over = true;
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
    out->violations = of == StateOf::physics ? violations(file_, out->error, in_words(of))
                                             : all_violations(file_, outline, out->error, in_words(of));
    return out;
  }

  /// Each vertex of the rim.
  std::optional<Observed> observe(const Found& found, const model::Sheet&,
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

 private:
  /// As the outline was drawn. @param own as the panel lies on the lattice
  static model::State shown(model::State own, double turn) {
    return turn == 0 ? own : moved(std::move(own), turned_about_z(-turn));
  }

  OutlineFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(OutlineFile file) { return std::make_unique<OutlineGoal>(std::move(file)); }

// The kind for the registry (app/goals/registry.cpp), and its metrics with their units.
const GoalKind outline_kind = {
    .name = "outline",
    .example = "target: {kind: outline, points: outline.csv}",
    .read = [](const targets::Node& root) { return make_goal(read_outline_file(root)); },
    .table = outline_keys,
    .metrics = {
        {"outline_rms", "", "[vertices of the rim from the outline](#outline_rms-and-iou), root mean square"},
        {"outline_max", "", "likewise, the largest"},
        {"iou", "", "[area that panel and outline share](#outline_rms-and-iou), over that of both"},
        {"flat_rms", "", "outline_rms of the flat panel, where its outline is prescribed"},
        {"flat_iou", "", "iou of the flat panel, likewise"},
        {"outline_rms_physics", "", "outline_rms in the physics run"},
        {"iou_physics", "", "iou in the physics run"}}};

}  // namespace kinetix::app
