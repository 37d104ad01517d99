#include "model/lattice/lattice_hinge.hpp"

#include "model/lattice/sodalite/sodalite_hinge.hpp"

namespace kinetix::model {

RestHinge rest_hinge(const Lattice& sheet, int hinge) {
  if (const SodaliteStructure* block = sheet.sodalite()) return rest_hinge(*block, hinge);
  if (sheet.assembly()) return Linkage(sheet).hinges[hinge];
  return rest_hinge(sheet.wall(hinge));
}

}  // namespace kinetix::model
