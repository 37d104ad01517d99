#include "model/lattice/square/family/exact_family.hpp"

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

State fold(const ExactDesign<double>& design, const Structure& structure) {
  State lattice;
  fold(design, structure.size.edge_mm, lattice);
  State state;
  state.reserve(structure.bodies.size());
  for (const Vertex& v : structure.bodies) state.push_back(lattice[v.i * (design.rows() + 1) + v.j]);
  return state;
}

}  // namespace kinetix::model
