#pragma once

#include "optim/ribs/fit_layout.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::optim {

/// A fishbone on any surface: spine along its line, ribs in planes normal to it, as far as the surface goes,
/// or to where they meet their neighbours.
/// @param spec clearance, tilts, theta, ribs; its coverage has no meaning
/// @throws InvalidInput as layout_along
RibsLayout plan_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec);

/// Its tilts, theta and place (optim/ribs/fit_layout.hpp), in the frame of the ribs.
RibsDesign fit_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                    const SolverOptions& options);

/// Share of a surface that cells folded to theta leave bare, (-inf, 1]: a cell covers the square of its folded pitch.
double open_area(int cells, const model::CellSize& size, double theta, double area);

/// The same ribs as pieces of their own, each an exact strip on the curve where its plane cuts the surface.
struct LooseRibs {
  int pieces = 0;
  double rms = 0, max = 0;  ///< distance of bodies from the surface at the clearance, mm
  double open = 0;          ///< share of the surface that they leave bare
};
LooseRibs fit_loose_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                         const SolverOptions& options);

}  // namespace kinetix::optim
