#include "app/goals/space_block/space_block_outcome.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json by_direction(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string lengths_text(const Eigen::Vector3d& v) {
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", v.x(), v.y(), v.z());
}

std::string factors_text(const Eigen::Vector3d& v) {
  return fmt::format("{:.4f}, {:.4f}, {:.4f}", v.x(), v.y(), v.z());
}

}  // namespace

void SpaceBlockOutcome::add_sections(const Run& run, Json& result) const {
  Json out = {{"kind", "space_block"}, {"factors", by_direction(file.goal.factors)}};
  if (file.goal.size_mm) out["size_mm"] = by_direction(*file.goal.size_mm);
  result["target"] = out;
  const targets::SpaceBlockError& error = measure_of<SpaceBlockMeasure>(run).error;
  const optim::SpaceBlockDesign& found = file.found;
  Json section = {{"cells", found.cells},
                  {"gussets", by_direction(found.gusset)},
                  {"rest_mm", by_direction(found.size_mm)},
                  {"pressed_mm", by_direction(error.factors.cwiseProduct(found.size_mm))},
                  {"factors", by_direction(error.factors)},
                  {"reasons", run.violations},
                  {"reasons_physics", run.physics_violations()}};
  if (const auto* physics = physics_measure_of<SpaceBlockMeasure>(run))
    section["physics"] = {{"factors", by_direction(physics->error.factors)}};
  result["space_block"] = section;
  result["optimiser"] = {{"solver", "closed form"},
                         {"starts", 1},
                         {"evaluations", 1},
                         {"status", "converged"},
                         {"why", "gussets and theta follow from the factors"}};
}

void SpaceBlockOutcome::add_metrics(const Run& run, Json& metrics) const {
  metrics["factor_off"] = measure_of<SpaceBlockMeasure>(run).error.off;
  if (file.goal.size_mm) metrics["size_off"] = file.found.size_off;
  if (const auto* physics = physics_measure_of<SpaceBlockMeasure>(run))
    metrics["factor_off_physics"] = physics->error.off;
  metrics["met"] = run.met();
}

std::vector<SummaryLine> SpaceBlockOutcome::summary_lines(const Run& run) const {
  const targets::SpaceBlockError& error = measure_of<SpaceBlockMeasure>(run).error;
  const optim::SpaceBlockDesign& found = file.found;
  const Eigen::Vector3d& g = found.gusset;
  std::vector<SummaryLine> lines = {
      {"block",
       fmt::format(
           "{} at rest between its outermost rotors, {} pressed: {} of its lengths, off by {:.1e}: {}",
           lengths_text(found.size_mm), lengths_text(error.factors.cwiseProduct(found.size_mm)),
           factors_text(error.factors), error.off, tolerance_words(run, error.off <= file.factor_tolerance))},
      {"lattice",
       fmt::format("sodalite, {} x {} x {} cells with edges of {:.3g} mm, gussets of {:.3g}, {:.3g} "
                   "and {:.3g} edges in squares normal to x, y and z",
                   found.cells[0], found.cells[1], found.cells[2], found.edge_mm, g.x(), g.y(), g.z())}};
  if (const auto* physics = physics_measure_of<SpaceBlockMeasure>(run))
    lines.push_back({"pressed", fmt::format("in the physics run: {} of its lengths, off by {:.1e}",
                                            factors_text(physics->error.factors), physics->error.off)});
  return lines;
}

std::vector<std::string> violations(const SpaceBlockFile& file, const targets::SpaceBlockError& error,
                                    const std::string& who) {
  if (error.off <= file.factor_tolerance) return {};
  return {
      fmt::format("{}: the block shrinks to {} of its lengths, {:.2g} off what was asked; at most {:g} is "
                  "allowed",
                  who, factors_text(error.factors), error.off, file.factor_tolerance)};
}

}  // namespace kinetix::app
