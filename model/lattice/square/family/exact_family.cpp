#include "model/lattice/square/family/exact_family.hpp"

#include <algorithm>
#include <string>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"

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

}  // namespace kinetix::model
