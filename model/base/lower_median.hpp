#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinetix {

/// Returns the median; of an even number of values the lower of the middle two. @pre at least one value, no
/// NaN
inline double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace kinetix
