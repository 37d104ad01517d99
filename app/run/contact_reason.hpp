#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Names of the two walls of a pair of plates. A wall has two plates, one at each side of its hinge.
std::array<std::string, 2> wall_names(const model::WallPair& walls, const model::Lattice& sheet);

/// "walls A and B overlap as built" and what helps.
std::string overlap_words(const model::WallPair& walls, const model::Lattice& sheet);

/// "walls A and B overlap at theta 25.126 deg, on the way to 28.000 deg". @param theta rad, to which the motion goes
/// @pre limit.contact
std::string overlap_words(const model::ContactLimit& limit, double theta, const model::Lattice& sheet);

/// Why walls keep an exact motion from coming to the run's theta, one sentence: they overlap as built or on the way, by the
/// certified range where there is one, else by samples. Nothing where no contact is known.
std::optional<std::string> contact_reason(const Run& run);

/// Lists walls that collide before the theta of a run, as far as samples of its motion show it. @param instead what would help, in words
std::vector<std::string> collisions_on_the_way(const Run& run, const std::string& instead);

}  // namespace kinetix::app
