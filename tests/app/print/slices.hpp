#pragma once

#include <string>
#include <utility>

namespace kinetix::testing {

/// A printer and the settings of its slicer.
struct SlicingOf {
  int width = 0, height = 0;  // of the printer's bed, mm
  double closing_mm =
      0.049;        // gap closing radius, mm: the slicer closes gaps narrower than twice this; its default
  int pixels = 20;  // pixels per mm
  double layer_mm = 0.1;
};

/// Slices a file into PrusaSlicer's SLA archive.
/// @param folder for the archive and the settings
/// @throws std::runtime_error if the slicer is missing or fails
std::string sliced(const std::string& folder, const std::string& file, const SlicingOf& how);

/// Computes the filament length of the first extruder over that of the second, from PrusaSlicer's G-code of a 3MF file.
/// @param folder for the G-code and the settings
/// @throws std::runtime_error if the slicer is missing or fails
double filament_ratio(const std::string& folder, const std::string& file);

/// Computes the filament that PrusaSlicer's G-code of a file extrudes, mm^3.
/// @param profile settings of the print, as lines of an INI file
/// @throws std::runtime_error if the slicer is missing or fails
double filament_mm3(const std::string& folder, const std::string& file, const std::string& profile);

/// Counts the connected pieces in an SLA archive (one PNG per layer). Pixels are connected if they share an edge within
/// a layer or are above each other in two layers.
int printed_pieces(const std::string& archive);

/// Counts the pieces like `printed_pieces`, also after all pixels in each layer have grown.
/// @param swelling_px growth before the second count
/// @return the counts without and with the growth
std::pair<int, int> printed_and_swollen_pieces(const std::string& archive, int swelling_px);

}  // namespace kinetix::testing
