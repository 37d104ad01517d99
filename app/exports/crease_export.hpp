#pragma once

#include "app/exports/exporter.hpp"
#include "model/lattice/planar/crease_pattern.hpp"

namespace kinetix::app {

/// creases.fold, of creased sheets of other lattices than squares: their facets and creases as a FOLD file (1.1) in mm, flat
/// and, as a second frame, folded to the state that the run shows.
extern const Exporter crease_export;

/// The text of that file.
std::string origami_text(const model::CreasePattern& pattern, double theta, const std::string& title);

}  // namespace kinetix::app
