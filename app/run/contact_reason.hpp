#pragma once

#include <optional>
#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Why walls keep an exact motion from coming to the run's theta, one sentence: they overlap as built or on the way, by the
/// certified range where there is one, else by samples. Nothing where no contact is known.
std::optional<std::string> contact_reason(const Run& run);

}  // namespace kinetix::app
