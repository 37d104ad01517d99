#include "sim/turn_springs.hpp"

namespace kinetix {

TurnSprings::TurnSprings(const Structure& structure, double weight) : structure_(structure) {
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) springs_.push_back({{h, 0}, weight});
}

void TurnSprings::drive_to(int hinge, double angle, double weight) {
  springs_.resize(structure_.hinges.size());
  springs_.push_back({{hinge, angle}, weight});
}

void TurnSprings::relax_at(const std::vector<double>& angles) {
  for (std::size_t h = 0; h < angles.size(); ++h) springs_[h].goal.angle = angles[h];
}

VelocityRow TurnSprings::row(const Spring& spring, const State& turns,
                             const std::vector<Eigen::Vector3d>& speeds, double step) const {
  const Hinge& hinge = structure_.hinges[spring.goal.hinge];
  std::vector<Eigen::Triplet<double>> entries;
  append_drive_gradient(spring.goal, structure_, turns, 0, entries);
  const Eigen::Vector3d gradient(entries[0].value(), entries[1].value(), entries[2].value());
  VelocityRow row{hinge.lower, hinge.upper, Vector6::Zero(), Vector6::Zero(), 0, spring.weight};
  row.first.tail<3>() = -gradient;
  row.second.tail<3>() = gradient;
  row.target = -drive_residual(spring.goal, structure_, turns) / step -
               gradient.dot(speeds[hinge.upper] - speeds[hinge.lower]);
  return row;
}

std::vector<VelocityRow> TurnSprings::rows(const State& turns, const std::vector<Eigen::Vector3d>& speeds,
                                           double step) const {
  std::vector<VelocityRow> rows;
  rows.reserve(springs_.size());
  for (const Spring& spring : springs_) rows.push_back(row(spring, turns, speeds, step));
  return rows;
}

}  // namespace kinetix
