#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace kinetix::testing {

/// What in a result.json (or sweep.json, print.json) the published schema does not allow, and the keys that it does
/// not name; empty where all is well.
/// @param schema result, sweep, print...: which of app/schema
std::string schema_errors(const nlohmann::json& document, const std::string& schema = "result");

/// The flags of a result's verdict that are false, with a comma between them.
std::string false_flags(const nlohmann::json& result);

}  // namespace kinetix::testing
