#include "app/files/hinge_limits.hpp"

#include <fmt/format.h>

namespace kinetix::app {

namespace value = targets::value;

std::vector<targets::Key> hinge_limit_keys(const std::string& instead, const targets::Default& usual_strain) {
  return {{"force_N",
           value::number(targets::above(0, "N")),
           {},
           "most that the drive may take on the way; " + instead},
          {"strain", value::number({0, 10, false, true, {}}), usual_strain,
           "most that a hinge made as a block or film may be strained, likewise"}};
}

HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge) {
  HingeLimits limits;
  tolerance.read("force_N", limits.force_N);
  const bool bends = hinge.made && hinge.made->kind != model::HingeKind::pin;
  tolerance.read("strain", limits.strain);
  if (const auto strain = tolerance.optional("strain"); strain && !bends)
    throw strain->key_error("applies to hinges made as blocks or films; give hinge.kind as well");
  if (limits.strain && *limits.strain > hinge.made->material.strain_max)
    throw tolerance.optional("strain")->error(
        fmt::format("{:g} contradicts the material of `hinge`, which bears {:g}; allowed: up to that",
                    *limits.strain, hinge.made->material.strain_max));
  return limits;
}

}  // namespace kinetix::app
