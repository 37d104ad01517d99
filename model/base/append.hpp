#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

namespace kinetix::model {

/// Moves the elements of `more` to the end of `to`.
template <class T>
void append(std::vector<T> more, std::vector<T>& to) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

}  // namespace kinetix::model
