#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace kinetix::testing {

/// What in a result.json the published schema does not allow; empty where all is well.
std::string schema_errors(const nlohmann::json& document);

}  // namespace kinetix::testing
