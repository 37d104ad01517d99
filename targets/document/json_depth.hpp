#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace kinetix::targets {

/// Finds the first bracket of a JSON text that is nested more than max_document_depth deep. Every reader of JSON
/// requires that there is none: the parser accepts any depth, but copies and printing recurse and exhaust the stack.
std::optional<std::size_t> find_too_deep(std::string_view json);

}  // namespace kinetix::targets
