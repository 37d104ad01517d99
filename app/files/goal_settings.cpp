#include "app/files/goal_settings.hpp"

#include <fmt/format.h>

#include "app/files/file_header.hpp"
#include "model/contact/wall_contact.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr const char* only_solver = "direct";

void check_solver(const targets::Section& physics) {
  const auto solver = physics.optional("solver");
  if (!solver) return;
  if (solver->text(only_solver) == "sweeps")
    throw solver->error("`sweeps` was removed. Give `direct`, which replaces it, or remove the key");
  solver->one_of({only_solver});
}

void check_reach(const targets::Section& root, const targets::Section& physics) {
  const auto hinge = root.node().optional("hinge");
  if (!physics.optional("reach_mm") || !hinge) return;
  for (const char* key : {"reach_mm", "kind"})
    if (hinge->optional(key))
      throw physics.optional("reach_mm")
          ->key_error("cannot be combined with hinge." + std::string(key) +
                      ", which sets the same length. Remove one of the two keys");
}

}  // namespace

const targets::KeyTable& physics_keys() {
  static const sim::PhysicsOptions usual{};
  static const targets::KeyTable keys(
      {
          {"solver", value::choice({only_solver}), targets::by_default(only_solver),
           "solver of the joints of a step. `direct` solves all at once by a sparse factorisation, which is "
           "exact also for long chains and closed loops"},
          {"step_s", &PhysicsSection::step_s, value::number({0, 0.1, false, true, "seconds"}),
           targets::otherwise("0.01; 0.004, then 0.001 if that run does not end at the model's state; 0.001 "
                              "without a model to "
                              "compare with"),
           "time step"},
          {"disturbance", &PhysicsSection::disturbance, value::number(targets::from_to(0, 1)),
           targets::by_default(usual.disturbance),
           "random disturbance of the first motion of every part, relative to its spin. It shows whether the "
           "simulation still ends in the same state"},
          {"disturbance_seed", &PhysicsSection::disturbance_seed,
           value::integer(0, std::numeric_limits<int>::max()), targets::by_default(0.0),
           "seed of the disturbance"},
          {"reach_mm", &PhysicsSection::reach_mm,
           value::length(targets::from_to(0.01, 10, "mm (0.01 to 10 cells)")),
           targets::otherwise("`hinge.reach_mm`, or that of a hinge with a `kind`; else " +
                              targets::shortest_text(usual.reach) + " cells"),
           "half the distance of the two points at which a hinge joins its bodies"},
      },
      {}, "Section physics",
      {
          {"iterations",
           "was removed: the solver has no iterations. Remove the key, or give a smaller `step_s`"},
          {"error_reduction",
           "was removed: each step closes 0.95 of the gap of a rigid hinge. Remove the key"},
      });
  return keys;
}

PhysicsSection read_physics(const targets::Section& root, double edge_mm) {
  PhysicsSection physics;
  const targets::Section section = root.section("physics");
  check_solver(section);
  check_reach(root, section);
  section.read_into(physics, edge_mm);
  return physics;
}

namespace {

using optim::Symmetry;

// Words of the key `symmetry`.
constexpr targets::Word<Symmetry> symmetries[] = {{"none", Symmetry::none},
                                                  {"mirror_x", Symmetry::mirror_x},
                                                  {"mirror_y", Symmetry::mirror_y},
                                                  {"rotate_2", Symmetry::rotate_2},
                                                  {"rotate_4", Symmetry::rotate_4}};

// Words of the key `kind`: whether springs fold the sheet. `usual` is the earlier name of `auto`.
constexpr targets::Word<bool> kinds[] = {{"auto", false}, {"shape_memory", true}, {"usual", false}};

const targets::KeyTable& keys() {
  static const targets::KeyTable all(
      {
          {"kind", value::choice(kinds), targets::by_default("auto"),
           "`auto`: two plates or one turned hinge, depending on which folds the sheet's family most evenly. "
           "`shape_memory`: a spring in each hinge, whose rest angle changes from flat to that of the "
           "design. "
           "A heated shape-memory material acts like this"},
          {"k_turn", value::number(targets::above(0, "N mm/rad")), targets::needed,
           "rotation stiffness of each such spring", "shape_memory"},
      },
      {{"auto", "shape_memory"}, "kind"});
  return all;
}

bool starts_as_number(const std::string& word) { return word.find_first_of("0123456789.+-") == 0; }

/// Reads the weight of prints; empty if the file does not request it.
std::optional<double> read_robust(const targets::Section& root) {
  const auto node = root.optional("robust");
  if (!node) return std::nullopt;
  const bool is_number =
      node->kind() == targets::Node::Kind::scalar && starts_as_number(node->text("true, false or a weight"));
  if (is_number) return node->number(targets::part_of_one);
  return node->boolean() ? std::optional(1.0) : std::nullopt;
}

/// Rejects springs that would have nothing to turn.
void refuse_idle_drive(const targets::Section& root, const GoalSettings& settings) {
  if (!settings.drive || settings.hinge.model == HingeSection::Model::elastic) return;
  throw root.optional("drive")->key_error(
      "shape_memory needs elastic hinges, which its springs turn. Add `hinge:`, such as `hinge: "
      "{kind: film, material: pp, gap_mm: 2, thickness_mm: 0.4}`");
}

// At 0 nothing folds; at 45 deg a cell with hinges in the middle of its walls has closed.
const targets::Bounds fold = targets::between(0, 45, "degrees");

double read_tilt(const targets::Section& beta, double usual) {
  std::array<double, 2> range = {-usual, usual};
  beta.read("range_deg", range);
  if (!(range[0] < 0 && range[1] > 0))
    throw beta.optional("range_deg")
        ->error(
            "the range has one sign only, and tilts alternate in sign along a crease. Give a range "
            "around 0");
  return std::min(-range[0], range[1]);
}

/// Returns the section with the range of theta, or the innermost section given that could have it.
const targets::Section& place_of_theta(const targets::Section& root, const targets::Section& variables,
                                       const targets::Section& theta) {
  return theta.given() ? theta : variables.given() ? variables : root;
}

}  // namespace

