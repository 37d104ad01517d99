#include "app/pipeline/certify.hpp"

#include <algorithm>
#include <cmath>

#include "model/sheet/sheet_motion.hpp"
#include "model/sheet/turn_laws.hpp"

namespace kinetix::app {
namespace {

constexpr double deviations = 3;  // of a normal distribution: 997 of 1000 are within

Certified along(const model::Sheet& sheet, const model::ExactMotion& exact, const model::PrintError& sd) {
  const model::Linkage linkage = sheet;
  const auto laws = exact ? turn_laws(sheet) : std::vector<model::TurnLaw>{};
  return {certified_range(linkage, exact, laws),
          certified_range(linkage, exact, laws, {.growth_mm = print_growth_mm(linkage, sd)})};
}

}  // namespace

double print_growth_mm(const model::Linkage& sheet, const model::PrintError& sd) {
  double farthest = 0;
  for (const model::HalfWall& wall : half_walls(sheet))
    farthest =
        std::max(farthest, ((wall.box.axes.transpose() * wall.box.center).cwiseAbs() + wall.box.half).norm());
  const double tilt = std::min(deviations * sd.tilt_deg * radians_per_degree, pi / 2);
  return deviations * sd.t_mm + std::sin(tilt) * farthest;
}

Certified certify(const model::Sheet& sheet, const Plan& plan, const model::PrintError& sd) {
  return along(sheet, plan.exact, sd);
}

Certified certify(const model::Sheet& sheet, const model::PrintError& sd) {
  return along(sheet, exact_motion(sheet), sd);
}

}  // namespace kinetix::app
