#pragma once

#include <string>
#include <string_view>

namespace kinetix::app {

/// @throws InvalidInput for text that is no base64 with its padding
std::string from_base64(std::string_view text);
/// With its padding.
std::string to_base64(std::string_view bytes);

}  // namespace kinetix::app
