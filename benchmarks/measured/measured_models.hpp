#pragma once

#include <string>
#include <vector>

#include "benchmarks/measured/measured_samples.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"
#include "model/material/process.hpp"

/// Comparisons of measured samples with the models of the program, for designs of targets/shapes.
namespace kinetix::bench {

/// Returns the stretch of a sheet of squares along x and y in a state: distance of bodies an even number of cells
/// apart, over their distance at rest.
Eigen::Vector2d bulk_stretch(const model::Lattice& sheet, const model::State& state);

/// Distances of the measured stretches of a sample from the curve of exact motion.
struct StretchDeviation {
  int points = 0;
  double rms = 0, max = 0;              ///< stretch, ratio: to the nearest point of the curve
  double theta_min = 0, theta_max = 0;  ///< rad: range of theta of the nearest points
};

/// Compares a sample with the exact motion of its design, in states of theta from -50 to 50 degrees.
StretchDeviation compare_stretch(const StretchSample& sample);

/// Lattice of crosses on pins: a design of one layer, with its pins and the print errors of its process.
struct PinLattice {
  model::Lattice sheet;
  model::ManufacturedHinge pin;
  model::PrintError sd;

  double arm_mm() const { return sheet.size().edge_mm / 2; }
};

/// Reads the design pin_lattice.yaml.
PinLattice read_pin_lattice();

/// Distances of the spacings of a row from the exact motion with one theta for all cells.
struct SpacingDeviation {
  double theta = 0;  ///< rad: exact spacing is the mean of the row
  double rms = 0;    ///< mm: standard deviation of the spacings (n - 1)
};
SpacingDeviation compare_spacings(const PinLattice& lattice, const MarkerRow& row);

/// Returns the standard deviation of a spacing that prints have at rest, mm. Each step has two pins, which rest anywhere
/// within their clearance, and three bores, which are out of place by the error of the process.
double spacing_scatter_mm(const PinLattice& lattice);
/// Returns the largest spacing, mm: open crosses, and the clearance of two pins per step.
double max_spacing_mm(const PinLattice& lattice);
/// Returns the smallest spacing, mm: end of the range of theta that is proven free of contact, less the clearance of two
/// pins per step.
double min_spacing_mm(const PinLattice& lattice);
/// Returns the standard deviation of the clearance of two pins, mm.
double two_clearances_sd_mm(const PinLattice& lattice);

/// Returns the standard deviation of the bend per step at rest, degrees: two pins lean at random.
double bend_scatter_deg(const PinLattice& lattice);
/// Returns the largest bend per step, degrees: two pins lean as far as their clearance allows.
/// @param more_mm added to the clearance
double max_bend_deg(const PinLattice& lattice, double more_mm = 0);

/// Returns the root mean square of the bends of a row, degrees.
double rms_bend_deg(const MarkerRow& row);
/// Returns the largest mean of three adjacent bends of a dome, degrees. Single bends alternate, because the crosses with
/// markers are in turn above and below their neighbours.
double dome_bend_deg(const MarkerRow& row);

}  // namespace kinetix::bench
