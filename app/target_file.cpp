#include "app/target_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/file_header.hpp"
#include "app/structure_section.hpp"
#include "model/wall_contact.hpp"
#include "targets/read_curve.hpp"

namespace kinetix {
namespace {

constexpr int default_columns = 40;
constexpr int max_columns = 1000;
constexpr double default_theta = 30 * radians_per_degree;
constexpr double smallest_default_cell_mm = 0.1;

void check_kind_of_file(const Node& root) {
  if (root.kind() == Node::Kind::map && !root.optional("target")) {
    if (root.optional("design"))
      throw root.error("this is a design, not a target; use it with verify, simulate or export");
    if (root.optional("factors"))
      throw root.error("this is a design of experiments, not a target; use it with sweep");
  }
  root.reject_unknown_keys(
      {"kinetix", "name", "target", "structure", "variables", "tolerance", "solver", "physics"});
}

Curve read_goal(const Node& root) {
  const Node target = root.required("target", "e.g. `target: {kind: curve, points: points.csv}`");
  const Node kind = target.required("kind", "`kind: curve`");
  const std::vector<std::string_view> kinds = {"curve", "display", "fold", "helmet", "outline"};
  const std::string_view name = kinds[kind.one_of(kinds)];
  if (name != "curve")
    throw kind.error("kind " + std::string(name) + " is not supported by this version; supported: curve");
  target.reject_unknown_keys({"kind", "points"});
  return read_curve(
      target.required("points", "the path of a CSV file or a list of points [[x, z], ...] in mm"));
}

std::string length_text(double mm) { return fmt::format("{:.6g} mm", mm); }

void check_cell_against_curve(const Node& cell_mm, double edge_mm, double curve_mm) {
  if (edge_mm > curve_mm)
    throw cell_mm.error("a cell of " + length_text(edge_mm) + " is larger than the whole curve, which is " +
                        length_text(curve_mm) + " long; points are in millimetres; are these metres?");
}

double default_edge(const Node& root, double curve_mm, int columns) {
  const double edge = curve_mm / (columns * std::cos(default_theta));
  if (edge < smallest_default_cell_mm)
    throw root.required("target", "")
        .error("the curve is " + length_text(curve_mm) + " long, so that " + std::to_string(columns) +
               " cells would be " + length_text(edge) +
               " small; points are in millimetres; are these metres? If not, give structure.cell_mm");
  return edge;
}

/// Columns and rows of the asked cells; nothing where they are left out.
std::optional<std::array<int, 2>> read_sides(const std::optional<Node>& structure) {
  const auto node = structure ? structure->optional("cells") : std::nullopt;
  if (!node) return std::nullopt;
  const auto sides = as_rectangle(read_cells(*node));
  if (!sides) throw node->error("the cells of a curve must fill a rectangle; give [columns, rows]");
  if ((*sides)[0] < 2)
    throw node->error(
        "a curve needs at least 2 columns of cells along x; give [columns, rows] such as [40, 1]");
  if ((*sides)[0] > max_columns)
    throw node->error(
        fmt::format("{} columns are more than a search can fit; at most {}", (*sides)[0], max_columns));
  return sides;
}

void read_structure(const Node& root, TargetFile& file) {
  const double length = file.curve.length();
  const auto structure = root.optional("structure");
  if (structure) structure->reject_unknown_keys({"cells", "cell_mm", "wall_mm"});
  const auto sides = read_sides(structure);
  if (sides) std::tie(file.columns, file.rows) = std::pair{(*sides)[0], (*sides)[1]};
  const auto cell_mm = structure ? structure->optional("cell_mm") : std::nullopt;
  file.size = read_size(structure, cell_mm ? 1.0 : default_edge(root, length, file.columns));
  if (!cell_mm) return;
  check_cell_against_curve(*cell_mm, file.size.edge_mm, length);
  const double fitting = std::round(length / (file.size.edge_mm * std::cos(default_theta)));
  if (!sides && fitting > max_columns)
    throw cell_mm->error(fmt::format("a curve of {} would take {:.0f} cells of {}; at most {} columns",
                                     length_text(length), fitting, length_text(file.size.edge_mm),
                                     max_columns));
  if (!sides) file.columns = static_cast<int>(std::max(fitting, 2.0));
}

AngleRange read_angles(const Node& section, const AngleRange& fallback, const Bounds& degrees) {
  const auto node = section.optional("range_deg");
  if (!node) return fallback;
  const auto [lower, upper] = node->angle_range(degrees);
  return {lower, upper};
}

Per read_per(const Node& node) {
  const std::vector<std::string_view> all = {"column", "all", "row", "cell", "hinge"};
  const std::size_t choice = node.one_of(all);
  if (choice > 1)
    throw node.error(
        "`" + std::string(all[choice]) +
        "` would leave the family that moves exactly, in which all hinges of a column tilt alike; "
        "allowed for a curve: column, all");
  return choice == 0 ? Per::column : Per::all;
}

Symmetry read_symmetry(const Node& node, int columns, int rows) {
  const auto symmetry = node.choice<Symmetry>({{"none", Symmetry::none},
                                               {"mirror_x", Symmetry::mirror_x},
                                               {"mirror_y", Symmetry::mirror_y},
                                               {"rotate_2", Symmetry::rotate_2},
                                               {"rotate_4", Symmetry::rotate_4}});
  if (symmetry == Symmetry::rotate_4 && columns != rows)
    throw node.error("rotate_4 needs as many columns as rows, and structure.cells is [" +
                     std::to_string(columns) + ", " + std::to_string(rows) +
                     "]; allowed here: none, mirror_x, mirror_y, rotate_2");
  return symmetry;
}

void read_variables(const Node& root, TargetFile& file) {
  const auto section = root.optional("variables");
  if (!section) return;
  section->reject_unknown_keys({"beta", "theta"});
  if (const auto beta = section->optional("beta")) {
    beta->reject_unknown_keys({"range_deg", "per", "symmetry"});
    file.beta = read_angles(*beta, file.beta, from_to(-89, 89, "degrees"));
    if (const auto per = beta->optional("per")) file.per = read_per(*per);
    if (const auto node = beta->optional("symmetry"))
      file.symmetry = read_symmetry(*node, file.columns, file.rows);
  }
  if (const auto theta = section->optional("theta")) {
    theta->reject_unknown_keys({"range_deg"});
    file.theta = read_angles(*theta, file.theta, between(0, 45, "degrees"));
    if (!(file.theta.lower < closing_theta(file.size)))
      throw theta->error(fmt::format(
          "the range starts above {:.2f} deg, where walls of {:.3g} mm close cells of {:.3g} mm",
          closing_theta(file.size) / radians_per_degree, file.size.thickness_mm, file.size.edge_mm));
  }
}

void read_tolerance(const Node& root, TargetFile& file) {
  const auto section = root.optional("tolerance");
  if (!section) return;
  section->reject_unknown_keys({"shape", "verify"});
  const Bounds part_of_one = {0, 1, false, true};
  if (const auto node = section->optional("shape")) file.shape_tolerance = node->number(part_of_one);
  if (const auto node = section->optional("verify")) file.verify_tolerance = node->number(part_of_one);
}

SolverName read_solver_name(const Node& node) {
  std::vector<std::string> names;
  for (const SolverName name : all_solvers()) names.push_back(to_string(name));
  return all_solvers()[node.one_of({names.begin(), names.end()})];
}

SolverSection read_solver(const Node& root) {
  SolverSection solver;
  const auto section = root.optional("solver");
  if (!section) return solver;
  section->reject_unknown_keys({"name", "starts", "max_evaluations"});
  if (const auto node = section->optional("name")) solver.name = read_solver_name(*node);
  if (const auto node = section->optional("starts")) solver.starts = node->integer(1, 10'000);
  if (const auto node = section->optional("max_evaluations"))
    solver.max_evaluations = node->integer(1, 10'000'000);
  return solver;
}

}  // namespace

TargetFile read_target(const std::string& path) {
  const Node root = read_document(path);
  check_kind_of_file(root);
  check_version(root);
  TargetFile file{.name = read_name(root), .curve = read_goal(root)};
  read_structure(root, file);
  read_variables(root, file);
  read_tolerance(root, file);
  file.solver = read_solver(root);
  file.physics = read_physics(root, file.size.edge_mm);
  return file;
}

}  // namespace kinetix
