#include "app/run/contact_reason.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinetix::app {
std::array<std::string, 2> wall_names(const model::WallPair& walls, const model::Lattice& sheet) {
  return {wall_name(sheet, walls.first / 2), wall_name(sheet, walls.second / 2)};
}

std::string overlap_words(const model::WallPair& walls, const model::Lattice& sheet) {
  const auto [first, second] = wall_names(walls, sheet);
  return fmt::format(
      "walls {} and {} overlap as built, before anything turns, so that no sheet of rigid walls can be made "
      "so: lower or thinner walls, less tilt or larger cells keep them apart",
      first, second);
}

std::string overlap_words(const model::ContactLimit& limit, double theta, const model::Lattice& sheet) {
  const auto [first, second] = wall_names(limit.walls, sheet);
  return fmt::format("walls {} and {} overlap at theta {:.3f} deg, on the way to {:.3f} deg", first, second,
                     to_degrees(*limit.contact), to_degrees(theta));
}

std::optional<std::string> contact_reason(const Run& run) {
  const bool is_proven = run.certified && run.certified->designed;
  if (!is_proven && !run.plan.free_range) return std::nullopt;
  const model::ContactRange& range = is_proven ? run.certified->designed : *run.plan.free_range;
  const model::ContactLimit& limit = range.to(run.theta);
  if (!limit.contact || std::abs(*limit.contact) >= std::abs(run.theta)) return std::nullopt;
  if (range.overlaps_as_built()) return overlap_words(limit.walls, run.design.structure);
  return overlap_words(limit, run.theta, run.design.structure);
}

std::vector<std::string> collisions_on_the_way(const Run& run, const std::string& instead) {
  const auto reason = contact_reason(run);
  return reason ? std::vector{*reason + ": " + instead} : std::vector<std::string>{};
}

}  // namespace kinetix::app
