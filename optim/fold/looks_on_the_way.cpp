#include "optim/fold/looks_on_the_way.hpp"

#include <algorithm>
#include <utility>

#include "model/base/parallel_runs.hpp"

namespace kinetix::optim {

LooksOnTheWay::LooksOnTheWay(const model::Linkage& structure, std::function<model::State(double)> state,
                             int threads)
    : state_(std::move(state)), contacts_(threads, model::WallContact(structure)) {}

std::optional<LooksOnTheWay::Overlap> LooksOnTheWay::first_overlap(const std::vector<double>& thetas) {
  const auto count = static_cast<int>(thetas.size()), most = static_cast<int>(contacts_.size());
  // One alone first: where walls are in the way, they mostly are there.
  for (int first = 0, now = 1; first < count; first += now, now = std::min(most, count - first)) {
    std::vector<std::optional<model::WallPair>> found(now);
    model::run_in_parallel(now, now, [&](int k) {
      const auto& pairs = contacts_[k].overlapping(state_(thetas[first + k]));
      if (!pairs.empty()) found[k] = pairs.front();
    });
    for (int k = 0; k < now; ++k)
      if (found[k]) return Overlap{first + k, *found[k]};
  }
  return std::nullopt;
}

}  // namespace kinetix::optim
