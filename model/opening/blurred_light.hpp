#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Derivatives of a number that panels in the plane are read by.
struct PanelGradient {
  Eigen::VectorXd state;  ///< 6 a body: turn about z (rad) at 2, shifts along x and y (cell edges) at 3 and 4
  Eigen::VectorXd t;      ///< by t of each hinge (fraction of the wall), where the bodies stay
  Eigen::VectorXd offset;  ///< likewise by its offset (cell edges), which moves no wall

  explicit PanelGradient(const Linkage& panel);
};

/// The light through a planar panel before a lamp as an eye sees it from a distance, at the middle of every
/// cell: 1 less the shadow of its walls over what the panel covers, both blurred. Dimensionless, 1 where no
/// wall stands near.
///
/// A half wall casts the shadow of a rectangle, whose Gaussian blur is a product of error functions. What the walls
/// of a vertex cover twice counts once: it is taken off as if it were in its middle. The two half walls of a hinge
/// that turns still count twice where one comes to lie over the other, the more the farther the hinge sits beside them;
/// so do walls of other cells. Where walls are thick and cells nearly closed, that makes light negative, which then
/// means no more than that walls lie over each other.
///
/// A cell covers as much as its area in one point does when it is blurred: even to 0.2 % inside panels whose cells are
/// at most 0.85 cell edges apart. Cells of more than four walls are larger, and cover by a point for each of their bodies:
/// even to 4 % on hexagons, bricks and octagons. Cells near the rim have nothing on one side: their shadow counts in
/// proportion to what it is in the flat panel, of which all cells of as many walls are read alike.
class BlurredLight {
 public:
  /// Cell edges, standard deviation of the blur.
  static constexpr double deviation = 0.5;

  /// Both are kept, and have to outlive this.
  BlurredLight(const Linkage& panel, const State& state);

  /// Of each cell, in the order of panel.cells; all NaN where the state is not finite.
  const std::vector<double>& values() const { return light_; }
  /// Adds the derivatives of a function of the values. @param by_value its derivative by each of them
  void add_gradient(const Eigen::VectorXd& by_value, PanelGradient& gradient) const;

 private:
  struct Unscaled {};  ///< marks the constructor that leaves the rim as it is

  /// A half wall in the plane.
  struct Strip {
    Eigen::Vector2d from, along;  ///< cell edges; along: unit
    double length = 0;            ///< cell edges
  };
  struct Blot {
    Eigen::Vector2d middle;  ///< cell edges
    double area = 0;         ///< cell edges squared
  };
  /// Of a cell's area.
  struct Part {
    int cell = 0, body = 0;  ///< it stands between the cell's middle and this body of it
    double out = 0;          ///< where on the way to the body, of that way
    double share = 1;        ///< of the cell's area
    Blot blot;
  };
  struct Reading {
    double shadow = 0, cover = 0;          ///< dimensionless
    std::vector<int> strips, laps, parts;  ///< those that it comes from
  };

  /// Shadow and cover alone.
  BlurredLight(const Linkage& panel, const State& state, Unscaled);
  /// Of a cell as it stands.
  void add_parts(int cell);
  void read();
  void add_strip_gradient(int cell, int strip, double by_shadow, PanelGradient& gradient) const;
  void add_lap_gradient(int cell, int lap, double by_shadow, PanelGradient& gradient) const;
  /// All but what comes through the part's area. @return the derivative by that area, per cell edge squared
  double add_part_gradient(int cell, int part, double by_cover, PanelGradient& gradient) const;
  void add_area(int cell, double by_area, PanelGradient& gradient) const;
  /// Of a function's derivative by the middle of a cell, per cell edge.
  void add_middle(int cell, const Eigen::Vector2d& by_middle, PanelGradient& gradient) const;

  const Linkage& panel_;
  const State& state_;
  double half_thickness_ = 0;  ///< cell edges
  std::vector<Strip> strips_;
  std::vector<Blot> laps_;                ///< of each body, what its walls cover twice
  std::vector<Eigen::Vector2d> middles_;  ///< of each cell, cell edges
  std::vector<Part> parts_;
  std::vector<Reading> readings_;
  std::vector<double> scale_;  ///< of each cell's shadow over its cover
  std::vector<double> light_;
};

}  // namespace kinetix::model
