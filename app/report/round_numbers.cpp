#include "app/report/round_numbers.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace kinetix::app {
namespace {

constexpr double nothing = 1e-15;      // of any unit in a result: the rounding of a number about 1
constexpr double most_exact = 0x1p53;  // dimensionless: integers below it are doubles too

double with_digits(double x, int digits) {
  if (std::abs(x) < nothing) return 0;
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return std::strtod(text, nullptr);
}

}  // namespace

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

}  // namespace kinetix::app
