#include "app/report/light_result.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/report/round_numbers.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t bytes_a_pose = 52;        // of a row, as text
constexpr std::size_t bytes_of_frames = 60000;  // a page of 637 bodies then stays under 1.2 MB
constexpr int digits_of_numbers = 6,
              digits_of_colours = 4;      // significant ones: of what is read, of what is coloured
constexpr double mm = 1e-4, part = 1e-6;  // to which places and quaternions are shown

/// Nearest multiple of 1 / per_unit; null where there is no number.
Json rounded(const Json& x, double per_unit) {
  return x.is_number() ? short_number(std::round(x.get<double>() * per_unit) / per_unit) : Json();
}

Json row_of(const Json& pose) {
  Json row = Json::array();
  for (const Json& x : pose["position_mm"]) row.push_back(rounded(x, 1 / mm));
  for (const Json& x : pose["quaternion_wxyz"]) row.push_back(rounded(x, 1 / part));
  return row;
}

void make_rows(Json& state) {
  Json rows = Json::array();
  for (const Json& pose : state["poses"]) rows.push_back(row_of(pose));
  state.erase("poses");
  state["rows"] = std::move(rows);
}

/// Every k-th frame, the last of them included.
void thin_frames(Json& states, bool none) {
  Json kept = Json::array();
  std::size_t count = 0, seen = 0;
  for (const Json& state : states) count += state["name"] == "frame";
  const std::size_t bodies = states.empty() ? 0 : states[0]["poses"].size();
  const std::size_t most =
      std::max<std::size_t>(2, bytes_of_frames / (bytes_a_pose * std::max<std::size_t>(bodies, 1)));
  const std::size_t every = (count + most - 1) / most;
  for (Json& state : states) {
    const bool is_frame = state["name"] == "frame";
    if (is_frame) ++seen;
    if (!is_frame || (!none && (count - seen) % every == 0)) kept.push_back(std::move(state));
  }
  states = std::move(kept);
}

bool is_computed(const Json& result) {
  const Json& states = result["states"];
  return result["plan"]["family"] != "none" && !states.empty() && states[0].value("model", "") == "exact";
}

}  // namespace

Json light_result(Json result, bool has_scene) {
  thin_frames(result["states"], has_scene && is_computed(result));
  for (Json& state : result["states"]) make_rows(state);
  Json states = std::move(result["states"]);
  result["states"] = nullptr;
  for (Json& hinge : result["structure"]["hinges"]) hinge.erase("reach_mm");
  if (const auto equilibrium = result.find("equilibrium");
      equilibrium != result.end() && equilibrium->is_object()) {
    for (Json& state : (*equilibrium)["stable_states"]) make_rows(state);
    round_numbers((*equilibrium)["hinge_energy_Nmm"], digits_of_colours);
  }
  round_numbers(result, digits_of_numbers);
  result["states"] = std::move(states);
  return result;
}

}  // namespace kinetix::app
