#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace kinetix::testing {

/// Lists what the published schema does not allow in a result.json (or sweep.json, print.json), and keys that the
/// schema does not name. Empty: the document is valid.
/// @param schema result, sweep, print...: which file of app/schema
std::string schema_errors(const nlohmann::json& document, const std::string& schema = "result");

/// Lists the flags of a result's verdict that are false, separated by commas.
std::string false_flags(const nlohmann::json& result);

}  // namespace kinetix::testing
