#include "model/lattice/square/family/exact_family.hpp"

#include <limits>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/classification.hpp"

namespace kinetix::model {
namespace {

HingeParameters parameters(const ExactDesign<double>& design, const Wall& wall) {
  const auto [i, j] = wall.from;
  const bool along_x = wall.axis == Axis::x;
  const double tilt = along_x ? design.beta[i] : design.gamma;
  const bool flipped = ((along_x ? j : i) & 1) == 1;
  return {fraction_from_lower(along_x ? design.t[i] : design.s[j], wall.from), pi / 2,
          flipped ? -tilt : tilt};
}

}  // namespace

void apply(const ExactDesign<double>& design, Structure& structure) {
  for (Hinge& hinge : structure.hinges) hinge.parameters = parameters(design, hinge.wall);
}

Structure sheet_of(const ExactDesign<double>& design, const CellSize& size) {
  Structure sheet = make_sheet(design.columns(), design.rows(), size);
  apply(design, sheet);
  return sheet;
}

bool is_whole_sheet(const ExactDesign<double>& design, const Structure& structure) {
  return structure.bodies.size() == static_cast<std::size_t>(design.columns() + 1) * (design.rows() + 1);
}

void check_fold(const ExactDesign<double>& design, double L) {
  const auto is_number = [](double x) { return std::isfinite(x); };
  require("the cell edge", L, L > 0 && is_number(L), "a positive length in mm");
  check_extent(design.columns(), design.rows());
  require("theta", design.theta, std::abs(design.theta) <= pi / 2, "within [-pi/2, pi/2] rad");
  require("gamma", design.gamma, is_number(design.gamma), "a finite angle in rad");
  if (design.t.size() != design.beta.size())
    throw InvalidInput("the design has " + std::to_string(design.t.size()) + " fractions t for " +
                       std::to_string(design.columns()) + " columns, must have one for each");
  for (const auto* numbers : {&design.beta, &design.t, &design.s})
    if (!std::all_of(numbers->begin(), numbers->end(), is_number))
      throw InvalidInput("the design has a tilt or a fraction that is not finite, must have finite numbers");
}

State fold(const ExactDesign<double>& design, const Structure& structure) {
  check_fold(design, structure.size.edge_mm);
  return fold_unchecked(design, structure);
}

State fold_unchecked(const ExactDesign<double>& design, const Structure& structure) {
  State lattice;
  fold_unchecked(design, structure.size.edge_mm, lattice);
  State state;
  state.reserve(structure.bodies.size());
  for (const Vertex& v : structure.bodies) state.push_back(lattice[v.i * (design.rows() + 1) + v.j]);
  return state;
}

namespace {

// Marks a value that no hinge has set yet: no hinge parameter is infinite.
constexpr double unread = std::numeric_limits<double>::infinity();

/// Keeps the first value of a slot and compares the others with it.
bool agrees(double& slot, double value, double tolerance) {
  if (slot == unread) slot = value;
  return std::abs(value - slot) <= tolerance;
}

void settle(std::vector<double>& slots, double fallback) {
  std::replace(slots.begin(), slots.end(), unread, fallback);
}

bool keeps(Family family, const ExactDesign<double>& d, double tolerance) {
  for (int c = 0; c < d.columns(); ++c)
    if (broken_rule(family, Axis::x, d.t[c], d.beta[c], tolerance)) return false;
  for (const double s : d.s)
    if (broken_rule(family, Axis::y, s, d.gamma, tolerance)) return false;
  return true;
}

bool keeps_family(const ExactDesign<double>& d, double tolerance) {
  return keeps(Family::F1, d, tolerance) || keeps(Family::F2, d, tolerance) ||
         keeps(Family::F3, d, tolerance);
}

}  // namespace

SheetReader::SheetReader(const Structure& structure) {
  for (const Cell& cell : structure.cells) {
    columns_ = std::max(columns_, cell.i + 1);
    rows_ = std::max(rows_, cell.j + 1);
  }
}

bool SheetReader::read(const Structure& structure, ExactDesign<double>& design, double tolerance) const {
  design.beta.assign(columns_, unread);
  design.t.assign(columns_, unread);
  design.s.assign(rows_, unread);
  design.gamma = unread;
  for (const Hinge& hinge : structure.hinges) {
    const auto [i, j] = hinge.wall.from;
    const HingeParameters& p = hinge.parameters;
    const bool along_x = hinge.wall.axis == Axis::x, odd = ((along_x ? j : i) & 1) == 1;
    const bool same =
        std::abs(p.alpha - pi / 2) <= tolerance && std::abs(p.offset) <= tolerance &&
        agrees(along_x ? design.beta[i] : design.gamma, odd ? -p.beta : p.beta, tolerance) &&
        agrees(along_x ? design.t[i] : design.s[j], fraction_from_lower(p.t, hinge.wall.from), tolerance);
    if (!same) return false;
  }
  settle(design.beta, 0);
  settle(design.t, 0.5);
  settle(design.s, 0.5);
  if (design.gamma == unread) design.gamma = 0;
  return keeps_family(design, tolerance);
}

}  // namespace kinetix::model
