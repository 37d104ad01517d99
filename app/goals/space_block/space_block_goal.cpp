#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "app/files/file_header.hpp"
#include "app/files/goal_settings.hpp"
#include "app/files/structure_section.hpp"
#include "app/run/goal.hpp"
#include "app/run/run.hpp"
#include "app/run/search_result.hpp"
#include "model/base/algorithms.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "optim/space_block/fit_space_block.hpp"
#include "targets/document/section.hpp"
#include "targets/space_block/space_block_goal.hpp"

namespace kinetix::app {
namespace {

/// Content of a target.yaml of kind space_block, with defaults filled in. Angles in radians, lengths in mm. Required
/// are `kinetix: 1` and a `target`.
///
///     target: {kind: space_block, factor: [0.82, 0.86, 0.88], size_mm: [120, 120, 60]}
///     structure: {cells: [2, 2, 1], cell_mm: 20, wall_mm: {thickness: 1.6, height: 3}}
///     variables: {theta: {range_deg: [5, 44]}, gusset: {range: [0.1, 0.8]}}
///     tolerance: {factor: 0.005, size: 0.05, verify: 0.02}
struct SpaceBlockFile : GoalSettings {
  targets::SpaceBlockGoal goal;
  optim::SpaceBlockVariables variables = {};
  ThinWalls walls = {};             ///< structure.wall_mm
  double factor_tolerance = 0.005;  ///< largest error of a direction's factor, (0, 1]
  double size_tolerance = 0.05;     ///< largest relative error of a length at rest, (0, 1]

  optim::SpaceBlockDesign found;  ///< closed-form design, computed while the file is read

  model::CellSize size() const { return walls.size(found.edge_mm); }
};

namespace value = targets::value;

constexpr int max_block_cells = 10;     // cells per direction: a block of 10 x 10 x 10 has 40 000 bodies
constexpr int max_block_bodies = 6000;  // bodies of 5 x 5 x 5 cells, whose simulation takes minutes
constexpr int bodies_per_cell = 36;     // 12 rotors and 24 gussets per inner cell; sides have a few more
// Theta, degrees: at 45 rotors have turned by a right angle.
const targets::Bounds block_turns = targets::between(0, 45, "degrees");
const targets::Bounds gusset_lengths = targets::from_to(0.02, 0.9);

targets::KeyTable block_variables_keys() {
  using Variables = optim::SpaceBlockVariables;
  const targets::KeyTable theta({{"range_deg", &Variables::theta, value::angle_range(block_turns),
                                  "fold angle: half of the rotation of the rotors"}});
  const targets::KeyTable gusset({{"range", &Variables::gusset, value::range(gusset_lengths),
                                   "lengths of gussets, the pieces between two rotors that never turn, "
                                   "relative to the edge. The shortest "
                                   "are 0.2, or as near to 0.2 as the range of the fold angle allows"}});
  return targets::KeyTable({targets::Key("fold_angle", theta, "fold angle of the block").formerly("theta"),
                            {"gusset", gusset, "lengths of the gussets"}});
}

void read_block_structure(const targets::Section& root, SpaceBlockFile& file) {
  const targets::Section structure = root.section("structure");
  if (const auto cells = structure.optional("cells")) {
    const auto sides = cells->list_of(3, "[x, y, z]");
    file.variables.cells = {sides[0].integer(1, max_block_cells), sides[1].integer(1, max_block_cells),
                            sides[2].integer(1, max_block_cells)};
  }
  structure.read("cell_mm", file.variables.edge_mm);
  root.read_into(file.walls);
}

void read_block_tolerance(const targets::Section& root, SpaceBlockFile& file) {
  root.read_into(file);
  const auto size = root.section("tolerance").optional("size");
  if (size && !file.goal.size_mm)
    throw size->key_error("only applies together with target.size_mm. Add target.size_mm, or remove the key");
}

void check_factor(const targets::Section& target, const SpaceBlockFile& file) {
  const std::string why = obstacle(file.goal, file.variables);
  if (!why.empty()) throw target.optional("factor")->error(why);
}

void check_bodies(const targets::Section& target, const SpaceBlockFile& file) {
  const auto& cells = file.found.cells;
  const double bodies = static_cast<double>(bodies_per_cell) * cells[0] * cells[1] * cells[2];
  if (bodies <= max_block_bodies) return;
  throw target.error(
      fmt::format("{} x {} x {} cells have about {:.0f} bodies, and the limit of a search is {}. Give larger "
                  "cells",
                  cells[0], cells[1], cells[2], bodies, max_block_bodies));
}

/// Returns all keys of a target.yaml of kind space_block.
const targets::KeyTable& space_block_keys() {
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::space_block_target_keys(), "the goal", targets::needed},
          {"structure",
           targets::KeyTable({
               {"cells", value::list(value::integer(1, max_block_cells), "`[x, y, z]`", 3, 3),
                targets::otherwise("[2, 2, 2], or a number for `target.size_mm`"),
                "cubic cells of the sodalite net, each 2.83 edges long"},
               cell_mm_key(targets::otherwise("20, or a length for `target.size_mm`")),
               thin_walls_key("edges", "size of the walls, from each rotor to the middle of a gusset"),
           }),
           "lattice of the block"},
          {"variables", block_variables_keys(), "ranges of the search"},
          {"tolerance",
           targets::KeyTable({
               {"factor", &SpaceBlockFile::factor_tolerance, value::number(targets::part_of_one),
                "limit of the difference between a direction's factor and `target.factor`"},
               {"size", &SpaceBlockFile::size_tolerance, value::number(targets::part_of_one),
                "limit of the difference between a length at rest and `target.size_mm`, relative to it"},
               verify_key(),
           }),
           "limits for a met goal"},
      },
      {});
  return keys;
}