optim::SolverName read_solver_name(const targets::Node& node) {
  std::vector<std::string> names;
  for (const optim::SolverName name : optim::all_solvers()) names.push_back(to_string(name));
  return optim::all_solvers()[node.one_of({names.begin(), names.end()})];
}

targets::KeyTable solver_keys(const std::vector<optim::SolverName>& names, std::optional<int> starts,
                              int max_evaluations, const std::string& evaluations_unit) {
  std::vector<std::string> words;
  std::string meaning;
  for (const optim::SolverName name : names) {
    words.push_back(to_string(name));
    meaning += (meaning.empty() ? "`" : "; `") + words.back() + "`: " + description(name);
  }
  std::vector<targets::Key> keys = {
      {"name", value::choice(words), targets::by_default(words[0].c_str()), meaning}};
  if (starts)
    keys.push_back({"starts", &SolverSection::starts, value::integer(1, 10'000), targets::by_default(*starts),
                    "number of searches, each from another start"});
  keys.push_back({"max_evaluations", &SolverSection::max_evaluations, value::integer(1, 10'000'000),
                  targets::by_default(max_evaluations), "limit of the evaluations " + evaluations_unit});
  return targets::KeyTable(std::move(keys));
}

SolverSection read_solver(const targets::Section& root) {
  SolverSection solver;
  const targets::Section section = root.section("solver");
  if (const auto node = section.optional("name")) solver.name = read_solver_name(*node);
  section.read_into(solver);
  return solver;
}

targets::Key symmetry_key(const std::string& meaning) {
  return {"symmetry", value::choice(symmetries), targets::by_default("none"), meaning};
}

optim::Symmetry read_symmetry(const targets::Section& section, int columns, int rows) {
  Symmetry symmetry = Symmetry::none;
  section.read("symmetry", symmetry, symmetries);
  if (symmetry == Symmetry::rotate_4 && columns != rows)
    throw section.optional("symmetry")
        ->error("rotate_4 needs as many columns as rows, and structure.cells is [" + std::to_string(columns) +
                ", " + std::to_string(rows) + "]. Give none, mirror_x, mirror_y or rotate_2");
  return symmetry;
}

targets::Key goal_drive_key() {
  return {"drive", value::map(keys()), {}, "actuation of a sheet with elastic hinges (`hinge`)"};
}

std::optional<model::ShapeMemory> read_goal_drive(const targets::Section& root) {
  const auto node = root.optional("drive");
  if (!node) return std::nullopt;
  const auto kind = node->optional("kind");
  const bool by_springs = kind && read_word(*kind, kinds);
  const targets::KeyTable own = keys().only(by_springs ? "shape_memory" : "auto");
  const targets::Section section(*node, own);
  if (!by_springs) return std::nullopt;
  model::ShapeMemory springs;
  section.read_needed("k_turn", "a stiffness in N mm/rad", springs.k_turn);
  return springs;
}

void note_process(const GoalSettings& settings, const model::CellSize& size,
                  std::vector<std::string>& notes) {
  const auto note = [&](const std::optional<model::ManufacturedHinge>& made) {
    for (const model::PrintProblem& problem : print_problems(settings.process, size, made)) {
      const std::string text = problem.what + ": the search tries larger cells and walls";
      if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
    }
  };
  note(settings.hinge.made);
  for (const HingePart& part : settings.hinge_parts) note(part.hinge.made);
}

targets::Key robust_key(const std::string& over) {
  return {
      "robust",
      targets::value::either({targets::value::boolean(), targets::value::number(targets::part_of_one)}),
      targets::by_default("false"),
      "selects the design whose [prints](hinges.md#4-print-tolerance) are expected to be nearest to the "
      "goal, among "
      "those that meet it. The choice is over " +
          over +
          ". A number is the weight of the expected print error, and the error of the design itself has the "
          "rest to 1. `true` is 1"};
}

targets::KeyTable goal_keys(std::vector<targets::Key> own, const std::string& hinge,
                            std::vector<targets::Key> more) {
  if (!hinge.empty()) {
    own.push_back({"hinge", hinge_keys(), hinge});
    own.push_back(goal_drive_key());
  }
  own.push_back({"physics", physics_keys(), "settings of the simulation"});
  own.push_back(process_key());
  own.push_back(bed_key());
  own.push_back(lock_key());
  own.insert(own.end(), more.begin(), more.end());
  return file_keys(std::move(own));
}

targets::Key verify_key(double usual) {
  return {"verify", &GoalSettings::verify_tolerance, targets::value::number(targets::part_of_one),
          targets::by_default(usual), "limit of [verify_rms](#verify_rms-and-verify_max), in cell edges"};
}

void read_settings(const targets::Section& root, double edge_mm, GoalSettings& settings) {
  settings.name = read_name(root);
  root.read_into(settings);
  if (root.knows("solver")) settings.solver = read_solver(root);
  settings.physics = read_physics(root, edge_mm);
  settings.process = read_process(root);
  settings.lock = read_lock(root);
  if (root.knows("robust")) settings.robust = read_robust(root);
}

void read_hinges(const targets::Section& root, const std::optional<model::CellSize>& size,
                 GoalSettings& settings) {
  settings.hinge.kind = read_open_kind(root);
  if (const auto hinge = root.optional("hinge"); hinge && !size && !settings.hinge.kind)
    throw hinge->key_error(
        "the size of a hinge needs a known cell size, and the search chooses it. Add structure.cell_mm, or "
        "give `kind` as the only key");
  settings.drive = read_goal_drive(root);
  if (size) {
    settings.hinge = read_hinge_section(root, *size);
    settings.hinge_parts = read_hinge_parts(root, *size);
    refuse_lines(root, settings.hinge_parts);
  }
  refuse_idle_drive(root, settings);
  settings.process = read_process(root);
}

targets::Key tilt_range_key(const optim::AngleRange& usual) {
  return {"range_deg", value::angle_range(targets::from_to(-89, 89, "degrees")),
          targets::by_default_deg(usual.lower, usual.upper), "smallest and largest tilt of a hinge"};
}

targets::Key fold_angle_key(const optim::AngleRange& usual) {
  return targets::Key("fold_angle",
                      targets::KeyTable({{"range_deg", value::angle_range(fold),
                                          targets::by_default_deg(usual.lower, usual.upper),
                                          "smallest and largest fold angle, up to where the walls close the "
                                          "cells"}}),
                      "fold angle, one for the whole sheet")
      .formerly("theta");
}

targets::KeyTable net_variables_keys(double tilt, const optim::AngleRange& theta) {
  targets::Key range = tilt_range_key({-tilt, tilt});
  range.meaning +=
      ". The range contains 0. Tilts alternate in sign, so the end nearer to 0 limits both signs";
  return targets::KeyTable(
      {targets::Key("tilt", targets::KeyTable({range}), "tilts of the hinges").formerly("beta"),
       fold_angle_key(theta)});
}

optim::AngleRange read_theta(const targets::Section& root, const model::CellSize& size,
                             const optim::AngleRange& usual) {
  const targets::Section variables = root.section("variables"), theta = variables.section("fold_angle");
  optim::AngleRange range = usual;
  theta.read("range_deg", range);
  const double closing = closing_theta(size);
  if (range.lower < closing) return range;
  throw place_of_theta(root, variables, theta)
      .error(fmt::format(
          "the range of the fold angle starts above {:.3g} deg, where walls of {:.3g} mm close cells "
          "of {:.3g} mm. Lower variables.fold_angle.range_deg, or give thinner walls",
          to_degrees(closing), size.thickness_mm, size.edge_mm));
}

NetVariables read_net_variables(const targets::Section& root, const model::CellSize& size,
                                const NetVariables& usual) {
  const double tilt = read_tilt(root.section("variables").section("tilt"), usual.tilt);
  return {tilt, read_theta(root, size, usual.theta)};
}

}  // namespace kinetix::app
