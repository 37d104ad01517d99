#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Why walls keep an exact motion from coming to the run's theta, one sentence: they overlap as built or on the way, by the
/// certified range where there is one, else by samples. Nothing where no contact is known.
std::optional<std::string> contact_reason(const Run& run);

/// Lists walls that collide before the theta of a run, as far as samples of its motion show it. @param instead what would help, in words
std::vector<std::string> collisions_on_the_way(const Run& run, const std::string& instead);

}  // namespace kinetix::app
