#include "optim/ribs/ribs_problem.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "model/base/rotation_vector.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Cell edges: an rms distance of this size gives |r| = 1. With a larger unit, tilts would have more weight.
constexpr double unit_in_edges = 0.1;
// Relative to distances: heights of the rim must not pull the spine off the surface.
constexpr double weight_of_ends = 0.1;
constexpr double weight_of_tilts = 1e-3;  // per rad: it only decides tilts that affect no distance
constexpr int theta_index = 6;            // in x: after turn (3) and place (3)

}  // namespace

RibsProblem::RibsProblem(const model::Fishbone& fishbone, const RibsGoal& goal, double tilt,
                         const AngleRange& theta)
    : fishbone_(fishbone), goal_(goal), tree_(make_net_tree(fishbone.structure, fishbone.middle)) {
  index_variables();
  place_probes();
  find_ways();
  const double infinity = std::numeric_limits<double>::infinity();
  int variables = shared();
  for (const int size : parts_) variables += size;
  lower_ = VectorXd::Constant(variables, -tilt);
  upper_ = VectorXd::Constant(variables, tilt);
  lower_.head<theta_index>().setConstant(-infinity);
  upper_.head<theta_index>().setConstant(infinity);
  lower_[theta_index] = theta.lower;
  upper_[theta_index] = theta.upper;
}

void RibsProblem::index_variables() {
  variable_of_hinge_.assign(fishbone_.structure.hinges.size(), -1);
  int at = fixed_shared;
  const auto add = [&](const model::Crease& crease) {
    for (const int h : crease.hinges) variable_of_hinge_[h] = at;
    ++at;
  };
  for (const model::Crease& crease : fishbone_.spine) add(crease);
  for (const auto& sides : fishbone_.ribs)
    for (const auto& side : sides) {
      first_.push_back(at);
      parts_.push_back(static_cast<int>(side.size()));
      for (const model::Crease& crease : side) add(crease);
    }
}

int RibsProblem::part_of(int body) const {
  const model::FishbonePlace place = place_of(fishbone_, body);
  return place.rib < 0 ? static_cast<int>(parts_.size()) : 2 * place.rib + place.side;
}

void RibsProblem::place_probes() {
  const model::Structure& s = fishbone_.structure;
  probes_.resize(parts_.size() + 1);
  const auto add = [&](const Probe& probe) { probes_[part_of(probe.body)].push_back(probe); };
  for (std::size_t b = 0; b < s.bodies.size(); ++b) add({static_cast<int>(b), Vector3d::Zero()});
  for (const model::Hinge& hinge : s.hinges)
    add({hinge.lower, hinge.parameters.t * s.size.edge_mm * edge_direction(hinge.wall.axis)});
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    const bool is_part = k < parts_.size();
    const int tilts = is_part ? parts_[k] : static_cast<int>(fishbone_.spine.size());
    residuals_.push_back(static_cast<int>(probes_[k].size()) + tilts + (is_part ? 0 : 4));
    count_ += static_cast<int>(probes_[k].size());
  }
  ends_ = spine_ends(fishbone_);
}

void RibsProblem::find_ways() {
  ways_.resize(fishbone_.structure.bodies.size());
  for (std::size_t k = 0; k < tree_.links.size(); ++k) {
    const model::NetTree::Link& link = tree_.links[k];
    ways_[link.body] = ways_[link.parent];
    const int variable = variable_of_hinge_[link.hinge];
    if (variable >= 0)
      ways_[link.body].push_back(
          {static_cast<int>(k), variable, alternation(fishbone_.structure.hinges[link.hinge].wall)});
  }
}

model::Structure RibsProblem::structure(const VectorXd& x) const {
  model::Structure out = fishbone_.structure;
  for (std::size_t h = 0; h < out.hinges.size(); ++h)
    if (variable_of_hinge_[h] >= 0)
      out.hinges[h].parameters.beta = alternation(out.hinges[h].wall) * x[variable_of_hinge_[h]];
  return out;
}

model::State placed(model::State state, int root, const Vector3d& turn, const Vector3d& place) {
  const Eigen::Matrix3d R = rotation_of(turn);
  const Vector3d from = state[root].p;
  for (model::Pose& pose : state) pose = {R * pose.R, place + R * (pose.p - from)};
  return state;
}

model::State RibsProblem::state(const VectorXd& x) const {
  return placed(fold_net(tree_, structure(x), x[theta_index]), tree_.root, x.head<3>(),
                fishbone_.structure.size.edge_mm * x.segment<3>(3));
}

VectorXd RibsProblem::pack(const RibsShape& shape) const {
  VectorXd x(lower_.size());
  x << shape.turn, shape.place / fishbone_.structure.size.edge_mm, VectorXd::Zero(x.size() - 6);
  x[theta_index] = shape.theta;
  int at = fixed_shared;
  for (const double tilt : shape.spine) x[at++] = tilt;
  for (const auto& sides : shape.ribs)
    for (const auto& side : sides)
      for (const double tilt : side) x[at++] = tilt;
  return x.cwiseMax(lower_).cwiseMin(upper_);
}

RibsShape RibsProblem::unpack(const VectorXd& x) const {
  RibsShape shape{x.head<3>(), fishbone_.structure.size.edge_mm * x.segment<3>(3), x[theta_index], {}, {}};
  int at = fixed_shared;
  for (std::size_t k = 0; k < fishbone_.spine.size(); ++k) shape.spine.push_back(x[at++]);
  for (const auto& sides : fishbone_.ribs) {
    auto& rib = shape.ribs.emplace_back();
    for (int side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < sides[side].size(); ++k) rib[side].push_back(x[at++]);
  }
  return shape;
}

