#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "app/goals/fold/fold_file.hpp"
#include "app/goals/fold/solid_outcome.hpp"
#include "model/sheet/sheet_motion.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {
namespace {

/// Edges of the box around a solid that stands on its first face, with that face's first edge along x.
Eigen::Vector3d standing_size(const targets::Solid& solid) {
  const auto corner = [&](int k) -> const Eigen::Vector3d& { return solid.corners[solid.faces[0][k]]; };
  const Eigen::Vector3d x = (corner(1) - corner(0)).normalized();
  const Eigen::Vector3d z = x.cross(corner(2) - corner(1)).normalized();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& at : solid.corners)
    box.extend(Eigen::Vector3d(x.dot(at), z.cross(x).dot(at), z.dot(at)));
  return box.sizes();
}

/// Size of the tilts along a crease, rad: those that make up for elastic hinges differ a little.
double mean_crease_tilt(const model::Sheet& net, const targets::SolidCrease& crease) {
  double sum = 0;
  std::size_t count = 0;
  for (const std::vector<int>& column : crease.hinges) {
    for (const int h : column) sum += std::abs(net.hinge(h).beta);
    count += column.size();
  }
  return sum / static_cast<double>(count);
}

// Rad, where searches for solids end that the tilts limit: at a smaller theta these would be larger than is allowed.
constexpr double steep_theta = 22 * radians_per_degree;

/// Of a crease: as few as fold the solid's sharpest edge at that theta, as its search begins with.
int usual_columns(const targets::Solid& solid, const FoldFile& file) {
  if (file.goal.solid->columns > 0) return file.goal.solid->columns;
  double sharpest = 0;
  for (const targets::SolidEdge& edge : edges_of(solid)) sharpest = std::max(sharpest, edge.turn);
  const double theta = std::clamp(steep_theta, file.theta.lower, file.theta.upper),
               turn = 2 * std::atan(std::tan(file.tilt) * std::sin(theta));
  return static_cast<int>(std::clamp(std::ceil(sharpest / turn), 1.0, 1.0 * optim::most_solid_columns));
}

constexpr double seconds_a_solid_body = 0.005;  // measured: of a search of columns and theta

class SolidGoal final : public Goal {
 public:
  explicit SolidGoal(FoldFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const targets::SolidGoal& goal = *file_.goal.solid;
    const targets::Solid solid = targets::named_solid(goal.solid);
    const auto net = lay_out(solid, goal.cells, usual_columns(solid, file_), file_.size);
    Forecast out{net.structure};
    out.folded_mm = net.edge * file_.size.edge_mm * std::cos(usual_theta(file_.theta)) * standing_size(solid);
    out.search_s = out.sheet.bodies() * seconds_a_solid_body;
    add_settings(file_, out);
    return out;
  }

  Found search(const RunOptions& options) const override {
    Found out;
    take_settings(out, file_);
    out.tolerances = {{"angle_deg", std::stod(targets::degrees_text(file_.angle_tolerance))},
                      {"shape", file_.shape_tolerance}};
    out.physics.when = PhysicsWish::When::if_met;
    out.bounds = {file_.tilt, file_.theta};
    auto found = std::make_unique<SolidOutcome>();
    found->goal = *file_.goal.solid;
    optim::FoldOptions search = search_of(file_);
    search.threads = options.threads;
    search.stop = options.stop;
    found->design = fit_solid(targets::named_solid(found->goal.solid), found->goal.cells, found->goal.columns,
                              search, options.progress);
    out.design.structure = found->design.net.structure;
    out.theta = found->design.theta;
    out.goal = std::move(found);
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    const auto& found = outcome_of<SolidOutcome>(run);
    const optim::SolidDesign& design = found.design;
    auto out = std::make_shared<SolidMeasure>();
    out->error = of == StateOf::model ? design.error : solid_error(design.net, state, design.theta);
    out->tilt = design.tilt;
    if (of == StateOf::model && !design.folds) {
      for (const optim::SolidAttempt& attempt : design.attempts) out->violations.push_back(attempt.why);
      return out;
    }
    out->violations = violations(file_, found.creases(out->error), out->error.rms, in_words(of));
    if (of == StateOf::equilibrium)
      for (std::size_t c = 0; c < out->tilt.size(); ++c)
        out->tilt[c] = mean_crease_tilt(run.design.structure, design.net.creases[c]);
    return out;
  }

  /// Each vertex of a face, in all directions.
  std::optional<Observed> observe(const Found& found, const model::Sheet& sheet,
                                  const model::State& state) const override {
    const optim::SolidDesign& design = outcome_of<SolidOutcome>(found).design;
    if (!design.folds || !is_finite(state)) return std::nullopt;
    Observed out{{}, file_.shape_tolerance * design.net.edge * sheet.size().edge_mm * std::cos(design.theta)};
    for (const auto& [body, place] : ideal_places(design.net, state, design.theta))
      for (int k = 0; k < 3; ++k)
        out.points.push_back(
            {{body}, state[body].p, Eigen::Vector3d::Unit(k), (state[body].p - place)[k], 3});
    return out;
  }

 private:
  FoldFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_solid_goal(FoldFile file) { return std::make_unique<SolidGoal>(std::move(file)); }

}  // namespace kinetix::app
