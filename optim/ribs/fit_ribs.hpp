#pragma once

#include "optim/ribs/fit_layout.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::optim {

/// Plans a fishbone on any surface. Its spine is the surface's line, with ribs in planes normal to it. They
/// extend to the end of the surface or to their neighbours.
/// @param spec clearance, tilts, theta, ribs; its coverage has no meaning
/// @throws InvalidInput as layout_along
RibsLayout plan_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec);

/// Fits tilts, theta and place of a fishbone (optim/ribs/fit_layout.hpp), in the frame of the ribs.
RibsDesign fit_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                    const SolverOptions& options);

/// Returns the share of a surface that cells folded to theta leave bare, (-inf, 1]. A cell covers the square
/// of its folded pitch.
double open_area(int cells, const model::CellSize& size, double theta, double area);

/// Ribs of a plan as separate pieces. Each is an exact strip on the curve where its plane cuts the surface.
struct LooseRibs {
  int pieces = 0;
  double rms = 0, max = 0;  ///< distance of bodies from the surface at the clearance, mm
  double open = 0;          ///< share of the surface left bare
};
LooseRibs fit_loose_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                         const SolverOptions& options);

}  // namespace kinetix::optim
