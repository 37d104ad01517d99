#include "app/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <utility>

#include "app/viewer/assets.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t bytes_per_pose = 52;      // bytes of one row as text
constexpr std::size_t bytes_of_frames = 60000;  // keeps a page of 637 bodies under 1.2 MB
// Significant digits: of numbers that a reader sees, and of values that only set colours.
constexpr int digits_of_numbers = 6, digits_of_colours = 4;
constexpr double mm = 1e-4, part = 1e-6;  // steps of positions (mm) and of quaternion components

/// Rounds to the nearest multiple of 1 / per_unit. Returns null if x is not a number.
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

/// Keeps every k-th frame including the last one. @param none true: keeps no frames
void thin_frames(Json& states, bool none) {
  Json kept = Json::array();
  std::size_t count = 0, seen = 0;
  for (const Json& state : states) count += state["name"] == "frame";
  const std::size_t bodies = states.empty() ? 0 : states[0]["poses"].size();
  const std::size_t most =
      std::max<std::size_t>(2, bytes_of_frames / (bytes_per_pose * std::max<std::size_t>(bodies, 1)));
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

constexpr double nothing = 1e-15;      // in any unit of a result: rounding error of a number near 1
constexpr double most_exact = 0x1p53;  // dimensionless: a double represents all integers below it exactly

double with_digits(double x, int digits) {
  if (std::abs(x) < nothing) return 0;
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return std::strtod(text, nullptr);
}

constexpr int digits_of_dots = 5;  // significant digits: enough for the position of a dot in a plot

double number(const Json& x) { return x.is_number() ? x.get<double>() : -1; }

/// Returns the effect of a factor on a response, by the best measure that its samples allow. Values are comparable only
/// among the factors of one response.
double effect_of(const Json& response, std::size_t factor) {
  if (response.contains("sobol")) return number(response["sobol"][factor]["total"][0]);
  if (response.contains("morris")) return number(response["morris"][factor]["mu_star"][0]);
  const Json& effect = response["main_effects"][factor];
  if (effect["variance_share"].is_number()) return number(effect["variance_share"]);
  double least = INFINITY, most = -INFINITY;
  for (const Json& level : effect["levels"])
    if (level["mean"].is_number()) {
      least = std::min(least, level["mean"].get<double>());
      most = std::max(most, level["mean"].get<double>());
    }
  return most - least;
}

std::vector<std::size_t> plotted(const Json& response) {
  std::vector<std::size_t> order(response["main_effects"].size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return effect_of(response, a) > effect_of(response, b);
  });
  if (order.size() > plotted_factors) order.resize(plotted_factors);
  return order;
}

}  // namespace

Json compact_result(Json result, bool has_scene) {
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

nlohmann::ordered_json short_number(double x) {
  return std::abs(x) < most_exact && x == std::trunc(x) ? nlohmann::ordered_json(static_cast<long long>(x))
                                                        : nlohmann::ordered_json(x);
}

void round_numbers(nlohmann::ordered_json& value, int digits) {
  if (value.is_number_float())
    value = short_number(with_digits(value.get<double>(), digits));
  else if (value.is_structured())
    for (auto& child : value) round_numbers(child, digits);
}

Json compact_sweep(Json sweep) {
  std::set<std::size_t> shown;
  for (Json& response : sweep["responses"]) {
    response["plotted"] = plotted(response);
    const std::set<std::size_t> own(response["plotted"].begin(), response["plotted"].end());
    for (std::size_t f = 0; f < response["main_effects"].size(); ++f)
      if (!own.contains(f)) response["main_effects"][f].erase("levels");
    shown.insert(own.begin(), own.end());
  }
  for (Json& row : sweep["scatter"])
    for (std::size_t f = 0; f < sweep["factors"].size(); ++f)
      if (!shown.contains(f)) row[f] = nullptr;
  round_numbers(sweep, digits_of_dots);
  return sweep;
}

namespace {

// Marks of a page for the script of the three-dimensional view and for the result, in this order (report.hpp).
constexpr std::string_view scene_mark = "@SCENE@";
constexpr std::string_view result_mark = "@RESULT@";

/// Escapes '<', so that the JSON cannot end its script element. In JSON, '<' occurs only within strings.
std::string inert(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string filled(std::string_view page, std::string_view scene, const std::string& json) {
  const std::size_t first = page.find(scene_mark), at = page.find(result_mark);
  std::string text(page.substr(0, first));
  text += scene;
  text += page.substr(first + scene_mark.size(), at - first - scene_mark.size());
  text += inert(json);
  text += page.substr(at + result_mark.size());
  return text;
}

// Text around the result in report.html.
constexpr std::string_view data_start = R"(<script type="application/json" id="result">)";
constexpr std::string_view data_end = "</script>";

/// Returns the index of the result's first character and the index after its last one. Without a result, both are the
/// size of the page.
std::pair<std::size_t, std::size_t> data_range(const std::string& page) {
  const std::size_t before = page.find(data_start);
  if (before == std::string::npos) return {page.size(), page.size()};
  const std::size_t first = before + data_start.size(), end = page.find(data_end, first);
  return {first, end == std::string::npos ? first : end};
}

}  // namespace

std::string data_of_report(const std::string& page) {
  const auto [first, end] = data_range(page);
  return page.substr(first, end - first);
}

std::string report_with(const std::string& page, const std::string& result_json) {
  const auto [first, end] = data_range(page);
  return page.substr(0, first) + inert(result_json) + page.substr(end);
}

std::string report_html(const std::string& result_json) {
  return filled(report_page, scene_script(), result_json);
}

std::string sweep_html(const std::string& sweep_json) { return filled(sweep_page, {}, sweep_json); }

}  // namespace kinetix::app
