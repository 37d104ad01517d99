#include "app/variables_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/wall_contact.hpp"

namespace kinetix {
namespace {

double read_tilt(const Node& variables, double usual) {
  const auto beta = variables.optional("beta");
  if (!beta) return usual;
  beta->reject_unknown_keys({"range_deg"});
  const auto range = beta->optional("range_deg");
  if (!range) return usual;
  const auto [lower, upper] = range->angle_range(from_to(-89, 89, "degrees"));
  if (!(lower < 0 && upper > 0))
    throw range->error("leaves one sign out: tilts alternate in sign along a crease; give a range around 0");
  return std::min(-lower, upper);
}

}  // namespace

AngleRange read_theta(const Node& variables, const CellSize& size, const AngleRange& usual) {
  AngleRange theta = usual;
  const auto section = variables.optional("theta");
  if (section) {
    section->reject_unknown_keys({"range_deg"});
    if (const auto range = section->optional("range_deg")) {
      const auto [lower, upper] = range->angle_range(between(0, 45, "degrees"));
      theta = {lower, upper};
    }
  }
  const double closing = closing_theta(size);
  if (theta.lower < closing) return theta;
  throw section.value_or(variables).error(
      fmt::format("theta starts above {:.2f} deg, where walls of {:.3g} mm close cells of {:.3g} mm",
                  to_degrees(closing), size.thickness_mm, size.edge_mm));
}

NetVariables read_net_variables(const Node& root, const CellSize& size, const NetVariables& usual) {
  const auto section = root.optional("variables");
  if (section) section->reject_unknown_keys({"beta", "theta"});
  return {section ? read_tilt(*section, usual.tilt) : usual.tilt,
          read_theta(section.value_or(root), size, usual.theta)};
}

}  // namespace kinetix
