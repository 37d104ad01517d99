#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <vector>

namespace kinetix {

/// Disjoint sets of the numbers 0 to count - 1.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Returns the representative of the set that contains k.
  int find(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  /// Merges the sets of a and b. The lowest number of a set is its representative.
  void unite(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  /// Returns the members of the largest set in ascending order. Ties go to the set with the lowest number.
  std::vector<int> largest() {
    const int count = static_cast<int>(parent_.size());
    std::vector<int> sizes(parent_.size(), 0), out;
    for (int k = 0; k < count; ++k) ++sizes[find(k)];
    const auto most = std::max_element(sizes.begin(), sizes.end());
    for (int k = 0; k < count; ++k)
      if (find(k) == most - sizes.begin()) out.push_back(k);
    return out;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace kinetix

namespace kinetix::model {

/// Moves the elements of `more` to the end of `to`.
template <class T>
void append(std::vector<T> more, std::vector<T>& to) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

}  // namespace kinetix::model

namespace kinetix {

/// Returns the median; of an even number of values the lower of the middle two. @pre at least one value, no
/// NaN
inline double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the larger of two numbers; NaN if either is NaN, so that a running maximum keeps it.
inline double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

}  // namespace kinetix
