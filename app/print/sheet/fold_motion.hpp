#pragma once

class btConvexHullShape;

#include <memory>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"
#include "model/contact/hinge_chains.hpp"
#include "model/contact/swept_motion.hpp"
#include "model/matter/process.hpp"
#include "model/solids/hinge_shape.hpp"

namespace kinetix::app {

/// A body as another one sees it in the middle of an interval, and how it moves over all of it.
struct SeenBody {
  model::Pose pose;
  model::SweptMotion motion;
  double margin_mm = 0;  ///< by which it may be elsewhere
};

/// A stretch of the path to the fold.
class MotionInterval {
 public:
  virtual ~MotionInterval() = default;

  double theta = 0;       ///< of its middle, rad
  double half_width = 0;  ///< rad, or the unit of the path's parameter
  model::State state;     ///< in its middle, mm

  /// @param chain from the one to the other
  virtual SeenBody seen(int from, int body, const model::HingeChain& chain) const = 0;
  /// Of all bodies in one common frame, which is at the state in the middle.
  virtual std::vector<model::SweptMotion> motions() const = 0;
  /// By which any body may be elsewhere in that frame, mm.
  virtual double margin_mm() const = 0;
};

/// How a sheet comes from flat, parameter 0, to its fold.
class PrintMotion {
 public:
  virtual ~PrintMotion() = default;

  virtual double end() const = 0;
  /// Where a stretch from there ends that may be looked at as a whole.
  virtual double next(double from) const = 0;
  virtual double theta(double at) const = 0;  ///< rad
  virtual std::unique_ptr<MotionInterval> over(double low, double high) const = 0;
};

/// By the laws of its hinges where the sheet's motion keeps them: every bound is proven. Elsewhere from each state of the path to
/// the next as a screw, which a margin goes with: the largest error of the screw from the state before to the one after, at the
/// state between them, grows with the square of the step. Jumps have no margin.
/// @param sheet, reach (of each body's parts from its rest position, mm) kept by reference
std::unique_ptr<PrintMotion> fold_motion(const PrintSheet& sheet, const std::vector<double>& reach);

/// The largest of these margins of a path's states, of a body as its neighbours see it, mm. @param linkage of the same size
double sampling_error_mm(const PrintPath& path, const model::Linkage& linkage);

/// Points that go with one body, and a sphere round them, relative to the body's rest position, mm.
struct PieceEnd {
  int body = 0;
  Eigen::Matrix3Xd points;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

/// A convex piece of a part: of a body, or a block or film as the hull of its two ends.
struct PartPiece {
  int part = 0;
  std::vector<PieceEnd> ends;
  std::shared_ptr<btConvexHullShape> hull = {};  ///< of one end, with its support function
};

/// The parts of a sheet that may run into each other: its bodies, then blocks and films by hinge. Rods and cones of pins
/// are within eyes, which count as if they had no bore.
struct MovingParts {
  explicit MovingParts(const PrintSheet& sheet);

  int bodies = 0;
  std::vector<PartPiece> pieces;            ///< part by part
  std::vector<std::vector<int>> pieces_of;  ///< each part; empty of the soft part of a pin
  std::vector<PieceEnd> whole;              ///< of each body, all of its points
};

/// A piece where it is seen: a pose for each of its ends.
struct PlacedPiece {
  const PartPiece& piece;
  std::vector<const model::Pose*> poses;

  Eigen::Vector3d center() const;
};

/// The nearest points of two pieces; where they are in each other, the deepest.
struct PieceDistance {
  double mm = 0;                                    ///< mm, negative: how deep
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< mm, between them
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  ///< unit vector from the first to the second; 0: they touch
};
PieceDistance piece_distance(const PlacedPiece& a, const PlacedPiece& b);

/// How the knuckles of a pin stand over each other: flat a clearance apart, or where a process lays lines over gaps that
/// hold none of them, as FDM does, inclined but for a rim as wide as a line. Cones are that far apart that their layers,
/// which step sideways, keep the pin's clearance.
/// @param pin with its clearance   @return with axial_clearance_mm and rim_mm
model::HingePrint with_faces(model::HingePrint pin, const model::Process& process);

/// The least height of a pin whose eye, between two such clearances, is as high as they are. mm
double least_pin_height_mm(double clearance_mm, const model::Process& process);

}  // namespace kinetix::app
