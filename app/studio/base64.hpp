#pragma once

#include <string>
#include <string_view>

namespace kinetix::app::studio {

/// @throws InvalidInput for text that is no base64 with its padding
std::string from_base64(std::string_view text);

}  // namespace kinetix::app::studio
