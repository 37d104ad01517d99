#include "app/goals/curve/curve_search.hpp"

#include <fmt/format.h>
#include <numeric>
#include <tuple>

#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "app/files/structure_section.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/print_tolerance.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/run/design_hinges.hpp"
#include "targets/curve/read_curve.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int min_default_columns = 8;  // fewer are corners, not a curve
constexpr int max_columns = 1000;       // the tilt of each column is a variable of the search

// Theta (rad) at which a strip has the length of the curve if the file gives no cell edge. It is far from both ends of
// the usual range (2 to 44 deg), so the search can make the strip longer or shorter.
constexpr double default_theta = 30 * radians_per_degree;
// mm: smaller cells suggest that the points are in metres.
constexpr double smallest_default_cell_mm = 0.1;

constexpr double share_of_rise = 0.05;         // ratio to the rise of a curve: 1.25 mm for an arch of 25 mm
constexpr double min_shape_tolerance = 0.001;  // ratio to the diagonal: limit for nearly straight curves

/// A cell edge in the file shows that a small or large curve is meant.
targets::Curve read_goal(const targets::Section& root, std::vector<std::string>& notes) {
  const targets::Section target = root.section("target");
  target.required("points", "the path of a file or a list of points [[x, z], ...] in mm");
  return read_curve(target, !root.section("structure").optional("cell_mm"), notes);
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

std::string length_text(double mm) { return fmt::format("{:.3g} mm", mm); }

void check_cell_against_curve(const targets::Node& cell_mm, double edge_mm, double curve_mm) {
  if (edge_mm > curve_mm)
    throw cell_mm.error("a cell of " + length_text(edge_mm) + " is larger than the whole curve, which is " +
                        length_text(curve_mm) + " long. Give smaller cells, or points in millimetres");
}

/// Returns default_theta, clamped to `variables.fold_angle.range_deg`.
double length_theta(const targets::Section& root, const optim::AngleRange& usual) {
  optim::AngleRange range = usual;
  root.section("variables").section("fold_angle").read("range_deg", range);
  return std::clamp(default_theta, range.lower, range.upper);
}

double default_edge(const targets::Section& root, double curve_mm, int columns, double theta) {
  const double edge = curve_mm / (columns * std::cos(theta));
  if (edge < smallest_default_cell_mm)
    throw root.required("target", "")
        .error("the curve is " + length_text(curve_mm) + " long, and " + std::to_string(columns) +
               " cells on it would have " + length_text(edge) +
               ". Give points in millimetres, or structure.cell_mm for a curve this small");
  return edge;
}

/// Returns the number of columns that the process can print with walls by default_size, between 8 and `usual`.
int default_columns(double curve_mm, double theta, const model::Process& process, int usual) {
  const double printed = curve_mm / (min_cell_mm(process, default_size(1), {}) * std::cos(theta));
  return static_cast<int>(
      std::clamp(std::floor(printed), static_cast<double>(min_default_columns), static_cast<double>(usual)));
}

/// Reads columns and rows of the cells; nullopt if the file leaves them out.
std::optional<std::array<int, 2>> read_sides(const targets::Section& structure) {
  const auto node = structure.optional("cells");
  if (!node) return std::nullopt;
  const auto sides = as_rectangle(read_cells(*node));
  if (!sides)
    throw node->error("the cells do not fill a rectangle, which a curve needs. Give [columns, rows]");
  if ((*sides)[0] < 2)
    throw node->error(
        "a curve needs at least 2 columns of cells along x. Give [columns, rows] such as [40, 1]");
  if ((*sides)[0] > max_columns)
    throw node->error(
        fmt::format("{} columns are too many for a search. Give at most {}", (*sides)[0], max_columns));
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
    throw cell_mm->error(
        fmt::format("a curve of {} needs {:.0f} cells of {}, and the limit is {} columns. Give "
                    "larger cells",
                    length_text(length), fitting, length_text(file.size.edge_mm), max_columns));
  if (!sides) file.columns = static_cast<int>(std::max(fitting, 2.0));
}

optim::Per read_per(const targets::Node& node) {
  const std::vector<std::string_view> all = {"column", "all", "row", "cell", "hinge"};
  const std::size_t choice = node.one_of(all);
  if (choice > 1)
    throw node.error("`" + std::string(all[choice]) +
                     "` is not possible for a curve: a strip has one degree of freedom only if all hinges of "
                     "a column tilt "
                     "equally. Give `column` or `all`");
  return choice == 0 ? optim::Per::column : optim::Per::all;
}

void read_variables(const targets::Section& root, CurveFile& file) {
  const targets::Section section = root.section("variables");
  if (!section.given()) return;
  const targets::Section beta = section.section("tilt");
  beta.read("range_deg", file.beta);
  if (const auto per = beta.optional("per")) file.per = read_per(*per);
  file.symmetry = read_symmetry(beta, file.columns, file.rows);
  if (const auto node = section.optional("tilt"))
    node->located([&] { make_bend_ties(file.columns, file.per, file.symmetry, file.beta); });
  file.theta = read_theta(root, file.size, file.theta);
}

/// Returns the default tolerance: the least of 0.01, half a cell and a twentieth of the curve's rise, and at least
/// 0.001. All are ratios to the diagonal.
double usual_shape_tolerance(const CurveFile& file) {
  const double diagonal = file.curve.diagonal();
  const double seen = std::min(GoalSettings::grain * file.size.edge_mm / diagonal,
                               share_of_rise * rise(file.curve) / diagonal);
  return std::clamp(seen, min_shape_tolerance, file.shape_tolerance);
}

targets::KeyTable curve_structure_keys(const CurveFile& usual) {
  return targets::KeyTable({
      cells_key(
          targets::by_default({static_cast<double>(usual.columns), static_cast<double>(usual.rows)}),
          "cells of the strip, a rectangle of at least 2 columns. The default is reduced, to 8 columns at "
          "least, if the process cannot print such thin walls. If only `cell_mm` is given, the number of "
          "columns follows from the length of the curve"),
      cell_mm_key(
          targets::otherwise("gives the strip the curve's length at a fold angle of 30 degrees, or at "
                             "the nearest one within `variables.fold_angle`")),
      wall_mm_key(),
  });
}

targets::KeyTable variables_keys(const CurveFile& usual) {
  targets::Key range = tilt_range_key(usual.beta);
  range.meaning += " of the first row. Tilts change sign from row to row";
  const targets::KeyTable beta({
      range,
      {"per", value::choice({"column", "all"}), targets::by_default("column"),
       "hinges that have equal tilts. With `all`, the tilts of neighbouring columns have opposite signs"},
      symmetry_key("symmetry of the folded shape. `rotate_4` is not possible"),
  });
  return targets::KeyTable(
      {targets::Key("tilt", beta, "tilts of the hinges").formerly("beta"), fold_angle_key(usual.theta)});
}

}  // namespace

