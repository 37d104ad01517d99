#include "app/plan.hpp"

#include <fmt/format.h>

namespace kinetix {
namespace {

/// Beyond this the numeric rank costs more than a search; the exact families have one freedom by their closed
/// form.
constexpr std::size_t most_bodies_for_rank = 500;

std::string wall_sentence(const ThetaRange& range) {
  const double degrees = range.positive.theta / radians_per_degree;
  if (!range.positive.touches) return fmt::format("no walls touch up to theta {:.1f} deg", degrees);
  return fmt::format("walls touch at theta {:.2f} deg", degrees);
}

}  // namespace

Plan make_plan(const Structure& structure) {
  Plan plan;
  plan.family = classify(structure);
  plan.why.push_back(plan.family.why);
  if (structure.bodies.size() <= most_bodies_for_rank) {
    plan.mobility = mobility(structure);
    plan.why.push_back("mobility: " + plan.mobility->why);
  } else {
    plan.why.push_back(
        fmt::format("mobility: numeric rank not computed above {} bodies", most_bodies_for_rank));
  }
  if (plan.family.family != Family::none) {
    plan.free_range = theta_range(structure, plan.family);
    plan.why.push_back(wall_sentence(*plan.free_range));
    plan.why.push_back("states come from the closed form; the physics run alone sees contact");
  }
  return plan;
}

}  // namespace kinetix
