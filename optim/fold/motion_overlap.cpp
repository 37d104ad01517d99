#include "optim/fold/folded_net.hpp"

#include <cmath>

#include "model/base/parallel_runs.hpp"

namespace kinetix::optim {

namespace {

model::Linkage thickened(model::Linkage structure, double clearance) {
  structure.size.thickness_mm += clearance * structure.size.edge_mm;
  structure.size.height_mm += clearance * structure.size.edge_mm;
  return structure;
}

}  // namespace

std::vector<double> sample_thetas(double theta) {
  const int samples = static_cast<int>(std::ceil(theta / sample_step));
  std::vector<double> out;
  for (int k = 1; k < samples; ++k) out.push_back(theta * k / samples);
  out.push_back(theta);
  return out;
}

MotionOverlapSearch::MotionOverlapSearch(model::Linkage structure, double clearance,
                                         std::function<model::State(double)> state, int threads)
    : state_(std::move(state)),
      most_(model::threads_of(threads)),
      contacts_{model::WallContact(thickened(std::move(structure), clearance))} {}

std::optional<MotionOverlapSearch::Overlap> MotionOverlapSearch::first_overlap(
    const std::vector<double>& thetas) {
  const int count = static_cast<int>(thetas.size()), most = std::min(most_, count);
  // The first state is checked alone: if walls collide, they mostly do there.
  for (int first = 0, now = 1; first < count; first += now, now = std::min(most, count - first)) {
    while (static_cast<int>(contacts_.size()) < now) contacts_.push_back(contacts_.front());
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
