#include "app/target_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/file_header.hpp"
#include "app/structure_section.hpp"
#include "app/variables_section.hpp"
#include "targets/read_curve.hpp"

namespace kinetix {
namespace {

constexpr const char* target_hint = "e.g. `target: {kind: curve, points: points.csv}`";
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
}

enum class Kind { curve, display, fold, helmet };

Kind read_kind(const Node& root) {
  const Node target = root.required("target", target_hint);
  const Node kind = target.required("kind", "`kind: curve`, `kind: display`, `kind: fold` or `kind: helmet`");
  const std::vector<std::string_view> kinds = {"curve", "display", "fold", "helmet", "outline"};
  const std::string_view name = kinds[kind.one_of(kinds)];
  if (name == "curve") return Kind::curve;
  if (name == "display") return Kind::display;
  if (name == "fold") return Kind::fold;
  if (name == "helmet") return Kind::helmet;
  throw kind.error("kind " + std::string(name) +
                   " is not supported by this version; supported: curve, display, fold, helmet");
}

Curve read_goal(const Node& root) {
  const Node target = root.required("target", target_hint);
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

void read_variables(const Node& root, TargetFile& file) {
  const auto section = root.optional("variables");
  if (!section) return;
  section->reject_unknown_keys({"beta", "theta"});
  if (const auto beta = section->optional("beta")) {
    beta->reject_unknown_keys({"range_deg", "per", "symmetry"});
    if (const auto range = beta->optional("range_deg")) {
      const auto [lower, upper] = range->angle_range(from_to(-89, 89, "degrees"));
      file.beta = {lower, upper};
    }
    if (const auto per = beta->optional("per")) file.per = read_per(*per);
    if (const auto node = beta->optional("symmetry"))
      file.symmetry = read_symmetry(*node, file.columns, file.rows);
  }
  file.theta = read_theta(*section, file.size, file.theta);
}

void read_tolerance(const Node& root, TargetFile& file) {
  const auto section = root.optional("tolerance");
  if (!section) return;
  section->reject_unknown_keys({"shape", "verify"});
  const Bounds part_of_one = {0, 1, false, true};
  if (const auto node = section->optional("shape")) file.shape_tolerance = node->number(part_of_one);
  if (const auto node = section->optional("verify")) file.verify_tolerance = node->number(part_of_one);
}

TargetFile read_curve_file(const Node& root) {
  root.reject_unknown_keys(
      {"kinetix", "name", "target", "structure", "variables", "tolerance", "solver", "physics"});
  check_version(root);
  TargetFile file{.name = read_name(root), .curve = read_goal(root)};
  read_structure(root, file);
  read_variables(root, file);
  read_tolerance(root, file);
  file.solver = read_solver(root);
  file.physics = read_physics(root, file.size.edge_mm);
  return file;
}

}  // namespace

Target read_target(const std::string& path) { return read_target(read_document(path)); }

Target read_target(const Node& root) {
  check_kind_of_file(root);
  if (root.kind() != Node::Kind::map || !root.optional("target")) return read_curve_file(root);
  switch (read_kind(root)) {
    case Kind::display:
      return read_display_file(root);
    case Kind::fold:
      return read_fold_file(root);
    case Kind::helmet:
      return read_helmet_file(root);
    case Kind::curve:
      break;
  }
  return read_curve_file(root);
}

TargetFile read_curve_target(const std::string& path) {
  Target target = read_target(path);
  if (auto* curve = std::get_if<TargetFile>(&target)) return std::move(*curve);
  throw InvalidInput("the target is not a curve", {path, 0, 0, "target.kind"});
}

std::string name_of(const Target& target) {
  return std::visit([](const auto& file) { return file.name; }, target);
}

}  // namespace kinetix
