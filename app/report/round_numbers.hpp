#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kinetix::app {

/// Without ".0" where it is whole: a script reads the same number.
nlohmann::ordered_json short_number(double x);

/// Every number of a document that is no integer, to so many significant digits; what is less than 1e-15 becomes 0.
void round_numbers(nlohmann::ordered_json& value, int digits);

}  // namespace kinetix::app
