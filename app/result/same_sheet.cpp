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
Json compared(Json hinges) {
  for (Json& hinge : hinges)
    if (hinge.is_object()) hinge.erase("reach_mm");
  return hinges;
}

}  // namespace

Json sheet_json(const DesignFile& design) {
  Run run;
  run.structure = design.structure;
  run.hinge = design.hinge;
  run.own_hinges = design.own_hinges;
  const double edge = design.structure.size().edge_mm;
  return structure_json(run, design.hinge.reach_mm.value_or(sim::PhysicsOptions{}.reach * edge));
}

bool is_of_sheet(const Json& result, const DesignFile& design, double rounding) {
  if (!result.is_object() || !result.contains("structure")) return false;
  const Json &known = result["structure"], sheet = sheet_json(design);
  if (!known.is_object() || !known.contains("bodies") || !known.contains("hinges")) return false;
  return is_near(known["bodies"], sheet["bodies"], rounding) &&
         is_near(compared(known["hinges"]), compared(sheet["hinges"]), rounding);
}

}  // namespace kinetix::app
