#pragma once

#include <string_view>

namespace kinetix::app {

/// The report's page with style and scripts in place, @SCENE@ where the three-dimensional view goes and @RESULT@ where the result goes.
extern const std::string_view report_page;
/// That of a sweep, likewise.
extern const std::string_view sweep_page;

}  // namespace kinetix::app
