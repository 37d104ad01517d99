#include "app/files/variables_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/contact/wall_contact.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

// At 0 nothing folds; at 45 deg a cell with hinges in the middle of its walls has closed.
const targets::Bounds fold = targets::between(0, 45, "degrees");

double read_tilt(const targets::Section& beta, double usual) {
  std::array<double, 2> range = {-usual, usual};
  beta.read("range_deg", range);
  if (!(range[0] < 0 && range[1] > 0))
    throw beta.optional("range_deg")
        ->error("leaves one sign out: tilts alternate in sign along a crease; give a range around 0");
  return std::min(-range[0], range[1]);
}

/// Where the file says how far theta may go, or would have.
const targets::Section& place_of_theta(const targets::Section& root, const targets::Section& variables,
                                       const targets::Section& theta) {
  return theta.given() ? theta : variables.given() ? variables : root;
}

}  // namespace

targets::Key tilt_range_key(const optim::AngleRange& usual) {
  return {"range_deg", value::angle_range(targets::from_to(-89, 89, "degrees")),
          targets::by_default_deg(usual.lower, usual.upper), "smallest and largest tilt of a hinge"};
}

targets::Key theta_key(const optim::AngleRange& usual) {
  return {"theta",
          targets::KeyTable(
              {{"range_deg", value::angle_range(fold), targets::by_default_deg(usual.lower, usual.upper),
                "smallest and largest theta, cut where the walls close the cells"}}),
          "the fold parameter, one for the whole sheet"};
}

targets::KeyTable net_variables_keys(double tilt, const optim::AngleRange& theta) {
  targets::Key range = tilt_range_key({-tilt, tilt});
  range.meaning += "; holds 0 inside, and the nearer end counts for both signs, since tilts alternate";
  return targets::KeyTable(
      {{"beta", targets::KeyTable({range}), "the tilts of the hinges"}, theta_key(theta)});
}

optim::AngleRange read_theta(const targets::Section& root, const model::CellSize& size,
                             const optim::AngleRange& usual) {
  const targets::Section variables = root.section("variables"), theta = variables.section("theta");
  optim::AngleRange range = usual;
  theta.read("range_deg", range);
  const double closing = closing_theta(size);
  if (range.lower < closing) return range;
  throw place_of_theta(root, variables, theta)
      .error(fmt::format("theta starts above {:.2f} deg, where walls of {:.3g} mm close cells of {:.3g} mm",
                         to_degrees(closing), size.thickness_mm, size.edge_mm));
}

NetVariables read_net_variables(const targets::Section& root, const model::CellSize& size,
                                const NetVariables& usual) {
  const double tilt = read_tilt(root.section("variables").section("beta"), usual.tilt);
  return {tilt, read_theta(root, size, usual.theta)};
}

}  // namespace kinetix::app