SpaceBlockFile read_space_block_file(const targets::Node& node) {
  const targets::Section root = read_root(node, space_block_keys());
  SpaceBlockFile file;
  const targets::Section target = root.section("target");
  file.goal = targets::read_space_block(target);
  read_block_structure(root, file);
  root.read_into(file.variables);
  read_block_tolerance(root, file);
  check_factor(target, file);
  file.found = fit_space_block(file.goal, file.variables, file.size_tolerance);
  check_bodies(target, file);
  read_settings(root, file.found.edge_mm, file);
  return file;
}

using Json = nlohmann::ordered_json;

class SpaceBlockMeasure final : public Measure {
 public:
  targets::SpaceBlockError error;
};

Json by_direction(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string lengths_text(const Eigen::Vector3d& v) {
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", v.x(), v.y(), v.z());
}

std::string factors_text(const Eigen::Vector3d& v) {
  return fmt::format("{:.4f}, {:.4f}, {:.4f}", v.x(), v.y(), v.z());
}

/// Section of a result for a shrinking block. The goal is met if factors and lengths at rest are within tolerance and
/// no walls collide.
struct SpaceBlockOutcome final : GoalOutcome {
  explicit SpaceBlockOutcome(SpaceBlockFile asked) : file(std::move(asked)) {}

  SpaceBlockFile file;

  void add_sections(const Run& run, Json& result) const override {
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
                           {"why", "gussets and fold angle follow from the factors"}};
  }
  void add_metrics(const Run& run, Json& metrics) const override {
    metrics["factor_off"] = measure_of<SpaceBlockMeasure>(run).error.off;
    if (file.goal.size_mm) metrics["size_off"] = file.found.size_off;
    if (const auto* physics = physics_measure_of<SpaceBlockMeasure>(run))
      metrics["factor_off_physics"] = physics->error.off;
    metrics["met"] = run.met();
  }
  std::vector<SummaryLine> summary_lines(const Run& run) const override {
    const targets::SpaceBlockError& error = measure_of<SpaceBlockMeasure>(run).error;
    const optim::SpaceBlockDesign& found = file.found;
    const Eigen::Vector3d& g = found.gusset;
    std::vector<SummaryLine> lines = {
        {"block", fmt::format("factors off by {}, limit {:g}; {} at rest, {} pressed",
                              format_figures(error.off), file.factor_tolerance, lengths_text(found.size_mm),
                              lengths_text(error.factors.cwiseProduct(found.size_mm)))},
        {"factors", factors_text(error.factors) + " of the lengths at rest, between the outermost rotors"},
        {"lattice",
         fmt::format("sodalite, {} x {} x {} cells with edges of {:.3g} mm, gussets of {:.3g}, {:.3g} "
                     "and {:.3g} edges in squares normal to x, y and z",
                     found.cells[0], found.cells[1], found.cells[2], found.edge_mm, g.x(), g.y(), g.z())}};
    if (const auto* physics = physics_measure_of<SpaceBlockMeasure>(run))
      lines.push_back(
          {"check", fmt::format("in the simulation: factors {}, off by {}",
                                factors_text(physics->error.factors), format_figures(physics->error.off))});
    return lines;
  }
};

