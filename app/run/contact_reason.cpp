#include "app/run/contact_reason.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinetix::app {
namespace {

std::optional<std::string> sampled_reason(const Run& run) {
  if (!run.plan.free_range) return std::nullopt;
  const model::ContactLimit& limit = run.plan.free_range->to(run.theta);
  if (!limit.touches || std::abs(run.theta) <= std::abs(limit.theta)) return std::nullopt;
  return fmt::format("walls collide at theta {:.2f} deg, on the way to {:.2f} deg", to_degrees(limit.theta),
                     to_degrees(run.theta));
}

}  // namespace

std::array<std::string, 2> wall_names(const model::WallPair& walls, const model::Sheet& sheet) {
  return {wall_name(sheet, walls.first / 2), wall_name(sheet, walls.second / 2)};
}

std::string overlap_words(const model::WallPair& walls, const model::Sheet& sheet) {
  const auto [first, second] = wall_names(walls, sheet);
  return fmt::format(
      "walls {} and {} overlap as built, before anything turns, so that no sheet of rigid walls can be made "
      "so: lower or thinner walls, less tilt or larger cells keep them apart",
      first, second);
}

std::optional<std::string> contact_reason(const Run& run) {
  if (!run.certified || !run.certified->designed) return sampled_reason(run);
  const model::ContactLimit& limit = run.certified->designed.to(run.theta);
  if (!limit.contact || std::abs(*limit.contact) >= std::abs(run.theta)) return std::nullopt;
  if (run.certified->designed.overlaps_as_built()) return overlap_words(limit.walls, run.design.structure);
  const auto [first, second] = wall_names(limit.walls, run.design.structure);
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
