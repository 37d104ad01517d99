#pragma once

#include <string>

namespace kinetix::app {

/// A PNG file as an address that holds all of it, for pages that need no other files.
std::string data_uri(const std::string& png);

}  // namespace kinetix::app
