#pragma once

#include <exception>
#include <string>

namespace kinetix::app::studio {

/// Why a command of the page failed, in words for people.
std::string failure_message(const std::exception& error);

}  // namespace kinetix::app::studio
