#pragma once

#include <string>

namespace kinetix::testing {

/// A printer and a slicer's settings.
struct SlicingOf {
  int width, height;          // of its bed, mm
  double closing_mm = 0.049;  // by which the slicer closes gaps: those narrower than twice that; its default
  int pixels = 20;            // to a mm
  double layer_mm = 0.1;
};

/// PrusaSlicer's SLA archive of a file. @param folder for it, and for settings
/// @throws std::runtime_error where the slicer is missing or gives up
std::string sliced(const std::string& folder, const std::string& file, const SlicingOf& how);

/// Filament of the first extruder over that of the second, of a 3MF file in PrusaSlicer's G-code. @param folder as above
/// @throws std::runtime_error likewise
double filament_ratio(const std::string& folder, const std::string& file);

/// Connected pieces of what an SLA archive (one PNG a layer) would print: pixels that share an edge within a layer, or
/// lie over each other in two. @param swelling_px by which all is made larger in each layer first
int printed_pieces(const std::string& archive, int swelling_px = 0);

}  // namespace kinetix::testing
