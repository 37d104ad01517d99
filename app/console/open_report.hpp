#pragma once

#include <string>

namespace kinetix::app {

/// Shows a file in the user's browser, by xdg-open, and does not wait for it. Says on stderr where there is none.
void open_report(const std::string& path);

}  // namespace kinetix::app
