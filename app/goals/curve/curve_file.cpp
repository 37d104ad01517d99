#include "app/goals/curve/curve_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/files/file_header.hpp"
#include "app/files/goal_settings.hpp"
#include "app/files/process_section.hpp"
#include "app/files/structure_section.hpp"
#include "optim/curve/bend_ties.hpp"
#include "optim/solvers/multi_start.hpp"
#include "targets/curve/read_curve.hpp"
#include "targets/document/bound_key.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int least_default_columns = 8;  // fewer are corners, not a curve
constexpr int max_columns = 1000;         // the tilt of each column is a variable of the search

// Theta (rad) at which a strip has the length of the curve if the file gives no cell edge. It is far from both ends of
// the usual range (2 to 44 deg), so the search can make the strip longer or shorter.
constexpr double default_theta = 30 * radians_per_degree;
// mm: smaller cells suggest that the points are in metres.
constexpr double smallest_default_cell_mm = 0.1;

constexpr double share_of_rise = 0.05;           // ratio to the rise of a curve: 1.25 mm for an arch of 25 mm
constexpr double least_shape_tolerance = 0.001;  // ratio to the diagonal: limit for nearly straight curves

targets::Curve read_goal(const targets::Section& root) {
  const targets::Section target = root.section("target");
  return read_curve(
      target.required("points", "the path of a CSV file or a list of points [[x, z], ...] in mm"));
}

/// Returns the largest distance (mm) of the curve from the chord between its ends. For a closed curve, returns the
/// largest distance from its first point.
double rise(const targets::Curve& curve) {
  const Eigen::Vector2d from = curve.points().front(), chord = curve.points().back() - from;
  const bool is_closed = chord.norm() < 1e-9 * curve.diagonal();
  double most = 0;
  for (const Eigen::Vector2d& p : curve.points()) {
    const Eigen::Vector2d to = p - from;
    const double beside =
        is_closed ? to.norm() : std::abs(chord.x() * to.y() - chord.y() * to.x()) / chord.norm();
    most = std::max(most, beside);
  }
  return most;
}

std::string length_text(double mm) { return fmt::format("{:.6g} mm", mm); }

void check_cell_against_curve(const targets::Node& cell_mm, double edge_mm, double curve_mm) {
  if (edge_mm > curve_mm)
    throw cell_mm.error("a cell of " + length_text(edge_mm) + " is larger than the whole curve, which is " +
                        length_text(curve_mm) + " long; points are in millimetres; are these metres?");
}

/// Returns default_theta, clamped to `variables.theta.range_deg`.
double length_theta(const targets::Section& root, const optim::AngleRange& usual) {
  optim::AngleRange range = usual;
  root.section("variables").section("theta").read("range_deg", range);
  return std::clamp(default_theta, range.lower, range.upper);
}

double default_edge(const targets::Section& root, double curve_mm, int columns, double theta) {
  const double edge = curve_mm / (columns * std::cos(theta));
  if (edge < smallest_default_cell_mm)
    throw root.required("target", "")
        .error("the curve is " + length_text(curve_mm) + " long, so that " + std::to_string(columns) +
               " cells would be " + length_text(edge) +
               " small; points are in millimetres; are these metres? If not, give structure.cell_mm");
  return edge;
}

/// Returns the number of columns that the process can print with walls by default_size, between 8 and `usual`.
int default_columns(double curve_mm, double theta, const model::Process& process, int usual) {
  const double printed = curve_mm / (least_cell_mm(process, default_size(1), {}) * std::cos(theta));
  return static_cast<int>(std::clamp(std::floor(printed), static_cast<double>(least_default_columns),
                                     static_cast<double>(usual)));
}

