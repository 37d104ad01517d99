#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace kinetix::model {

/// Pairs of points closer than a distance. The points are divided into stripes of that width along the longest side
/// of their bounding box, and sorted along the second longest. The cost is O(n log n) if few points share a stretch
/// of a stripe. Buffers are reused between calls.
class NearPairs {
 public:
  /// @param points all finite   @param distance > 0, in the unit of the points
  /// @return (lower index, higher index), each pair once, in an order that depends only on the points
  const std::vector<std::pair<int, int>>& find(const Eigen::Matrix3Xd& points, double distance);

 private:
  struct Entry {
    double stripe;
    double along;
    int index;
    bool operator<(const Entry& other) const;
  };

  void pair_up(std::size_t first, std::size_t& partner, double stripe, const Eigen::Matrix3Xd& points,
               double distance);

  std::vector<Entry> entries_;
  std::vector<std::pair<int, int>> pairs_;
};

}  // namespace kinetix::model
