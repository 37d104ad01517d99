#pragma once

#include <string>

namespace kinetix::app {

/// "2.3 s", "41 s", "4 min 10 s", "3 h 20 min"
std::string duration_text(double seconds);

}  // namespace kinetix::app