const targets::KeyTable& curve_keys() {
  static const CurveFile usual(targets::Curve({{0, 0}, {1, 0}, {2, 0}}));
  static const optim::MultiStartOptions search{};
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::curve_target_keys(), "the goal", targets::needed},
          {"structure", curve_structure_keys(usual), "flat sheet"},
          {"variables", variables_keys(usual), "quantities that the search changes, with their ranges"},
          {"tolerance",
           targets::KeyTable({
               {"shape", &CurveFile::shape_tolerance, value::number(targets::part_of_one),
                targets::otherwise("0.01; less for a flat curve (a twentieth of its rise over its chord) or "
                                   "small cells (half a cell), and at least 0.001"),
                "limit of [shape_rms](#shape_rms-and-shape_max), relative to the diagonal of the curve's "
                "bounding box"},
               verify_key(),
           }),
           "limits for a met goal"},
          {"solver",
           solver_keys(optim::all_solvers(), search.starts, search.solver.max_evaluations, "per start"),
           "solver of the search"},
      },
      any_hinge,
      {robust_key(
          "the fold angle, gaps of blocks and living hinges and, without `structure.cell_mm`, the number of "
          "columns")});
  return keys;
}

CurveFile read_curve_file(const targets::Node& node) {
  const targets::Section root = read_root(node, curve_keys());
  std::vector<std::string> notes;
  CurveFile file(read_goal(root, notes));
  file.input_notes = std::move(notes);
  read_structure(root, file);
  read_variables(root, file);
  file.shape_tolerance = usual_shape_tolerance(file);
  root.read_into(file);
  read_settings(root, file.size.edge_mm, file);
  read_hinges(root, file.size, file);
  return file;
}

