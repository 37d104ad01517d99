#include "app/report/light_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "app/report/round_numbers.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int digits_of_dots = 5;  // significant ones: a dot in a plot is not placed better

double number(const Json& x) { return x.is_number() ? x.get<double>() : -1; }

/// How much a factor does to a response, by the best that its samples say; comparable among its factors only.
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

Json light_sweep(Json sweep) {
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

}  // namespace kinetix::app