/// Describes violations of the factor tolerance. @param who name of the state, such as "model" or "simulation"
std::vector<std::string> violations(const SpaceBlockFile& file, const targets::SpaceBlockError& error,
                                    const std::string& who) {
  if (error.off <= file.factor_tolerance) return {};
  return {fmt::format(
      "{}: the block shrinks to {} of its lengths, {:.2g} off the requested factors; at most {:g} is "
      "allowed",
      who, factors_text(error.factors), error.off, file.factor_tolerance)};
}

/// Describes which keys to change for lengths at rest nearer to the required ones.
std::string size_advice(const optim::SpaceBlockVariables& given) {
  if (!given.cells) return "give smaller cells";
  return given.edge_mm ? "give other `cells` or another `cell_mm`" : "give other `cells`";
}

class SpaceBlockGoal final : public Goal {
 public:
  explicit SpaceBlockGoal(SpaceBlockFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    Forecast out{block()};
    if (const auto motion = exact_motion(out.sheet))
      out.folded_mm = size_of(out.sheet, motion.at(file_.found.theta));
    add_settings(file_, out);
    return out;
  }

  SearchResult search(const RunOptions&) const override {
    SearchResult out;
    copy_settings(out, file_);
    out.tolerances = {{"factor", file_.factor_tolerance}};
    if (file_.goal.size_mm) out.tolerances.emplace_back("size", file_.size_tolerance);
    out.design.structure = block();
    out.theta = file_.found.theta;
    out.goal = std::make_unique<SpaceBlockOutcome>(file_);
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    if (of == StateOf::equilibrium) return nullptr;
    auto out = std::make_shared<SpaceBlockMeasure>();
    out->error = error_of(run, of == StateOf::physics ? aligned(state, run.own) : state);
    out->violations = violations(file_, out->error, describe(of));
    if (of == StateOf::physics) return out;
    if (file_.goal.size_mm && !(file_.found.size_off <= file_.size_tolerance))
      out->violations.push_back(fmt::format(
          "lengths at rest are up to {:.1f} % off the requested lengths; at most {:g} % is allowed: {}",
          100 * file_.found.size_off, 100 * file_.size_tolerance, size_advice(file_.variables)));
    model::append(collisions_during_motion(run, "use lower or thinner walls, or longer gussets"),
                  out->violations);
    return out;
  }

  /// Observes the distance of the outermost rotors from the sides of the exact state.
  std::optional<Observed> observe(const SearchResult& found, const model::Lattice&,
                                  const model::State& state) const override {
    const model::Pose motion = motion_onto(state, found.own);
    const model::State placed = moved(state, motion);
    const auto rotors = optim::side_rotors(*found.design.structure.sodalite());
    Observed out{{}, file_.factor_tolerance * file_.found.size_mm.minCoeff()};
    for (int d = 0; d < 3; ++d)
      for (const std::vector<int>& side : rotors[d])
        for (const int r : side)
          out.points.push_back({{r},
                                state[r].p,
                                motion.R.transpose() * Eigen::Vector3d::Unit(d),
                                placed[r].p[d] - found.own[r].p[d]});
    return out;
  }

 private:
  model::Lattice block() const { return block_of(file_.found, file_.size()); }

  /// Computes the error of the factors. @param state with its sides along the axes
  targets::SpaceBlockError error_of(const Run& run, const model::State& state) const {
    const model::SodaliteStructure& block = *run.design.structure.sodalite();
    const auto lengths = [&](const model::State& of) {
      return targets::block_lengths(optim::block_sides(block, of));
    };
    return space_block_error(file_.goal, lengths(rest_state(model::Linkage(run.design.structure))),
                             lengths(state));
  }

  SpaceBlockFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(SpaceBlockFile file) {
  return std::make_unique<SpaceBlockGoal>(std::move(file));
}

extern const GoalKind space_block_kind = {
    .name = "space_block",
    .example = "target: {kind: space_block, factor: 0.85}",
    .meaning = "block that shrinks by a given factor",
    .read = [](const targets::Node& root) { return make_goal(read_space_block_file(root)); },
    .table = space_block_keys,
    .metrics = {{"factor_off", "", "largest difference between a direction's factor and `target.factor`"},
                {"factor_off_physics", "", "factor_off in the simulation"},
                {"size_off", "",
                 "largest difference between a length at rest and `target.size_mm`, relative to it"}}};

}  // namespace kinetix::app
