#include "model/closure/gruebler.hpp"

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

int gruebler(int per_body, int bodies, int joints, int dofs) {
  if (bodies < 1 || joints < 0 || dofs < 0)
    throw InvalidInput(
        "a linkage has at least one body and no negative number of joints or degrees of freedom");
  return per_body * (bodies - 1 - joints) + dofs;
}

}  // namespace

int gruebler_planar(int bodies, int joints, int dofs) { return gruebler(3, bodies, joints, dofs); }

int gruebler_spatial(int bodies, int joints, int dofs) { return gruebler(6, bodies, joints, dofs); }

}  // namespace kinetix::model
