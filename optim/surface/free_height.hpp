#pragma once

#include "model/lattice/origami/origami_sheet.hpp"

namespace kinetix::optim {

/// Returns the largest height of plates, cell edges, up to `most`, at which no two walls of a sheet meet from
/// flat to theta. 0 if they meet even as threads. Found by bisection with 40 states per motion; the thickness
/// is that of the sheet.
double free_height(const model::OrigamiSheet& sheet, double theta, double most = 1);

/// Returns whether no walls meet at the sheet's own height.
bool is_free(const model::OrigamiSheet& sheet, double theta);

}  // namespace kinetix::optim
