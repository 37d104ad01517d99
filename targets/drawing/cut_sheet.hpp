#pragma once

#include "model/lattice/planar/planar_graph.hpp"
#include "model/solids/prism.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::targets {

/// Place where two pieces of a cut sheet hang together: a bridge, or a crease.
struct SheetJoint {
  int lower = 0, upper = 0;  ///< pieces, lower < upper
  Eigen::Vector2d from, to;  ///< ends of a bridge across its width as drawn, or of a crease, mm
  bool is_crease = false;

  double length() const { return (to - from).norm(); }
};

/// Sheet with cuts, taken apart at its bridges and creases.
struct CutSheet {
  std::vector<DrawnLine>
      lines;  ///< cuts, creases and the outline, split where they meet, the outline last, mm
  /// Outline of each piece counter-clockwise, then its holes clockwise, mm. From below, and from the left in a row
  std::vector<std::vector<model::FlatRing>> pieces;
  std::vector<SheetJoint> joints;  ///< in the order of their pieces
  double bridge_mm = 0;            ///< largest gap that counts as a bridge
  double join_mm = 0;              ///< distance in which ends were joined
  bool is_outlined = true;  ///< false: no line of the drawing encloses all others, and a rectangle does
  int loose = 0;            ///< pieces that hang on none of the others, and are left out
};

/// Returns the part of a sheet that bends between two pieces: a polygon round the middle of a bridge, about which they turn
/// by up to 90 degrees without meeting. It ends at the cuts. @param from, to ends of the bridge as drawn, mm
/// @param kerf_mm width of the cuts; 0: up to their middle
model::FlatRing bridge_outline(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double kerf_mm);

struct CutSettings {
  double kerf_mm = 0.2;                  ///< width of the cuts, > 0
  std::optional<double> bridge_mm = {};  ///< largest gap of a bridge; empty: half of the median cut
  std::optional<double> join_mm = {};    ///< as DrawingSettings::join_mm
};

/// Whether a line is a crease. Drawings with a line in #00ff00 have the colours of Origami Simulator: cuts are green,
/// creases red, blue or magenta, and yellow lines have no effect.
bool is_crease(const DrawnLine& line, bool has_green_cuts);
bool has_green_cuts(const std::vector<DrawnLine>& lines);

/// Takes a sheet apart. Cuts are as wide as the kerf, with their middle on the lines. Bridges of find_bridges() and
/// creases separate pieces. The largest group of pieces that hang together remains.
/// @param lines mm
/// @throws InvalidInput without a place for sheets of one piece, sheets cut into loose pieces, and bridges narrower
/// than the kerf. Sheets larger than 20 m also throw
CutSheet make_cut_sheet(std::vector<DrawnLine> lines, const CutSettings& settings);

/// Narrow place of a sheet between the tip of a cut and another cut, the outline, or the same cut farther on.
struct SheetBridge {
  Eigen::Vector2d from, to;  ///< tip and the nearest point ahead of it, in the unit of the graph

  double gap() const { return (to - from).norm(); }
};

/// Returns half of the median cut. A cut is a group of connected lines inside the sheet. A closed one, such as a slot,
/// is half as long as its outline.
/// @throws InvalidInput if there are no cuts inside the sheet
double default_bridge(const model::PlanarGraph& cuts, const std::vector<bool>& is_rim);

/// Finds the bridges between cuts. A tip is an open end, or a corner, crossbar or round end whose cut stays behind it.
/// The bridge of an open end reaches to the nearest point within 75 degrees of the direction of its cut.
/// @param cuts graph of all cuts and the outline   @param widest largest gap of a bridge, > 0.
/// @param is_rim for each edge, whether it is on the outline, which has no tips.
/// @param ends_in_crease for each vertex, whether a crease begins there, so that it needs no bridge
/// @throws InvalidInput without a place for drawings with too many lines near each other
std::vector<SheetBridge> find_bridges(const model::PlanarGraph& cuts, double widest,
                                      const std::vector<bool>& is_rim,
                                      const std::vector<bool>& ends_in_crease);

}  // namespace kinetix::targets