bool RibsProblem::evaluate(const VectorXd& x, bool with_derivatives,
                           std::vector<ResidualBlock>& blocks) const {
  model::NetMotion motion;
  const model::Structure folded = structure(x);
  if (with_derivatives)
    motion = fold_net_with_jacobian(tree_, folded, x[theta_index]);
  else
    motion.state = fold_net(tree_, folded, x[theta_index]);
  if (!is_finite(motion.state)) return false;
  blocks.resize(probes_.size());
  for (std::size_t k = 0; k < probes_.size(); ++k)
    fill(motion, x, with_derivatives, static_cast<int>(k), blocks[k]);
  return true;
}

void RibsProblem::fill(const model::NetMotion& motion, const VectorXd& x, bool with_derivatives, int part,
                       ResidualBlock& block) const {
  const bool is_part = part < static_cast<int>(parts_.size());
  const int own = is_part ? parts_[part] : 0, rows = residuals_[part];
  block.r.setZero(rows);
  block.by_shared.setZero(with_derivatives ? rows : 0, shared());
  block.by_local.setZero(with_derivatives ? rows : 0, own);
  int row = 0;
  for (const Probe& probe : probes_[part]) fill_probe(motion, x, with_derivatives, part, probe, row++, block);
  const int first = is_part ? first_[part] : fixed_shared;
  const int tilts = is_part ? own : static_cast<int>(fishbone_.spine.size());
  for (int k = 0; k < tilts; ++k, ++row) {
    block.r[row] = weight_of_tilts * x[first + k];
    if (with_derivatives)
      (is_part ? block.by_local(row, k) : block.by_shared(row, fixed_shared + k)) = weight_of_tilts;
  }
  if (!is_part) fill_ends(motion, x, with_derivatives, row, block);
}

Vector3d RibsProblem::in_place(const model::NetMotion& motion, const VectorXd& x, const Probe& probe) const {
  const model::Pose& pose = motion.state[probe.body];
  return fishbone_.structure.size.edge_mm * x.segment<3>(3) +
         rotation_of(x.head<3>()) * (pose.p + pose.R * probe.arm - motion.state[tree_.root].p);
}

/// Returns the derivative of direction . (place of the probe): shared variables, then those of its part.
VectorXd RibsProblem::derivatives_of(const model::NetMotion& motion, const VectorXd& x, const Probe& probe,
                                     const Vector3d& direction, int part) const {
  const bool is_part = part < static_cast<int>(parts_.size());
  VectorXd derivatives = VectorXd::Zero(shared() + (is_part ? parts_[part] : 0));
  const model::Pose& pose = motion.state[probe.body];
  const Vector3d carried = pose.R * probe.arm, p = pose.p + carried;
  const Eigen::Matrix3d turn = rotation_of(x.head<3>());
  const Vector3d arm = turn * (p - motion.state[tree_.root].p), local = turn.transpose() * direction;
  derivatives.head<3>() = rotation_rate(x.head<3>()).transpose() * arm.cross(direction);
  derivatives.segment<3>(3) = fishbone_.structure.size.edge_mm * direction;
  const model::Twist& twist = motion.by_theta[probe.body];
  derivatives[theta_index] = local.dot(twist.v + twist.omega.cross(carried) - motion.by_theta[tree_.root].v);
  for (const Step& step : ways_[probe.body]) {
    const model::NetTurn& about = motion.by_tilt[step.link];
    const int at = step.variable < shared() ? step.variable : shared() + step.variable - first_[part];
    derivatives[at] += step.sign * local.dot(about.omega.cross(p - about.point));
  }
  return derivatives;
}

void RibsProblem::fill_probe(const model::NetMotion& motion, const VectorXd& x, bool with_derivatives,
                             int part, const Probe& probe, int row, ResidualBlock& block) const {
  const double scale = 1 / (unit_in_edges * fishbone_.structure.size.edge_mm * std::sqrt(count_));
  const targets::ClosestMeshPoint closest = goal_.surface->closest(in_place(motion, x, probe));
  block.r[row] = scale * (closest.distance - goal_.clearance_mm);
  if (!with_derivatives) return;
  const VectorXd by = scale * derivatives_of(motion, x, probe, closest.normal, part);
  block.by_shared.row(row) = by.head(shared());
  if (const auto own = by.size() - shared(); own > 0) block.by_local.row(row) = by.tail(own);
}

void RibsProblem::fill_ends(const model::NetMotion& motion, const VectorXd& x, bool with_derivatives, int row,
                            ResidualBlock& block) const {
  const double scale = weight_of_ends / (unit_in_edges * fishbone_.structure.size.edge_mm);
  const int part = static_cast<int>(parts_.size());
  for (const auto& end : ends_)
    for (const auto& [direction, wanted] : {std::pair{Vector3d(Vector3d::UnitZ()), goal_.rim_z},
                                            {Vector3d(Vector3d::UnitX()), goal_.middle_x}}) {
      block.r[row] = -scale * wanted;
      for (const int body : end) {
        const Probe probe{body, Vector3d::Zero()};
        block.r[row] += scale / 2 * direction.dot(in_place(motion, x, probe));
        if (with_derivatives)
          block.by_shared.row(row) += scale / 2 * derivatives_of(motion, x, probe, direction, part);
      }
      ++row;
    }
}

}  // namespace kinetix::optim
