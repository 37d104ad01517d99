#include "app/pipeline/certify.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/base/parallel_runs.hpp"
#include "model/contact/certified_range.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/turn_laws.hpp"

namespace kinetix::app {
namespace {

constexpr double deviations = 3;  // standard deviations of a normal distribution: 997 of 1000 are within

ProvenRanges along(const model::Lattice& sheet, const model::ExactMotion& exact, const model::PrintError& sd,
                   int threads, const std::stop_token& stop) {
  const model::Linkage linkage = sheet;
  const auto laws = exact ? turn_laws(sheet) : std::vector<model::TurnLaw>{};
  const double growth_mm[] = {0, print_growth_mm(linkage, sd)};
  model::ContactRange ranges[2];
  model::run_in_parallel(2, threads, [&](int k) {
    ranges[k] = certified_range(linkage, exact, laws, {.growth_mm = growth_mm[k], .stop = stop});
  });
  return {std::move(ranges[0]), std::move(ranges[1])};
}

}  // namespace

double print_growth_mm(const model::Linkage& sheet, const model::PrintError& sd) {
  double farthest = 0;
  for (const model::HalfWall& wall : half_walls(sheet)) {
    Eigen::Vector3d reach = (wall.box.axes.transpose() * wall.box.center).cwiseAbs() + wall.box.half;
    reach.x() += std::abs(wall.box.slant) * wall.box.half.y();
    farthest = std::max(farthest, reach.norm());
  }
  const double tilt = std::min(deviations * sd.tilt_deg * radians_per_degree, pi / 2);
  return deviations * sd.t_mm + std::sin(tilt) * farthest;
}

ProvenRanges certify(const model::Lattice& sheet, const Plan& plan, const model::PrintError& sd, int threads,
                     const std::stop_token& stop) {
  return along(sheet, plan.exact, sd, threads, stop);
}

ProvenRanges certify(const model::Lattice& sheet, const model::PrintError& sd) {
  return along(sheet, exact_motion(sheet), sd, 0, {});
}

}  // namespace kinetix::app
