#include "model/lattice/square/family/classification.hpp"

#include <utility>

#include "model/base/algorithms.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/lattice/square/family/drive.hpp"

namespace kinetix::model {

const char* broken_rule(Family family, Axis axis, double t, double beta, double tolerance) {
  const bool along_x = axis == Axis::x;
  const bool halved = std::abs(t - 0.5) <= tolerance, upright = std::abs(beta) <= tolerance;
  if (family == Family::F1) return upright ? nullptr : "planar motion (F1) needs beta = 0";
  if (!along_x && !halved) return "a bending sheet needs t = 1/2 on the walls along its rows";
  if (family == Family::F2 && !along_x && !upright)
    return "a cylindrical sheet (F2) needs beta = 0 on the walls along its rows";
  if (along_x && !halved && (family == Family::F3 || !upright)) return "a bending column needs t = 1/2";
  return nullptr;
}

namespace {

Eigen::Vector2d place(Vertex v) { return rest_place(v).head<2>(); }

bool is_cell(const GraphFace& face, const Structure& sheet) {
  if (face.vertices.size() != 4) return false;
  const Vertex first = sheet.bodies[*std::min_element(face.vertices.begin(), face.vertices.end())];
  return std::binary_search(sheet.cells.begin(), sheet.cells.end(), Cell{first.i, first.j});
}

/// Names a face by the bodies at its lower left and upper right corner.
std::string name_of(const GraphFace& face, const Structure& sheet) {
  const auto [first, last] = std::minmax_element(face.vertices.begin(), face.vertices.end());
  return (is_cell(face, sheet) ? "the cell" : "the hole") + std::string(" from ") +
         to_string(sheet.bodies[*first]) + " to " + to_string(sheet.bodies[*last]);
}

}  // namespace

PlanarStructure planar_structure(const Structure& sheet) {
  PlanarStructure out;
  out.size = sheet.size;
  for (const Vertex& v : sheet.bodies) {
    out.graph.vertices.push_back(place(v));
    out.senses.push_back(v.sense());
  }
  for (const Hinge& hinge : sheet.hinges) {
    out.graph.edges.push_back({hinge.lower, hinge.upper});
    out.hinges.push_back(hinge.parameters);
  }
  for (const CellHinges& cell : sheet.cell_members)
    out.faces.push_back({{cell.bodies.begin(), cell.bodies.end()}, {cell.hinges.begin(), cell.hinges.end()}});
  for (GraphFace& face : bounded_faces(out.graph))
    if (!is_cell(face, sheet)) out.faces.push_back(std::move(face));
  return out;
}

PlanarSheet planar_motion(const Structure& sheet) {
  const PlanarStructure planar = planar_structure(sheet);
  ParallelDrawingFit fit = parallel_drawing_of(planar);
  if (fit.is_closed())
    return {std::move(fit.y), -1,
            "planar: all axes vertical, every face closes: each body follows its own path"};
  const GraphFace& face = planar.faces[fit.worst_face];
  return {{},
          face.edges.front(),
          "no exact family: " + name_of(face, sheet) + " does not close: it is off by " +
              number_text(fit.misfit) + " cell edges times the sine of the fold angle"};
}

void place_hinges(const ParallelDrawing& y, Structure& sheet) {
  for (Hinge& hinge : sheet.hinges)
    place_hinge(edge_direction(hinge.wall.axis).head<2>(), y[hinge.upper] - y[hinge.lower],
                hinge.wall.from.sense(), hinge.parameters);
}

State fold(const ParallelDrawing& y, const Structure& sheet, double theta) {
  State state(y.size());
  for (std::size_t b = 0; b < y.size(); ++b) {
    state[b] = parallel_pose(place(sheet.bodies[b]), y[b], sheet.bodies[b].sense(), theta);
    state[b].p *= sheet.size.edge_mm;
  }
  return state;
}

namespace {

/// Returns the median of the finite values, or the fallback if there are none. A single deviating hinge does not
/// change it.
double median(std::vector<double> values, double fallback) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return fallback;
  return lower_median(std::move(values));
}

/// Hinge parameters by column and row, without their alternation over the sheet.
struct Survey {
  std::vector<std::vector<double>> beta, t, s;
  std::vector<double> gamma;

  Survey(int columns, int rows) : beta(columns), t(columns), s(rows) {}