namespace {

// Numbers of columns to try, as ratios to the file's. Fewer columns have fewer hinge errors but larger design errors.
constexpr double column_shares[] = {1, 0.8, 0.65, 0.5};
// Number of starts per strip. The plain search uses more starts, and they lead to the same result.
constexpr int starts = 2;
constexpr int fewest_columns = 4;
// Gaps of elastomer and living hinges to try for the best strip, as ratios to the file's gap. Longer gaps turn more
// softly and are weaker across.
constexpr double strip_gap_shares[] = {0.5, 0.7, 1.4, 2};
// Margin (rad) below the theta at which basic cells with these walls close.
constexpr double below_closing = 0.02;

/// Returns the strip with its gaps scaled by `share`; nullopt if such a hinge cannot be made.
std::optional<CurveFile> with_gaps(CurveFile file, double share) {
  model::ManufacturedHinge& made = *file.hinge.made;
  made.gap_mm *= share;
  try {
    validate(made, file.size);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
  return file;
}

using SearchResultMaker = std::function<SearchResult(const CurveStrip&)>;

/// Fills in the candidate of a strip from its closed form and the first-order print tolerance.
CurveStrip evaluate_strip(const Goal& goal, CurveStrip strip, const SearchResultMaker& make_search_result,
                          const RunOptions& options) {
  const optim::CurveDesign& design = strip.found.design;
  CurveCandidate out{unevaluated_candidate(design.design.theta, strip.file.size.edge_mm, strip.file.hinge),
                     strip.file.columns, design.error.rms};
  out.designed_mm = design.error.rms * design.error.scale_mm;
  const SearchResult found = planned(with_printed_hinges(make_search_result(strip), options));
  const model::Lattice& sheet = found.design.structure;
  const auto printed = estimate_print_tolerance(found, goal_drive(found, sheet, out.theta), found.own,
                                                goal.observe(found, sheet, found.own)->points);
  if (printed)
    std::tie(out.printed_mm, out.printed_p95_mm) = std::pair{printed->made.rms_mm, printed->made.p95_mm};
  out.is_allowed = printed && printed->can_be_printed && !strip.found.contact.touches &&
                   withstands_strain(found.design, found.own) &&
                   design.error.rms <= strip.file.shape_tolerance &&
                   (!options.printable || has_pins_alone(found.design) ||
                    (found.design.hinge.model == HingeSection::Model::elastic &&
                     options.printable(requested_design(found)).is_accepted));
  strip.candidate = std::move(out);
  return strip;
}

/// Returns the k-th theta to try, rad.
double theta_at(const CurveFile& file, int k) {
  const double upper = std::min(file.theta.upper, closing_theta(file.size) - below_closing);
  return file.theta.lower + narrow_theta +
         (upper - file.theta.lower - 2 * narrow_theta) * k / (robust_thetas - 1);
}

/// Returns the file with theta fixed and, if the cell size is free, with cells that give the strip the curve's length.
CurveFile with(CurveFile file, int columns, double theta) {
  file.columns = columns;
  file.theta = {theta - narrow_theta / 2, theta + narrow_theta / 2};
  if (!file.free_size) return file;
  const double edge = file.curve.length() / (columns * std::cos(theta));
  const model::CellSize before = file.size;
  if (file.free_walls) file.size = default_size(edge);
  file.size.edge_mm = edge;
  const auto fit = [&](HingeSection& hinge) {
    if (hinge.made) hinge.made = fitted(*hinge.made, before, file.size);
  };
  fit(file.hinge);
  for (HingePart& part : file.hinge_parts) fit(part.hinge);
  return file;
}

/// Compensates the plain strip and the best strips by closed form for elastic hinges, and measures them again.
/// @return index of the best
std::size_t find_best_compensated(const Goal& goal, std::vector<CurveStrip>& all,
                                  const SearchResultMaker& make_search_result, const RunOptions& options) {
  const double weight = *all.front().file.robust;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin() + 1, order.end(), [&](std::size_t a, std::size_t b) {
    return is_more_robust(weight, all[a].candidate, all[b].candidate);
  });
  order.resize(std::min(order.size(), robust_finalists));
  RunOptions quiet = options;
  quiet.progress = {};
  std::size_t best = 0;
  for (std::size_t k = 0; k < order.size() && !options.stop.stop_requested(); ++k) {
    options.progress("robust search", static_cast<double>(k) / static_cast<double>(order.size()),
                     fmt::format("hinges of design {} of {}", k + 1, order.size()));
    CurveStrip& one = all[order[k]];
    static_cast<RobustCandidate&>(one.candidate) = robust_candidate(make_search_result(one), goal, quiet);
    one.candidate.is_compensated = true;
    if (k > 0 && is_more_robust(weight, one.candidate, all[best].candidate)) best = order[k];
  }
  return best;
}

std::vector<int> columns_of(const CurveFile& file) {
  if (!file.free_size) return {file.columns};
  std::vector<int> all;
  for (const double share : column_shares) {
    const int columns = std::max(fewest_columns, static_cast<int>(std::lround(share * file.columns)));
    if (all.empty() || columns != all.back()) all.push_back(columns);
  }
  return all;
}

}  // namespace

