#pragma once

#include <memory>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"
#include "model/contact/hinge_chains.hpp"
#include "model/contact/swept_motion.hpp"

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

}  // namespace kinetix::app