/// Reads columns and rows of the cells; nullopt if the file leaves them out.
std::optional<std::array<int, 2>> read_sides(const targets::Section& structure) {
  const auto node = structure.optional("cells");
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

void read_structure(const targets::Section& root, CurveFile& file) {
  const double length = file.curve.length(), theta = length_theta(root, file.theta);
  const targets::Section structure = root.section("structure");
  const auto sides = read_sides(structure);
  if (sides) std::tie(file.columns, file.rows) = std::pair{(*sides)[0], (*sides)[1]};
  const auto cell_mm = structure.optional("cell_mm");
  file.free_size = !cell_mm;
  file.free_walls = !structure.optional("wall_mm");
  if (!sides && file.free_size && file.free_walls)
    file.columns = default_columns(length, theta, read_process(root), file.columns);
  file.size = read_size(structure, cell_mm ? 1.0 : default_edge(root, length, file.columns, theta));
  if (!cell_mm) return;
  check_cell_against_curve(*cell_mm, file.size.edge_mm, length);
  const double fitting = std::round(length / (file.size.edge_mm * std::cos(theta)));
  if (!sides && fitting > max_columns)
    throw cell_mm->error(fmt::format("a curve of {} would take {:.0f} cells of {}; at most {} columns",
                                     length_text(length), fitting, length_text(file.size.edge_mm),
                                     max_columns));
  if (!sides) file.columns = static_cast<int>(std::max(fitting, 2.0));
}

optim::Per read_per(const targets::Node& node) {
  const std::vector<std::string_view> all = {"column", "all", "row", "cell", "hinge"};
  const std::size_t choice = node.one_of(all);
  if (choice > 1)
    throw node.error(
        "`" + std::string(all[choice]) +
        "` would leave the family that moves exactly, in which all hinges of a column tilt alike; "
        "allowed for a curve: column, all");
  return choice == 0 ? optim::Per::column : optim::Per::all;
}

void read_variables(const targets::Section& root, CurveFile& file) {
  const targets::Section section = root.section("variables");
  if (!section.given()) return;
  const targets::Section beta = section.section("beta");
  beta.read("range_deg", file.beta);
  if (const auto per = beta.optional("per")) file.per = read_per(*per);
  file.symmetry = read_symmetry(beta, file.columns, file.rows);
  if (const auto node = section.optional("beta"))
    node->located([&] { make_bend_ties(file.columns, file.per, file.symmetry, file.beta); });
  file.theta = read_theta(root, file.size, file.theta);
}

/// Returns the default tolerance: the least of 0.01, half a cell and a twentieth of the curve's rise, and at least
/// 0.001. All are ratios to the diagonal.
double usual_shape_tolerance(const CurveFile& file) {
  const double diagonal = file.curve.diagonal();
  const double seen = std::min(GoalSettings::grain * file.size.edge_mm / diagonal,
                               share_of_rise * rise(file.curve) / diagonal);
  return std::clamp(seen, least_shape_tolerance, file.shape_tolerance);
}

targets::KeyTable curve_structure_keys(const CurveFile& usual) {
  return targets::KeyTable({
      cells_key(targets::by_default({static_cast<double>(usual.columns), static_cast<double>(usual.rows)}),
                "the cells of the strip, a rectangle of at least 2 columns; by default fewer, but at least "
                "8, where the "
                "process could not print the walls of so many; where only `cell_mm` is given, as many "
                "columns as make the "
                "strip as long as the curve"),
      cell_mm_key(targets::otherwise("gives the strip the curve's length at theta = 30 degrees, or what is "
                                     "nearest to it of `variables.theta`")),
      wall_mm_key(),
  });
}

targets::KeyTable variables_keys(const CurveFile& usual) {
  targets::Key range = tilt_range_key(usual.beta);
  range.meaning += " of the first row; tilts change sign from row to row";
  const targets::KeyTable beta({
      range,
      {"per", value::choice({"column", "all"}), targets::by_default("column"),
       "which hinges tilt alike; under `all`, the tilts of neighbouring columns have opposite signs"},
      symmetry_key("of the folded shape; no strip has `rotate_4`"),
  });
  return targets::KeyTable({{"beta", beta, "the tilts of the hinges"}, theta_key(usual.theta)});
}

}  // namespace

const targets::KeyTable& curve_keys() {
  static const CurveFile usual(targets::Curve({{0, 0}, {1, 0}, {2, 0}}));
  static const optim::MultiStartOptions search{};
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::curve_target_keys(), "the goal", targets::needed},
          {"structure", curve_structure_keys(usual), "the flat sheet"},
          {"variables", variables_keys(usual), "what the search may change, and how far"},
          {"tolerance",
           targets::KeyTable({
               {"shape", &CurveFile::shape_tolerance, value::number(targets::part_of_one),
                targets::otherwise("0.01; less for a flat curve (a twentieth of its rise over its chord), or "
                                   "small cells (half of "
                                   "one), but at least 0.001"),
                "most of [shape_rms](#shape_rms-and-shape_max), over the diagonal of the curve's bounding "
                "box"},
               verify_key(),
           }),
           "when the goal is met"},
          {"solver",
           solver_keys(optim::all_solvers(), search.starts, search.solver.max_evaluations, "per start"),
           "how the search is run"},
      },
      any_hinge,
      {robust_key("theta, gaps of blocks and films and, where `structure.cell_mm` is left out, numbers of "
                  "columns")});
  return keys;
}

CurveFile read_curve_file(const targets::Node& node) {
  const targets::Section root = read_root(node, curve_keys());
  CurveFile file(read_goal(root));
  read_structure(root, file);
  read_variables(root, file);
  file.shape_tolerance = usual_shape_tolerance(file);
  root.read_into(file);
  read_settings(root, file.size.edge_mm, file);
  read_hinges(root, file.size, file);
  return file;
}

}  // namespace kinetix::app