std::pair<CurveStrip, RobustCurve> robust_curve(const Goal& goal, CurveStrip plain,
                                                const optim::MultiStartOptions& search,
                                                const RunOptions& options,
                                                const SearchResultMaker& make_search_result) {
  const CurveFile file = plain.file;
  std::vector<CurveStrip> all = {evaluate_strip(goal, std::move(plain), make_search_result, options)};
  std::size_t best = 0;
  const auto take = [&](CurveStrip next) {
    all.push_back(evaluate_strip(goal, std::move(next), make_search_result, options));
    if (is_more_robust(*file.robust, all.back().candidate, all[best].candidate)) best = all.size() - 1;
  };
  const std::vector<int> columns = columns_of(file);
  const double rounds = static_cast<double>(columns.size()) * robust_thetas;
  optim::MultiStartOptions quiet = search;
  quiet.ended = {};
  quiet.starts = std::min(search.starts, starts);
  for (const int count : columns)
    for (int k = 0; k < robust_thetas && !options.stop.stop_requested(); ++k) {
      options.progress("robust search", static_cast<double>(all.size() - 1) / rounds,
                       fmt::format("design {} of {:.0f}, prints of the best {:.2g} mm off", all.size(),
                                   rounds, all[best].candidate.printed_mm));
      CurveFile next = with(file, count, theta_at(file, k));
      optim::FreeCurveDesign found =
          fit_free_curve(next.curve, curve_variables(next), next.size, quiet, next.shape_tolerance);
      take({std::move(next), std::move(found)});
    }
  if (has_gap(file.hinge)) {
    const CurveStrip strip = all[best];
    for (const double share : strip_gap_shares)
      if (const auto other = with_gaps(strip.file, share); other && !options.stop.stop_requested())
        take({*other, strip.found});
  }
  if (file.hinge.model == HingeSection::Model::elastic)
    best = find_best_compensated(goal, all, make_search_result, options);
  RobustCurve choice{{}, best};
  for (const CurveStrip& one : all) choice.tried.push_back(one.candidate);
  return {std::move(all[best]), std::move(choice)};
}

}  // namespace kinetix::app
