#include "model/elastic/contact/relative_motion.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double flat = 1e-9;  // fraction of the trace: a flat sheet has no spread across it
// Cell edges: smaller tiles have too few bodies to be worth their comparison.
constexpr double min_tile = 4;
constexpr double tiles_along = 16;  // limit along the longest side: all pairs of tiles are compared

/// Returns the displacement gradient that fits the shifts between two states best, by least squares.
Matrix3d homogeneous_strain(const State& from, const State& to) {
  Vector3d middle = Vector3d::Zero(), shift = Vector3d::Zero();
  for (std::size_t b = 0; b < from.size(); ++b) {
    middle += from[b].p;
    shift += to[b].p - from[b].p;
  }
  middle /= static_cast<double>(from.size());
  shift /= static_cast<double>(from.size());
  Matrix3d spread = Matrix3d::Zero(), mixed = Matrix3d::Zero();
  for (std::size_t b = 0; b < from.size(); ++b) {
    const Vector3d at = from[b].p - middle;
    spread += at * at.transpose();
    mixed += (to[b].p - from[b].p - shift) * at.transpose();
  }
  spread.diagonal().array() += flat * spread.trace();
  return mixed * spread.inverse();
}

}  // namespace

void RelativeMotion::remember(const State& state) {
  state_ = state;
  tiles_.clear();
  Eigen::AlignedBox3d all;
  for (const Pose& pose : state) all.extend(pose.p / edge_mm_);
  const double side = std::max(min_tile, all.sizes().maxCoeff() / tiles_along);
  std::map<std::array<int, 3>, std::size_t> tile_at;
  for (int b = 0; b < static_cast<int>(state.size()); ++b) {
    const Vector3d place = state[b].p / edge_mm_;
    const Eigen::Array3i at = ((place - all.min()) / side).array().floor().cast<int>();
    const auto [tile, is_new] = tile_at.try_emplace({at[0], at[1], at[2]}, tiles_.size());
    if (is_new) tiles_.emplace_back();
    tiles_[tile->second].box.extend(place);
    tiles_[tile->second].bodies.push_back(b);
  }
}

std::vector<RelativeMotion::Motion> RelativeMotion::motions(const State& state,
                                                            const Matrix3d& strain) const {
  const auto own = [&](int b) -> Vector3d {
    return (state[b].p - state_[b].p - strain * state_[b].p) / edge_mm_;
  };
  std::vector<Motion> out(tiles_.size());
  for (std::size_t k = 0; k < tiles_.size(); ++k) {
    for (const int b : tiles_[k].bodies) out[k].shift += own(b);
    out[k].shift /= static_cast<double>(tiles_[k].bodies.size());
    for (const int b : tiles_[k].bodies) {
      const double turn = (state[b].R - state_[b].R).norm() / std::sqrt(2.0);
      out[k].spread = std::max(out[k].spread, (own(b) - out[k].shift).norm() + reach_ * turn);
    }
  }
  return out;
}

bool RelativeMotion::keeps_apart(const State& state, double margin) const {
  if (state_.size() != state.size() || !is_finite(state)) return false;
  const Matrix3d strain = homogeneous_strain(state_, state);
  const std::vector<Motion> all = motions(state, strain);
  for (std::size_t i = 0; i < tiles_.size(); ++i)
    for (std::size_t k = 0; k <= i; ++k) {
      const double gap = std::sqrt(tiles_[i].box.squaredExteriorDistance(tiles_[k].box));
      const double apart = std::max(gap, 2 * reach_ + margin);
      const double closer = (all[i].shift - all[k].shift).norm() + all[i].spread + all[k].spread;
      if (!(closer + strain.norm() * apart <= apart - 2 * reach_)) return false;
    }
  return true;
}

}  // namespace kinetix::model
