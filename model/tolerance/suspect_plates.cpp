#include "model/tolerance/suspect_plates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Multiple of the rms scatter over all directions. Of plates further apart, about one in 1000 prints touches.
// This includes the case that the sample prints show a fifth too little scatter.
constexpr double suspect_deviations = 4;
constexpr double overlap_in_edges = 1e-9;  // cell edges, as in WallContact

/// Returns the rms shift of the rim of a plate because of the errors of its hinge, mm.
double plate_scatter(const CellSize& size, const Eigen::Vector4d& sd) {
  const double length = size.edge_mm, half_height = size.height_mm / 2;
  return sd.cwiseProduct(Eigen::Vector4d(length, half_height, half_height, length)).norm();
}

/// Calls `look` with the boxes of those pairs that are closer than `within` of the pair, until it returns
/// true.
/// @return whether it did
template <class Within, class Look>
bool any_pair(const State& print, const std::vector<HalfWall>& walls,
              const std::vector<SuspectPair>& suspects, const Within& within, const Look& look) {
  return std::any_of(suspects.begin(), suspects.end(), [&](const SuspectPair& pair) {
    const HalfWall &first = walls[pair.walls.first], &second = walls[pair.walls.second];
    const Pose &a = print[first.body], &b = print[second.body];
    const Vector3d apart = b.p + b.R * second.box.center - a.p - a.R * first.box.center;
    const double near = within(pair);
    if (apart.norm() > radius(first.box) + radius(second.box) + near) return false;
    return look(pair, placed(first, a), placed(second, b));
  });
}

}  // namespace

double SuspectPlates::Scatter::near(const Vector3d& place) const {
  return suspect_deviations * (shift + turn * (place - at).norm());
}

SuspectPlates::SuspectPlates(const Linkage& linkage, const std::vector<Eigen::VectorXd>& changes,
                             const HingeScatter& scatter)
    : depth_mm_(overlap_in_edges * linkage.size.edge_mm),
      walls_(half_walls(linkage)),
      at_rest_(linkage),
      plates_of_(linkage.bodies.size()),
      reach_(linkage.bodies.size()) {
  const Eigen::Matrix4Xd spread = scatter.by_hinge(static_cast<Eigen::Index>(linkage.hinges.size()));
  for (int k = 0; k < static_cast<int>(walls_.size()); ++k) {
    plates_of_[walls_[k].body].push_back(k);
    plate_scatter_.push_back(suspect_deviations * plate_scatter(linkage.size, spread.col(walls_[k].hinge)));
    largest_plate_scatter_ = std::max(largest_plate_scatter_, plate_scatter_.back());
    double& reach = reach_[walls_[k].body];
    reach = std::max(reach, walls_[k].box.center.norm() + radius(walls_[k].box));
  }
  for (int b = 0; b < static_cast<int>(linkage.bodies.size()); ++b) {
    motions_.emplace_back();
    for (const Eigen::VectorXd& change : changes) {
      const Motion motion{change.segment<3>(6 * b), linkage.size.edge_mm * change.segment<3>(6 * b + 3)};
      motions_.back().push_back(motion);
      moved_ = std::max(moved_, motion.shift.norm());
    }
  }
}

std::vector<SuspectPair> SuspectPlates::find(const State& state) {
  Eigen::Matrix3Xd places(3, state.size());
  for (std::size_t b = 0; b < state.size(); ++b) places.col(b) = state[b].p;
  boxes_.clear();
  for (const HalfWall& wall : walls_) boxes_.push_back(placed(wall, state[wall.body]));
  const double farthest = *std::max_element(reach_.begin(), reach_.end());
  std::vector<SuspectPair> found;
  for (const auto& [a, b] :
       near_.find(places, 2 * (farthest + suspect_deviations * moved_ + largest_plate_scatter_)))
    add(state, a, b, found);
  return found;
}

bool SuspectPlates::are_nearer(const State& print, const std::vector<HalfWall>& walls,
                               const std::vector<SuspectPair>& suspects, double share) const {
  return any_pair(
      print, walls, suspects, [&](const SuspectPair& pair) { return std::max(share * pair.near_mm, 0.0); },
      [&](const SuspectPair& pair, const OrientedBox& a, const OrientedBox& b) {
        return overlap(a, b, -share * pair.near_mm);
      });
}

bool SuspectPlates::touch(const State& print, const std::vector<HalfWall>& walls,
                          const std::vector<SuspectPair>& suspects) const {
  return any_pair(
      print, walls, suspects, [](const SuspectPair&) { return 0.0; },
      [&](const SuspectPair&, const OrientedBox& a, const OrientedBox& b) {
        return overlap(a, b, depth_mm_);
      });
}

SuspectPlates::Scatter SuspectPlates::scatter(const State& state, int a, int b) const {
  Scatter out{(state[a].p + state[b].p) / 2};
  const Vector3d from_a = out.at - state[a].p, from_b = out.at - state[b].p;
  for (std::size_t k = 0; k < motions_[a].size(); ++k) {
    const Motion &of_a = motions_[a][k], &of_b = motions_[b][k];
    out.shift += (of_a.at(from_a) - of_b.at(from_b)).squaredNorm();
    out.turn += (of_a.turn - of_b.turn).squaredNorm();
  }
  const auto count = static_cast<double>(motions_[a].size());
  out.shift = std::sqrt(out.shift / count);
  out.turn = std::sqrt(out.turn / count);
  return out;
}

void SuspectPlates::add(const State& state, int a, int b, std::vector<SuspectPair>& found) const {
  const Scatter apart = scatter(state, a, b);
  const double reach = reach_[a] + reach_[b];
  const double near = suspect_deviations * (apart.shift + apart.turn * reach) + 2 * largest_plate_scatter_;
  if ((state[a].p - state[b].p).norm() > reach + near) return;
  for (const int p : plates_of_[a])
    for (const int q : plates_of_[b]) add_walls({std::min(p, q), std::max(p, q)}, apart, found);
}

void SuspectPlates::add_walls(const WallPair& pair, const Scatter& apart,
                              std::vector<SuspectPair>& found) const {
  if (walls_[pair.first].hinge == walls_[pair.second].hinge) return;
  const OrientedBox &first = boxes_[pair.first], &second = boxes_[pair.second];
  const double near = apart.near((first.center + second.center) / 2) + plate_scatter_[pair.first] +
                      plate_scatter_[pair.second];
  if ((first.center - second.center).norm() > radius(first) + radius(second) + near) return;
  const auto& left_out = at_rest_.touching_at_rest();
  if (std::binary_search(left_out.begin(), left_out.end(), pair)) return;
  if (const double gap = separation(first, second); gap <= near)
    found.push_back({pair, near, near > 0 ? gap / near : 0});
}

}  // namespace kinetix::model
