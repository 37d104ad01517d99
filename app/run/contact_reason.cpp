#include "app/run/contact_reason.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinetix::app {
namespace {

std::optional<std::string> sampled_reason(const Run& run) {
  if (!run.plan.free_range) return std::nullopt;
  const model::ThetaLimit& limit =
      run.theta < 0 ? run.plan.free_range->negative : run.plan.free_range->positive;
  if (!limit.touches || std::abs(run.theta) <= std::abs(limit.theta)) return std::nullopt;
  return fmt::format("walls collide at theta {:.2f} deg, on the way to {:.2f} deg", to_degrees(limit.theta),
                     to_degrees(run.theta));
}

}  // namespace

std::optional<std::string> contact_reason(const Run& run) {
  if (!run.certified || !run.certified->designed) return sampled_reason(run);
  const model::CertifiedLimit& limit = run.certified->designed.to(run.theta);
  if (!limit.contact || std::abs(*limit.contact) >= std::abs(run.theta)) return std::nullopt;
  if (run.certified->designed.overlaps_as_built()) return overlap_words(limit.walls, run.design.structure);
  const auto [first, second] = wall_names(limit, run.design.structure);
  return fmt::format("walls {} and {} overlap at theta {:.3f} deg, on the way to {:.3f} deg", first, second,
                     to_degrees(*limit.contact), to_degrees(run.theta));
}

std::vector<std::string> collisions_on_the_way(const Run& run, const std::string& instead) {
  const auto& range = run.plan.free_range;
  if (!range || !range->positive.touches || run.theta <= range->positive.theta) return {};
  return {fmt::format("walls collide on the way, at theta {:.2f} deg: {}", to_degrees(range->positive.theta),
                      instead)};
}

}  // namespace kinetix::app
