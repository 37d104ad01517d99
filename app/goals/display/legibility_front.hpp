#pragma once

#include <vector>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "model/base/progress.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/hinge/elasticity.hpp"

namespace kinetix::app {

/// @param offset largest of a hinge, cell edges   @param seen at the end of the path
FrontPoint front_point(double offset, const DisplayReading& seen, const model::EquilibriumPath& path);

/// What a picture gains by hinges that may sit further off their walls, and what it costs: the file's own panel, and
/// a search and an equilibrium under the same drive for each of a few other offsets, in ascending order. None of the
/// others strains its hinges on purpose; where the file's own does, the same offset without strain is among them.
/// @param own of the file   @param progress words and the share done
std::vector<FrontPoint> legibility_front(const DisplayFile& file, const FrontPoint& own,
                                         const model::Elasticity& elasticity,
                                         const optim::DisplayOptions& options, const Progress& progress);

}  // namespace kinetix::app
