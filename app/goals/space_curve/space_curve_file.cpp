#include "app/goals/space_curve/space_curve_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/files/file_header.hpp"
#include "app/files/structure_section.hpp"
#include "targets/document/bound_key.hpp"
#include "targets/space_curve/read_space_curve.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int least_columns = 4, most_columns = 400;  // the search takes some seconds for 400 columns
// Theta (rad) at which a strip has the length of the curve, if the file does not fix both cell edge and cells.
constexpr double usual_strip_theta = 30 * radians_per_degree;
// Fewest columns by default: for a helix of two turns, 16 columns miss the tolerance and 24 meet it.
constexpr int least_usual_columns = 24;
// Length of a climbing strip in plan view, as a ratio to the length of the curve (measured: 0.96 to 1).
constexpr double seen_length = 0.95;
constexpr double smallest_cell_mm = 0.1;  // mm: smaller cells suggest that the points are in metres
// Theta, degrees: at 45 basic cells are closed.
const targets::Bounds folds = targets::between(0, 45, "degrees");
const targets::Bounds tilt = targets::between(-89, 89, "degrees");

targets::KeyTable space_curve_structure_keys(const SpaceCurveFile& usual) {
  return targets::KeyTable({
      cells_key(targets::by_default({static_cast<double>(usual.variables.columns), 1.0}),
                "[columns, 1]; by default fewer, but at least 24, where the process could not print the "
                "walls of so many and fewer can follow the curve; where only `cell_mm` is given, as many "
                "columns as make the strip as long as the curve"),
      cell_mm_key(targets::otherwise("gives the strip the curve's length")),
      wall_mm_key(),
  });
}

targets::KeyTable strip_variables_keys() {
  using Variables = optim::SpaceVariables;
  static const Variables usual{};
  const targets::KeyTable beta(
      {{"range_deg", value::angle_range(tilt), targets::by_default_deg(-usual.beta, usual.beta),
        "tilts of bending columns; the side that is nearer to 0 counts for both"}});
  const targets::KeyTable t({{"range", &Variables::t, value::range(targets::place_along),
                              "where hinges of shearing columns may sit on their walls; the side that is "
                              "nearer to 0.5 counts for both"}});
  const targets::KeyTable theta(
      {{"range_deg", &Variables::theta, value::angle_range(folds),
        "turn of the bodies in the folded state; several within the range are tried where `cell_mm` is left "
        "out"}});
  return targets::KeyTable({
      {"beta", beta, "the tilts of the hinges"},
      {"t", t, "where hinges sit on their walls"},
      {"theta", theta, "how far the strip is folded"},
  });
}

int read_columns(const targets::Node& node) {
  const auto sides = as_rectangle(read_cells(node));
  if (!sides || (*sides)[1] != 1)
    throw node.error("a strip for a curve in space is one row of cells; give [columns, 1]");
  if ((*sides)[0] < least_columns || (*sides)[0] > most_columns)
    throw node.error(fmt::format("{} columns; give {} to {}", (*sides)[0], least_columns, most_columns));
  return (*sides)[0];
}

double usual_edge(const SpaceCurveFile& file) {
  return file.wanted.length() / (file.variables.columns * std::cos(usual_strip_theta));
}

/// Returns the default number of columns, for a file that leaves all sizes open. It is the largest number that the
/// process can print with walls by default_size, at the lower end of theta, where cells are smallest.
///
/// The number is between 24 and the usual one. It is the usual one if such wide columns cannot follow the curve.
int printable_columns(const SpaceCurveFile& file, const model::Process& process) {
  const double least_mm = least_cell_mm(process, default_size(1), {}),
               most = seen_length * file.wanted.length() / (least_mm * std::cos(file.variables.theta.lower));
  SpaceCurveFile fewer = file;
  fewer.variables.columns =
      static_cast<int>(std::clamp(std::floor(most), static_cast<double>(least_usual_columns),
                                  static_cast<double>(file.variables.columns)));
  fewer.variables.size = default_size(usual_edge(fewer));
  return obstacle(fewer.wanted, fewer.variables) ? file.variables.columns : fewer.variables.columns;
}