  void add(const Hinge& hinge) {
    const auto [i, j] = hinge.wall.from;
    const HingeParameters& p = hinge.parameters;
    const bool along_x = hinge.wall.axis == Axis::x;
    const double tilt = ((along_x ? j : i) & 1) ? -p.beta : p.beta;
    (along_x ? beta[i] : gamma).push_back(tilt);
    (along_x ? t[i] : s[j]).push_back(fraction_from_lower(p.t, hinge.wall.from));
  }
};

/// Returns the design suggested by most hinges of each column and row.
ExactDesign<double> suggested_design(const Structure& structure) {
  int columns = 0, rows = 0;
  for (const Cell& c : structure.cells) {
    columns = std::max(columns, c.i + 1);
    rows = std::max(rows, c.j + 1);
  }
  Survey survey(columns, rows);
  for (const Hinge& hinge : structure.hinges) survey.add(hinge);
  auto design = ExactDesign<double>::basic(columns, rows);
  for (int c = 0; c < columns; ++c) {
    design.beta[c] = median(survey.beta[c], 0);
    design.t[c] = median(survey.t[c], 0.5);
  }
  for (int r = 0; r < rows; ++r) design.s[r] = median(survey.s[r], 0.5);
  design.gamma = median(survey.gamma, 0);
  return design;
}

/// Rule of a family: gives an empty text for a hinge that satisfies it, otherwise the broken rule.
class Rule {
 public:
  Rule(Family family, const ExactDesign<double>& design, double tolerance)
      : family_(family), design_(design), tolerance_(tolerance) {}

  std::string broken_by(const Hinge& hinge, const HingeParameters& asked) const {
    const HingeParameters& p = hinge.parameters;
    const bool along_x = hinge.wall.axis == Axis::x;
    if (!same(p.alpha, pi / 2)) return "exact motion needs alpha = 90 deg";
    if (!same(p.offset, 0)) return off_the_wall;
    if (const char* rule = broken_rule(family_, hinge.wall.axis, p.t, p.beta, tolerance_)) return rule;
    if (!same(p.beta, asked.beta))
      return along_x ? "all tilts of a column must be equal, with the sign alternating from row to row"
                     : "all rows must share one tilt, with the sign alternating from column to column";
    if (!same(p.t, asked.t))
      return "all hinges of a column (or row) of walls must give the same fraction to their vertex of "
             "sublattice A";
    return {};
  }

 private:
  bool same(double a, double b) const { return std::abs(a - b) <= tolerance_; }

  Family family_;
  const ExactDesign<double>& design_;
  double tolerance_;
};

std::string description(Family family, bool transposed) {
  const std::string along = transposed ? " (folding along y)" : "";
  switch (family) {
    case Family::F1:
      return "F1: all axes vertical, hinge fractions by column and row: planar";
    case Family::F2:
      return "F2: basic rows, every column bends or shears: cylindrical sheet" + along;
    case Family::F3:
      return "F3: rows with equal tilts, every column bends" + along;
    case Family::F4:
      return "F4: flat panels joined by creases along x and along y: net";
    case Family::planar:
    case Family::none:
      break;
  }
  return "no exact family";
}

Vertex swapped(Vertex v) { return {v.j, v.i}; }

Wall swapped(const Wall& wall) { return {swapped(wall.from), wall.axis == Axis::x ? Axis::y : Axis::x}; }

/// Agreement of the hinges with one family's rule.
struct Attempt {
  Family family = Family::none;
  bool transposed = false;
  std::size_t broken = 0;  ///< number of hinges that break it
  int first_broken = -1;   ///< index in the structure before transposition
  std::string rule;        ///< rule broken by this hinge
};

/// Tests a family. @param sheet the structure, or its mirror image if `transposed`
Attempt attempt(Family family, const Structure& structure, const Structure& sheet, bool transposed,
                const ExactDesign<double>& design, double tolerance) {
  Structure asked = sheet;
  apply(design, asked);
  const Rule rule(family, design, tolerance);
  Attempt result{family, transposed, 0, -1, {}};
  for (std::size_t k = 0; k < sheet.hinges.size(); ++k) {
    std::string broken = rule.broken_by(sheet.hinges[k], asked.hinges[k].parameters);
    if (broken.empty()) continue;
    const Wall& wall = sheet.hinges[k].wall;
    const int index = *structure.hinge_at(transposed ? swapped(wall) : wall);
    ++result.broken;
    if (result.first_broken >= 0 && index > result.first_broken) continue;
    result.first_broken = index;
    result.rule = std::move(broken);
  }
  return result;
}

/// Returns the mirror image with x and y exchanged. Tilt and offset change their signs; fraction and in-plane angle
/// do not.
Structure transposed(const Structure& s) {
  std::vector<Cell> cells;
  for (const Cell& c : s.cells) cells.push_back({c.j, c.i});
  Structure out = make_structure(std::move(cells), s.size);
  for (const Hinge& h : s.hinges) {
    HingeParameters& p = out.hinges[*out.hinge_at(swapped(h.wall))].parameters;
    p = h.parameters;
    p.beta = -p.beta;
    p.offset = -p.offset;
  }
  return out;
}

bool has_offsets(const Structure& s) {
  return std::any_of(s.hinges.begin(), s.hinges.end(),
                     [](const Hinge& hinge) { return hinge.parameters.offset != 0; });
}

Pose swapped(const Pose& pose) {
  const Eigen::Matrix3d swap =
      Eigen::PermutationMatrix<3>(Eigen::Vector3i(1, 0, 2)).toDenseMatrix().cast<double>();
  return {swap * pose.R * swap, swap * pose.p};
}

}  // namespace

