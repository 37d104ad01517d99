#include "model/contact/near_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace kinetix::model {
namespace {

/// Returns the axes by extent of the points, longest first.
std::array<int, 3> axes_by_extent(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d extent = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] > extent[b]; });
  return axes;
}

}  // namespace

bool NearPairs::Entry::operator<(const Entry& other) const {
  return std::tie(stripe, along, index) < std::tie(other.stripe, other.along, other.index);
}

const std::vector<std::pair<int, int>>& NearPairs::find(const Eigen::Matrix3Xd& points, double distance) {
  pairs_.clear();
  entries_.clear();
  if (points.cols() == 0) return pairs_;
  const auto axes = axes_by_extent(points);
  for (int k = 0; k < points.cols(); ++k)
    entries_.push_back({std::floor(points(axes[0], k) / distance), points(axes[1], k), k});
  std::sort(entries_.begin(), entries_.end());
  std::size_t partner = 0;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    std::size_t next = k + 1;
    pair_up(k, next, entries_[k].stripe, points, distance);
    pair_up(k, partner, entries_[k].stripe + 1, points, distance);
  }
  return pairs_;
}

/// Pairs an entry with the entries of a stripe within the distance; `partner` advances to the first of these.
void NearPairs::pair_up(std::size_t first, std::size_t& partner, double stripe,
                        const Eigen::Matrix3Xd& points, double distance) {
  const Entry& entry = entries_[first];
  const auto before = [&](const Entry& e) {
    return e.stripe < stripe || (e.stripe == stripe && e.along < entry.along - distance);
  };
  while (partner < entries_.size() && before(entries_[partner])) ++partner;
  for (std::size_t k = partner; k < entries_.size(); ++k) {
    const Entry& other = entries_[k];
    if (other.stripe != stripe || other.along > entry.along + distance) break;
    if ((points.col(entry.index) - points.col(other.index)).squaredNorm() < distance * distance)
      pairs_.push_back(std::minmax(entry.index, other.index));
  }
}

}  // namespace kinetix::model
