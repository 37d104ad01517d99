#include "app/result/same_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "app/result/result_json.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

bool is_near(const Json& a, const Json& b, double rounding) {
  if (a.is_number() && b.is_number()) {
    const double x = a, y = b;
    return std::abs(x - y) <= rounding * std::max(1.0, std::abs(x));
  }
  if (a.is_structured() && a.type() == b.type() && a.size() == b.size())
    return std::equal(a.begin(), a.end(), b.begin(),
                      [&](const Json& p, const Json& q) { return is_near(p, q, rounding); });
  return a == b;
}

/// What reports leave out of hinges counts for nothing.
Json compared(Json part) {
  for (Json& entry : part)
    if (entry.is_object()) entry.erase("reach_mm");
  return part;
}

}  // namespace

Json sheet_json(const Design& design) {
  const double edge = design.structure.size().edge_mm;
  return structure_json(design, design.hinge.reach_mm.value_or(sim::PhysicsOptions{}.reach * edge));
}

bool is_of_sheet(const Json& result, const Design& design, double rounding) {
  if (!result.is_object() || !result.contains("structure")) return false;
  const Json &known = result["structure"], sheet = sheet_json(design);
  const auto is_kept = [&](const char* part) {
    return known.is_object() && known.contains(part) &&
           is_near(compared(known[part]), compared(sheet[part]), rounding);
  };
  return is_kept("cell_mm") && is_kept("wall_mm") && is_kept("bodies") && is_kept("hinges");
}

}  // namespace kinetix::app
