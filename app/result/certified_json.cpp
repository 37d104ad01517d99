#include "app/result/certified_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/run/contact_reason.hpp"
#include "model/elastic/path/closed_form.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;
using model::ContactLimit;
using model::ContactRange;

Json limit_json(const ContactLimit& limit, const model::Lattice& sheet) {
  Json out = {{"theta_rad", limit.theta}, {"contact_rad", nullptr}, {"walls", Json::array()}};
  if (limit.contact) out["contact_rad"] = *limit.contact;
  if (limit.touches) out["walls"] = wall_names(limit.walls, sheet);
  return out;
}

Json range_json(const ContactRange& range, const model::Lattice& sheet) {
  return {{"growth_mm", range.growth_mm},
          {"low", limit_json(range.negative, sheet)},
          {"high", limit_json(range.positive, sheet)},
          {"left_out", range.touching_at_rest.size()}};
}

/// Formats the collision-free range of theta. Returns "nowhere" if it is 0 deg at both ends after rounding.
std::string between(const ContactRange& range) {
  constexpr double shown = 0.005 * radians_per_degree;  // smaller angles print as 0.00 deg
  if (-range.negative.theta < shown && range.positive.theta < shown) return "nowhere";
  return fmt::format("{:.2f} to {:.2f} deg", to_degrees(range.negative.theta),
                     to_degrees(range.positive.theta));
}

std::string end_words(const ContactLimit& limit, const model::Lattice& sheet) {
  if (!limit.touches) return "where the search ends";
  const auto [first, second] = wall_names(limit.walls, sheet);
  return fmt::format("limited by walls {} and {}", first, second);
}

/// Returns the lines for an equilibrium that left the closed form. The range applies to the closed form only.
std::vector<SummaryLine> left_lines(const ProvenRanges& certified, const model::Lattice& sheet,
                                    double theta) {
  return {{"NOT PROVEN",
           "free of contact: the equilibrium has left the closed form, and of its states nothing is proven"},
          {"", fmt::format("the closed form, which these states are not, is free of it for theta {}, {}",
                           between(certified.designed), end_words(certified.designed.to(theta), sheet))},
          {"", fmt::format("that form printed, with walls up to {:.2f} mm out of place: {}",
                           certified.printed.growth_mm, between(certified.printed))}};
}

}  // namespace

NearExact near_exact(const Run& run) {
  if (!run.equilibrium) return NearExact::same;
  const Equilibrium& found = *run.equilibrium;
  const bool is_near = found.turned_off && *found.turned_off <= model::ClosedForm::far;
  return is_near && !found.path.off_closed_form ? NearExact::near : NearExact::left;
}

Json certified_json(const ProvenRanges& certified, const model::Lattice& sheet, double theta,
                    NearExact states) {
  if (!certified.designed) return {{"why_not", certified.designed.why_not}};
  return {{"design", range_json(certified.designed, sheet)},
          {"printed", range_json(certified.printed, sheet)},
          {"states_are_exact", states == NearExact::same},
          {"states_have_left", states == NearExact::left},
          {"covers_theta", certified.designed.covers(theta)},
          {"covers_theta_printed", certified.printed.covers(theta)}};
}

std::vector<SummaryLine> certified_lines(const ProvenRanges& certified, const model::Lattice& sheet,
                                         double theta, NearExact states) {
  if (!certified.designed)
    return {{"contact", "no range of theta is proven free of it: " + certified.designed.why_not}};
  if (certified.designed.overlaps_as_built())
    return {{"NOT PROVEN", "free of contact: " + overlap_words(certified.designed.positive.walls, sheet)}};
  if (states == NearExact::left) return left_lines(certified, sheet, theta);
  const std::string range = fmt::format("theta {}, {}", between(certified.designed),
                                        end_words(certified.designed.to(theta), sheet));
  std::vector<SummaryLine> lines = {
      certified.designed.covers(theta)
          ? SummaryLine{"proven", "free of contact for " + range}
          : SummaryLine{"NOT PROVEN", fmt::format("free of contact at theta {:.2f} deg: proven for {}",
                                                  to_degrees(theta), range)}};
  if (states == NearExact::near)
    lines.push_back({"", "of the closed form: equilibria of elastic hinges come near it"});
  lines.push_back({"", fmt::format("printed, with walls up to {:.2f} mm out of place: {}",
                                   certified.printed.growth_mm, between(certified.printed))});
  return lines;
}

}  // namespace kinetix::app
