#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

namespace kinetix::model {

/// Adds the elements of one list to the end of another.
template <class T>
void append(std::vector<T> more, std::vector<T>& to) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

}  // namespace kinetix::model
