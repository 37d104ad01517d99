#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinetix {

/// The value in the middle; of an even number of values the lower one of the two. @pre at least one value, no NaN
inline double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace kinetix
