#include "app/pipeline/hinge_loads.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "app/pipeline/physics_settings.hpp"
#include "model/elastic/exact_theta.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/matter/hinge_strain.hpp"

namespace kinetix::app {

HingeLoads hinge_loads(const model::EquilibriumPath& path, const model::LinkageDrive& drive,
                       const model::Linkage& linkage, const HingeSection& hinge,
                       const std::map<int, HingeSection>& own) {
  HingeLoads loads;
  loads.reached = path.stop == model::EquilibriumPath::Stop::reached;
  loads.by_lever = drive.acts_from_outside() && !drive.has_force();
  if (drive.acts_from_outside())
    loads.force_N = largest_load(path) / (drive.has_force() ? 1 : linkage.size.edge_mm);
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const auto& made = hinge_at(hinge, own, h).made;
    if (made) loads.strain = std::max(loads.strain, hinge_strain(*made, linkage, path.state, h));
  }
  return loads;
}

double share_of(const HingeLimits& limits, const HingeLoads& loads) {
  if (!loads.reached) return INFINITY;
  double share = 0;
  if (limits.force_N) share = std::max(share, loads.force_N / *limits.force_N);
  if (limits.strain) share = std::max(share, loads.strain / *limits.strain);
  return share;
}

LimitRange halve(LimitRange range, const Halvings& halvings,
                 const std::function<std::optional<bool>(double at, double share)>& keeps) {
  for (int k = 0; k < halvings.most && range.too_much - range.kept > halvings.enough; ++k) {
    const double at = k == 0 && halvings.first ? *halvings.first : (range.kept + range.too_much) / 2;
    if (at < halvings.least) break;
    const std::optional<bool> kept = keeps(at, static_cast<double>(k) / halvings.most);
    if (!kept) break;
    (*kept ? range.kept : range.too_much) = at;
  }
  return range;
}

std::vector<std::string> violations(const HingeLimits& limits, const HingeLoads& loads,
                                    const std::string& instead) {
  std::vector<std::string> why;
  if (limits.force_N && !(loads.force_N <= *limits.force_N))
    why.push_back(
        fmt::format("the drive takes {:.3g} N{}; at most {:g} N is allowed, and {} does not keep that",
                    loads.force_N, lever_words(loads), *limits.force_N, instead));
  if (limits.strain && !(loads.strain <= *limits.strain))
    why.push_back(
        fmt::format("a hinge is strained by {:.2f}; at most {:g} is allowed, and {} does not keep that: a "
                    "longer gap or a thinner hinge strains less",
                    loads.strain, *limits.strain, instead));
  return why;
}

model::LinkageDrive drive_of(const Design& design) {
  if (!design.drive) return drive_to(design.structure, design.theta);
  return drive_on(design.structure, *design.drive, design.theta);
}

double exact_theta_of(const Design& design, const model::ExactMotion& exact) {
  if (!design.drive) return design.theta;
  const model::LinkageDrive drive = drive_of(design);
  if (drive.acts_from_outside()) return exact.theta_of(drive);
  return exact_theta({design.structure, drive, exact}, elasticity_of(design));
}

}  // namespace kinetix::app
