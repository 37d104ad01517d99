#pragma once

#include <string>
#include <string_view>

namespace kinetix::app {

/// SHA-256 (FIPS 180-4) in hexadecimal, as `sha256sum` prints it.
std::string sha256(std::string_view bytes);

}  // namespace kinetix::app
