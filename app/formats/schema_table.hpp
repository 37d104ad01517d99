#pragma once

#include <string>

namespace kinetix::app {

/// The keys of a JSON document as a table in Markdown: path, type with its range, meaning.
/// @param schema JSON Schema (draft 07) with `$ref` to its own definitions alone
/// @throws InvalidInput for a key without a description
std::string schema_table(const std::string& schema);

}  // namespace kinetix::app