std::string to_string(Family family) {
  switch (family) {
    case Family::F1:
      return "F1";
    case Family::F2:
      return "F2";
    case Family::F3:
      return "F3";
    case Family::F4:
      return "F4";
    case Family::planar:
      return "planar";
    case Family::none:
      break;
  }
  return "none";
}

Classification classify(const Structure& structure, double tolerance) {
  Attempt best;
  for (const bool along_y : {false, true}) {
    const Structure sheet = along_y ? transposed(structure) : structure;
    const auto design = suggested_design(sheet);
    for (const Family family : {Family::F1, Family::F2, Family::F3}) {
      Attempt a = attempt(family, structure, sheet, along_y, design, tolerance);
      if (a.broken == 0) return {family, along_y, design, {}, {}, -1, description(family, along_y)};
      if (best.family == Family::none || a.broken < best.broken) best = std::move(a);
    }
  }
  NetCheck net = check_net(structure, tolerance);
  if (net.broken == 0)
    return {Family::F4, false, {}, make_net_tree(structure), {}, -1, description(Family::F4, false)};
  if (all_vertical(structure)) {
    PlanarSheet sheet = planar_motion(structure);
    if (!sheet.y.empty()) return {Family::planar, false, {}, {}, std::move(sheet.y), -1, sheet.why};
    if (has_offsets(structure)) return {Family::none, false, {}, {}, {}, sheet.hinge, sheet.why};
  }
  if (net.broken < best.broken)
    best = {Family::F4, false, net.broken, net.breaking_hinge, std::move(net.rule)};
  const std::string where = "wall " + to_string(structure.hinges[best.first_broken].wall);
  return {Family::none,
          false,
          {},
          {},
          {},
          best.first_broken,
          "no exact family: hinge " + std::to_string(best.first_broken) + " on " + where + ": " + best.rule};
}

State fold(const Classification& classification, const Structure& structure, double theta) {
  if (classification.family == Family::F4) return fold_net(classification.tree, structure, theta);
  if (classification.family == Family::planar) return fold(classification.parallel_drawing, structure, theta);
  auto design = classification.design;
  design.theta = classification.transposed ? -theta : theta;
  if (!classification.transposed) return fold_unchecked(design, structure);
  State lattice;
  fold_unchecked(design, structure.size.edge_mm, lattice);
  State state;
  for (const Vertex& v : structure.bodies) state.push_back(swapped(lattice[v.j * (design.rows() + 1) + v.i]));
  return state;
}

ExactMotion exact_motion(const Structure& structure, const Classification& kind) {
  ExactMotion motion{{}, to_string(kind.family), kind.why};
  if (kind.family == Family::none) return motion;
  const auto sheet = std::make_shared<const Structure>(structure);
  const auto of = std::make_shared<const Classification>(kind);
  motion.at = [=](double theta) { return fold(*of, *sheet, theta); };
  motion.theta_of = [=](const LinkageDrive& drive) { return theta_of(drive, *of, *sheet); };
  return motion;
}

ExactMotion exact_motion(const Structure& structure) { return exact_motion(structure, classify(structure)); }

namespace {

/// Rejects plates normal to the direction in which a sheet bends: it can roll between them, so its theta is not
/// determined.
void reject_tilted_plates(const LinkageDrive& drive, const Classification& kind) {
  const Axis bends_along = kind.transposed ? Axis::y : Axis::x;
  if (kind.family == Family::F1 || drive.axis != bends_along) return;
  const std::string along = to_string(bends_along);
  throw InvalidInput("this sheet bends along " + along + " and would roll between plates normal to " + along +
                         "; allowed: " + to_string(kind.transposed ? Axis::x : Axis::y) + ", or kind: hinge",
                     {"", 0, 0, "drive.axis"});
}

}  // namespace

double theta_of(const LinkageDrive& drive, const Classification& kind, const Structure& structure) {
  if (drive.has_plates()) {
    if (kind.family == Family::planar) {
      reject_curved_rows(drive, kind.parallel_drawing);
    } else if (drive.grips_part || kind.family == Family::F4) {
      require_kept_rows(structure, kind, drive.axis, drive.gripped,
                        drive.grips_part ? "that part of the structure" : "this net");
      return drive.theta();
    } else {
      reject_tilted_plates(drive, kind);
    }
  }
  return theta_of(drive, structure, [&](double theta) { return fold(kind, structure, theta); });
}

}  // namespace kinetix::model
