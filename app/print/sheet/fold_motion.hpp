#pragma once

class btConvexHullShape;

#include "app/print/sheet/print_sheet.hpp"
#include "model/contact/swept_motion.hpp"
#include "model/material/process.hpp"
#include "model/solids/hinge_shape.hpp"

namespace kinetix::app {

/// Body as another one sees it in the middle of an interval, and its motion over the interval.
struct SeenBody {
  model::Pose pose;
  model::SweptMotion motion;
  double margin_mm = 0;  ///< largest deviation from that motion
};

/// Interval of the path to the fold.
class MotionInterval {
 public:
  virtual ~MotionInterval() = default;

  double theta = 0;       ///< in its middle, rad
  double half_width = 0;  ///< rad, or the unit of the path's parameter
  model::State state;     ///< in its middle, mm

  /// Returns a body as the body `from` sees it. @param chain of hinges from one to the other
  virtual SeenBody seen(int from, int body, const model::HingeChain& chain) const = 0;
  /// Returns the motions of all bodies in one common frame, that of the state in the middle.
  virtual std::vector<model::SweptMotion> motions() const = 0;
  /// Returns the largest deviation of any body from its motion in that frame, mm.
  virtual double margin_mm() const = 0;
};

/// Motion of a sheet from flat, parameter 0, to its fold.
class PrintMotion {
 public:
  virtual ~PrintMotion() = default;

  virtual double end() const = 0;
  /// Returns the end of the longest interval from there that may be checked as a whole.
  virtual double next(double from) const = 0;
  virtual double theta(double at) const = 0;  ///< rad
  virtual std::unique_ptr<MotionInterval> over(double low, double high) const = 0;
};

/// Returns the motion by the laws of the hinges if the sheet's motion obeys them: every bound is proven. Otherwise
/// each state of the path moves to the next as a screw with a margin. The margin comes from the error of the screw
/// from the state before to the one after, at the state between. It grows with the square of the step. Jumps have no
/// margin.
/// @param sheet, reach are kept by reference. `reach` is the distance of each body's parts from its rest position, mm
std::unique_ptr<PrintMotion> fold_motion(const PrintSheet& sheet, const std::vector<double>& reach);

/// Returns the largest margin of a path's states, of a body as its neighbours see it, mm. @param linkage of the same
/// size
double sampling_error_mm(const PrintPath& path, const model::Linkage& linkage);

/// Points that move with one body, and a sphere around them, relative to the body's rest position, mm.
struct PieceEnd {
  int body = 0;
  Eigen::Matrix3Xd points;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

/// Convex piece of a part: of a body, or a soft part as the hull of its two ends.
struct PartPiece {
  int part = 0;
  std::vector<PieceEnd> ends;
  std::shared_ptr<btConvexHullShape> hull = {};  ///< of one end, with its support function
};

/// Parts of a sheet that may collide: its bodies, then soft parts by hinge. Rods and cones of pins are within eyes.
/// Eyes count as if they had no bore.
struct MovingParts {
  explicit MovingParts(const PrintSheet& sheet);

  int bodies = 0;
  std::vector<PartPiece> pieces;            ///< part by part
  std::vector<std::vector<int>> pieces_of;  ///< by part; empty for the soft part of a pin
  std::vector<PieceEnd> whole;              ///< all points of each body
};

/// Piece at the places of its ends: a pose for each.
struct PlacedPiece {
  const PartPiece& piece;
  std::vector<const model::Pose*> poses;

  Eigen::Vector3d center() const;
};

/// Nearest points of two pieces, or the deepest if they overlap.
struct PieceDistance {
  double mm = 0;                                     ///< mm, negative: how deep
  Eigen::Vector3d place = Eigen::Vector3d::Zero();   ///< mm, between them
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector from first to second; 0: they touch
};
PieceDistance piece_distance(const PlacedPiece& a, const PlacedPiece& b);

/// Sets how the knuckles of a pin face each other: flat, a clearance apart. Some processes lay lines over gaps that
/// hold none of them, as FDM does. There the faces are cones with a rim as wide as a line. The distance of the cones
/// keeps the pin's clearance between their layers, which step sideways.
/// @param pin with its clearance.   @return the pin with axial_clearance_mm and rim_mm
model::HingePrint with_faces(model::HingePrint pin, const model::Process& process);

/// Returns the least height of a pin, mm. Its eye, between two such clearances, is as high as they are.
/// @param loose whether its rod is a separate part
double min_pin_height_mm(double clearance_mm, const model::Process& process, bool loose);

}  // namespace kinetix::app
