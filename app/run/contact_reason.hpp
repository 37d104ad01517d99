#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Returns the names of the two walls of a pair of plates. A wall has two plates, one at each side of its hinge.
std::array<std::string, 2> wall_names(const model::WallPair& walls, const model::Lattice& sheet);

/// Returns "walls A and B overlap as built" with advice.
std::string overlap_words(const model::WallPair& walls, const model::Lattice& sheet);

/// Returns "walls A and B overlap at theta 25.126 deg, on the way to 28.000 deg". @param theta end of the motion, rad
/// @pre limit.contact
std::string overlap_words(const model::ContactLimit& limit, double theta, const model::Lattice& sheet);

/// Describes why walls keep an exact motion from reaching the run's theta, one sentence. They overlap as built or
/// during the motion, by the certified range if there is one, otherwise by samples. Empty if no contact is known.
std::optional<std::string> contact_reason(const Run& run);

/// Returns contact_reason() with advice, as a list of at most one entry. @param instead advice, in words
std::vector<std::string> collisions_on_the_way(const Run& run, const std::string& instead);

}  // namespace kinetix::app
