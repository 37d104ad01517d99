#include "model/elastic/dof_map.hpp"

namespace kinetix::model {
namespace {

using Held = std::vector<std::array<bool, 6>>;

DofMap numbered(const Held& held) {
  DofMap dofs;
  dofs.unknown.resize(held.size());
  for (std::size_t b = 0; b < held.size(); ++b)
    for (int c = 0; c < 6; ++c) dofs.unknown[b][c] = held[b][c] ? -1 : dofs.count++;
  return dofs;
}

}  // namespace

Eigen::VectorXd DofMap::restrict(const Eigen::VectorXd& all) const {
  Eigen::VectorXd out(count);
  for (std::size_t b = 0; b < unknown.size(); ++b)
    for (int c = 0; c < 6; ++c)
      if (unknown[b][c] >= 0) out[unknown[b][c]] = all[6 * b + c];
  return out;
}

Eigen::VectorXd DofMap::extend(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(coordinates());
  for (std::size_t b = 0; b < unknown.size(); ++b)
    for (int c = 0; c < 6; ++c)
      if (unknown[b][c] >= 0) out[6 * b + c] = unknowns[unknown[b][c]];
  return out;
}

DofMap make_dof_map(const Linkage& structure, const LinkageDrive& drive, bool planar) {
  Held held(structure.bodies.size(), {planar, planar, false, false, false, planar});
  for (const auto& [body, coordinate] : drive.held_coordinates(structure)) held[body][coordinate] = true;
  return numbered(held);
}

}  // namespace kinetix::model
