#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace kinetix::app::cad {

/// A solid of flat faces.
struct Faceted {
  std::vector<Eigen::Vector3d> points;  ///< mm
  std::vector<std::vector<int>> faces;  ///< corners of each face, counter-clockwise from outside
};

/// A full circle; counter-clockwise about the axis, from the direction `first` on.
struct Circle {
  Eigen::Vector3d centre;  ///< mm
  Eigen::Vector3d axis;    ///< of unit length
  Eigen::Vector3d first;   ///< of unit length, across the axis
  double radius = 0;       ///< mm, above 0
};

/// One step of a contour: straight, or the arc through a point.
struct ContourStep {
  Eigen::Vector3d to;                      ///< mm
  std::optional<Eigen::Vector3d> through;  ///< mm; none: straight
};

/// Closed planar contour. The last edge ends at the start.
struct Contour {
  Eigen::Vector3d start;  ///< mm
  std::vector<ContourStep> edges;
};

/// A cone without its tip.
struct Frustum {
  Circle base;            ///< its axis points into the cone
  double end_radius = 0;  ///< mm, above 0
  double along = 0;       ///< from the base to the other end, mm, above 0
};

/// Solid that a flat face sweeps along a vector.
struct Prism {
  std::variant<Contour, Circle> base;
  std::optional<Circle> hole;       ///< in the plane of the base
  Eigen::Vector3d along;            ///< mm
  std::vector<Frustum> sinks = {};  ///< cones that are cut out
};

using Piece = std::variant<Faceted, Prism, Frustum>;

/// One solid of pieces that share faces or parts of faces.
struct Shape {
  std::string name;
  std::array<double, 3> colour;  ///< red, green, blue of the screen, 0 to 1
  std::vector<Piece> pieces;     ///< at least one
};

/// A shape at its place.
struct Part {
  std::string name;
  int shape = 0;  ///< index into Product::shapes
  Eigen::Isometry3d where = Eigen::Isometry3d::Identity();
};

/// Parts of a CAD file. Several parts may share one shape.
struct Product {
  std::string name;
  std::vector<Shape> shapes;
  std::vector<Part> parts;
};

}  // namespace kinetix::app::cad

// Interface of kinetix-cad.so: see app/cad/cad_formats.hpp.

extern "C" void kinetix_write_step(const kinetix::app::cad::Product& product, std::string& text);
