#include "sim/joints/cord.hpp"

#include <utility>

#include "model/elastic/cord_element.hpp"
#include "model/linkage/actuators.hpp"

namespace kinetix::sim {

Cord::Cord(const model::Linkage& structure, std::vector<int> through)
    : structure_(structure), through_(std::move(through)), goal_(0) {
  goal_ = cord_length(structure, through_, rest_state(structure)) / structure.size.edge_mm;
}

double Cord::excess(const model::State& state) const {
  return cord_length(structure_, through_, state) / structure_.size.edge_mm - goal_;
}

Eigen::VectorXd Cord::pull(const model::State& state) const {
  const Eigen::VectorXd gradient = cord_gradient(structure_, through_, state);
  Eigen::VectorXd pull(gradient.size());
  for (Eigen::Index k = 0; k < gradient.size(); k += 6)
    pull.segment<6>(k) << -gradient.segment<3>(k + 3), -gradient.segment<3>(k);
  return pull;
}

}  // namespace kinetix::sim
