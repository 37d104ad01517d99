#pragma once

#include <cstddef>
#include <string_view>

namespace kinetix::targets {

/// Bytes of the UTF-8 character at `start`; 0 where it is malformed. @pre start < text.size()
std::size_t character_length(std::string_view text, std::size_t start);

}  // namespace kinetix::targets
