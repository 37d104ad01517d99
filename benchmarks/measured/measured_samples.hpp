#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

/// Printed samples that others have measured, as numbers with their source. measured.md describes the samples.
namespace kinetix::bench {

/// Width and height of a printed sheet in states of its one motion. Source:
/// github.com/Hougeichao/Mechanism-based-metamaterials-with-microstructurally-invariant-shape-change, commit
/// dc33c1aca717, PlotStretchRatios_GitHub/exp/NAME_exp{1,2,3}.txt; paper: arXiv 2601.08018. Lengths were read in whole
/// mm. A1, A2 and B1 have two readings per length; here is their mean.
struct StretchSample {
  std::string name;
  std::string design;       ///< file in targets/shapes with the same bulk motion
  double reference_mm = 0;  ///< width and height at a stretch of 1 (plotStretchRatios.m)
  std::vector<std::vector<Eigen::Vector2d>> runs;  ///< width and height, mm, in the order of the motion
};

/// Returns the samples A1, A2, B1 and B2: 108 points in three runs each.
const std::vector<StretchSample>& stretch_samples();

/// Row of markers on neighbouring cells of a lattice of crosses on pins. Source:
/// github.com/TransformativeRoboticsLab/Auxetic-Backlash-Model, commit e1cac15a4718; paper: arXiv 2512.00072. Positions
/// are means over the frames of a motion capture; spacings and bends follow from them.
struct MarkerRow {
  std::string name;
  std::string file;  ///< of the repository
  /// Distances of neighbouring markers, mm. Captures t1, t2, t3 and t7 have no marker on the second cell; the step
  /// over it is left out.
  std::vector<double> spacing_mm;
  /// Change of the row's slope at inner markers, degrees; negative in a dome. The bend after a step over two cells is
  /// left out.
  std::vector<double> bend_deg;
};

/// Returns the two captures of the flat lattice at rest.
const std::vector<MarkerRow>& flat_rows();
/// Returns the captures of domes, whose columns are locked at different angles.
const std::vector<MarkerRow>& dome_rows();

/// Spacing of the cells before the pull of a corner, mm.
inline constexpr double pull_spacing_mm = 35;
/// Cells per side of the lattice that is pulled at a corner.
inline constexpr int pulled_side = 5;
/// Returns the place of cell (i, j) while the opposite corner of cell (0, 0), which is locked, is pulled. Index
/// pulled_side * i + j. Units of pull_spacing_mm, read to 0.01. Source: the same repository, main_in_2D.py,
/// draw_lattice_with_variable_dot_size.
const std::array<Eigen::Vector2d, pulled_side * pulled_side>& pulled_cells();

}  // namespace kinetix::bench
