#include "app/files/hinge_limits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "targets/document/bound_key.hpp"

namespace kinetix::app {

namespace value = targets::value;

namespace {

/// Of a block or film, by its material; 0 of all others.
double bearable_strain(const HingeSection& hinge) {
  const bool bends = hinge.made && hinge.made->kind != model::HingeKind::pin;
  return bends ? hinge.made->material.strain_max : 0;
}

}  // namespace

std::vector<targets::Key> hinge_limit_keys(const std::string& instead, const targets::Default& usual_strain) {
  return {{"force_N", &HingeLimits::force_N, value::number(targets::above(0, "N")),
           "most that the drive may take on the way; " + instead},
          {"strain", &HingeLimits::strain, value::number({0, 10, false, true, {}}), usual_strain,
           "most that a hinge made as a block or film may be strained, likewise"}};
}

HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge,
                              const std::vector<HingePart>& parts) {
  HingeLimits limits;
  tolerance.read_into(limits);
  double most = bearable_strain(hinge);
  for (const HingePart& part : parts) most = std::max(most, bearable_strain(part.hinge));
  if (const auto strain = tolerance.optional("strain"); strain && most == 0)
    throw strain->key_error("applies to hinges made as blocks or films; give hinge.kind as well");
  if (limits.strain && *limits.strain > most)
    throw tolerance.optional("strain")->error(
        fmt::format("{:g} contradicts the material of `hinge`, which bears {:g}; allowed: up to that",
                    *limits.strain, most));
  return limits;
}

}  // namespace kinetix::app
