#include "model/lattice/square/family/sheet_reader.hpp"

#include <algorithm>
#include <limits>

#include "model/lattice/square/family/family_rules.hpp"

namespace kinetix::model {
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