void check_unit(const targets::Section& root, const SpaceCurveFile& file) {
  if (usual_edge(file) >= smallest_cell_mm) return;
  throw root.required("target", "")
      .error(fmt::format("the curve is {:.6g} mm long, so that {} cells would be {:.3g} mm small; points "
                         "are in millimetres; are these "
                         "metres? If not, give structure.cell_mm",
                         file.wanted.length(), file.variables.columns, usual_edge(file)));
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
  v.size = read_size(structure, usual_edge(file));
  if (!cell_mm || cells) return;
  const double fitting = std::round(length / (v.size.edge_mm * std::cos(usual_strip_theta)));
  if (!(fitting >= least_columns && fitting <= most_columns))
    throw cell_mm->error(
        fmt::format("a curve of {:.6g} mm would take {:.0f} cells of {:.6g} mm; give {} to {} columns",
                    length, fitting, v.size.edge_mm, least_columns, most_columns));
  v.columns = static_cast<int>(fitting);
}

void read_variables(const targets::Section& root, SpaceCurveFile& file) {
  const targets::Section variables = root.section("variables");
  optim::SpaceVariables& v = file.variables;
  const targets::Section beta = variables.section("beta");
  std::array<double, 2> tilts = {-v.beta, v.beta};
  beta.read("range_deg", tilts);
  if (!(tilts[0] < 0 && tilts[1] > 0))
    throw beta.optional("range_deg")->error("must hold 0, an upright hinge");
  v.beta = std::min(-tilts[0], tilts[1]);
  root.read_into(v);
  if (!(v.t[0] < 0.5 && v.t[1] > 0.5))
    throw variables.section("t").optional("range")->error("must hold 0.5, where hinges start");
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
      ->error(fmt::format(
          "{} cells of {:.6g} mm are {:.4g} to {:.4g} mm long within the range of theta, but the curve is "
          "{:.4g} mm long",
          v.columns, v.size.edge_mm, least, most, file.wanted.length()));
}

void check_reach(const SpaceCurveFile& file, const targets::Node& points, const std::vector<Place>& places) {
  const auto found = points.located([&] { return obstacle(file.wanted, file.variables); });
  if (!found) return;
  const auto& arcs = file.wanted.line().arcs();
  const auto after = std::upper_bound(arcs.begin(), arcs.end(), found->arc_mm) - arcs.begin();
  throw InvalidInput(found->why, places[std::min<std::size_t>(after, places.size()) - 1]);
}

}  // namespace

const targets::KeyTable& space_curve_keys() {
  static const SpaceCurveFile usual(targets::SpaceGoal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::space_curve_target_keys(), "the goal", targets::needed},
          {"structure", space_curve_structure_keys(usual), "the flat strip"},
          {"variables", strip_variables_keys(), "what the search may change, and how far"},
          {"tolerance",
           targets::KeyTable({
               {"shape", &SpaceCurveFile::shape_tolerance, value::number(targets::part_of_one),
                targets::by_default(usual.shape_tolerance),
                "most of [shape_rms](#shape_rms-and-shape_max), over the diagonal of the curve's bounding "
                "box"},
               verify_key(),
           }),
           "when the goal is met"},
      },
      sized_hinge, {robust_key()});
  return keys;
}

SpaceCurveFile read_space_curve_file(const targets::Node& node) {
  const targets::Section root = read_root(node, space_curve_keys());
  const targets::Node points = root.section("target").required(
      "points", "the path of a CSV file or a list of points [[x, y, z], ...] in mm");
  targets::ReadSpaceGoal goal = targets::read_space_goal(points);
  SpaceCurveFile file(std::move(goal.goal));
  read_variables(root, file);
  read_structure(root, file);
  root.read_into(file);
  check_length(root, file);
  check_reach(file, points, goal.places);
  read_hinges(root, file.variables.free_edge ? std::nullopt : std::optional(file.variables.size), file);
  read_settings(root, file.variables.size.edge_mm, file);
  return file;
}

}  // namespace kinetix::app
