#include "model/lattice/planar/lattices/registry.hpp"

#include "model/lattice/planar/lattices/brick.hpp"
#include "model/lattice/planar/lattices/honeycomb.hpp"
#include "model/lattice/planar/lattices/octagon.hpp"
#include "model/lattice/planar/lattices/rhombus.hpp"

namespace kinetix::model {
namespace {

std::vector<const PlanarLattice*>& lattices() {
  static std::vector<const PlanarLattice*> all = {
      &honeycomb_lattice,
      &brick_lattice,
      &rhombus_lattice,
      &octagon_lattice,
  };
  return all;
}

}  // namespace

const std::vector<const PlanarLattice*>& planar_lattices() { return lattices(); }

void add_planar_lattice(const PlanarLattice& lattice) { lattices().push_back(&lattice); }

}  // namespace kinetix::model
