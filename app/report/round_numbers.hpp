#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kinetix::app {

/// Every number of a document that is no integer, to so many significant digits; what is less than 1e-15 becomes 0.
void round_numbers(nlohmann::ordered_json& value, int digits);

}  // namespace kinetix::app
