#pragma once

#include "model/lattice/origami/origami_sheet.hpp"

namespace kinetix::optim {

/// The largest height of plates, cell edges, at which no two walls of a sheet meet on the way from flat to theta, up to
/// `most`; 0 where they meet even as threads. By bisection, at 40 states of the way each; thickness as the sheet has it.
double free_height(const model::OrigamiSheet& sheet, double theta, double most = 1);

/// Whether none meet, with the sheet's own height.
bool is_free(const model::OrigamiSheet& sheet, double theta);

}  // namespace kinetix::optim
