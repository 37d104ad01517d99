#pragma once

#include <vector>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "model/hinge/elasticity.hpp"

namespace kinetix::app {

/// What a picture gains by hinges that may sit further off their walls, and what it costs: a search and an
/// equilibrium between the plates for each of a few offsets, the file's own among them, in ascending order.
/// @param progress words and the share done
std::vector<FrontPoint> legibility_front(const DisplayFile& file, const model::Elasticity& elasticity,
                                         const optim::DisplayOptions& options,
                                         const std::function<void(const std::string&, double)>& progress);

}  // namespace kinetix::app
