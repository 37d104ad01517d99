#pragma once

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Area that the half walls of a body cover twice at their vertex, in the body's rest frame.
struct WallOverlap {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< from the vertex, cell edges
  double area = 0;                                   ///< cell edges squared
};

/// Returns the overlap for each body of a planar panel. Half walls are rectangles that start at their vertex;
/// the result is exact if they are long enough. Bodies are rigid, so the overlap is constant in their frames.
std::vector<WallOverlap> wall_overlaps(const Linkage& panel);

/// Derivatives of a function of a planar panel.
struct PanelGradient {
  /// 6 per body: turn about z (rad) at 2, shifts along x and y (cell edges) at 3 and 4
  Eigen::VectorXd state;
  Eigen::VectorXd t;       ///< by t of each hinge (fraction of the wall), with the bodies fixed
  Eigen::VectorXd offset;  ///< by the offset of each hinge (cell edges), which moves no wall

  explicit PanelGradient(const Linkage& panel);
};

/// Light through a planar panel in front of a lamp, as seen from a distance, at the middle of every cell. It
/// is 1 minus the shadow of the walls over the cover of the panel, both blurred. Dimensionless, 1 if no wall
/// is near.
///
/// A half wall casts the shadow of a rectangle, whose Gaussian blur is a product of error functions. The
/// overlap of walls at a vertex counts once: it is subtracted as a point at its middle. The two half walls of
/// a turned hinge still count twice where they overlap, and more so for a larger hinge offset. Overlaps with
/// walls of other cells also count twice. If walls are thick and cells nearly closed, the light becomes
/// negative, which only means that walls overlap.
///
/// The cover of a cell is its area, blurred from one point. Inside panels whose cells are at most 0.85 cell
/// edges apart it is uniform to 0.2 %. Larger cells, of more than four walls, use one point per body: uniform
/// to 4 % on hexagons, bricks and octagons. Cells near the boundary have no neighbours on one side. Their
/// shadow is scaled so that all cells with the same number of walls have equal light in the flat panel.
class BlurredLight {
 public:
  /// Standard deviation of the blur, cell edges.
  static constexpr double deviation = 0.5;

  /// Keeps references to both arguments, which must outlive this object.
  BlurredLight(const Linkage& panel, const State& state);

  /// Returns the light of each cell, in the order of panel.cells; all NaN if the state is not finite.
  const std::vector<double>& values() const { return light_; }
  /// Adds the derivatives of a function of the values. @param by_value derivative of the function by each
  /// value
  void add_gradient(const Eigen::VectorXd& by_value, PanelGradient& gradient) const;

 private:
  struct Unscaled {};  ///< selects the constructor without the correction at the boundary

  /// A half wall in the plane.
  struct Strip {
    Eigen::Vector2d from, along;  ///< cell edges; along: unit
    double length = 0;            ///< cell edges
  };
  struct Blot {
    Eigen::Vector2d middle;  ///< cell edges
    double area = 0;         ///< cell edges squared
  };
  /// Part of a cell's area, as a blot.
  struct Part {
    int cell = 0, body = 0;  ///< it is between the middle of the cell and this body of the cell
    double out = 0;          ///< position between middle (0) and body (1), fraction
    double share = 1;        ///< fraction of the cell's area
    Blot blot;
  };
  struct Reading {
    double shadow = 0, cover = 0;          ///< dimensionless
    std::vector<int> strips, laps, parts;  ///< indices of those that contribute
  };

  /// Computes shadow and cover without the scale for the boundary.
  BlurredLight(const Linkage& panel, const State& state, Unscaled);
  /// Adds the parts of a cell's area in the present state.
  void add_parts(int cell);
  void read();
  void add_strip_gradient(int cell, int strip, double by_shadow, PanelGradient& gradient) const;
  void add_lap_gradient(int cell, int lap, double by_shadow, PanelGradient& gradient) const;
  /// Adds all derivatives except those through the part's area. @return derivative by that area, per cell
  /// edge squared
  double add_part_gradient(int cell, int part, double by_cover, PanelGradient& gradient) const;
  void add_area(int cell, double by_area, PanelGradient& gradient) const;
  /// Adds a function's derivative by the middle of a cell, per cell edge.
  void add_middle(int cell, const Eigen::Vector2d& by_middle, PanelGradient& gradient) const;

  const Linkage& panel_;
  const State& state_;
  double half_thickness_ = 0;  ///< cell edges
  std::vector<Strip> strips_;
  std::vector<Blot> laps_;                ///< overlap of the walls of each body
  std::vector<Eigen::Vector2d> middles_;  ///< middle of each cell, cell edges
  std::vector<Part> parts_;
  std::vector<Reading> readings_;
  std::vector<double> scale_;  ///< factor of each cell's shadow over its cover
  std::vector<double> light_;
};

}  // namespace kinetix::model
