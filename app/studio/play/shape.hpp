#pragma once

#include <memory>
#include <optional>

#include "app/files/design_file.hpp"
#include "app/studio/play/frame.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/sheet/nearest_design.hpp"
#include "sim/live_sheet.hpp"

namespace kinetix::app::studio {

/// A design with what is known of its motion.
struct Moving {
  explicit Moving(const Design& design);

  model::Linkage linkage;
  model::ExactMotion exact;
  std::optional<model::NearestDesign> nearest;  ///< where it does not move exactly, and one is known
  double least_theta = 0, most_theta = 0;       ///< rad, where no walls touch on the exact way
};

/// theta, rad, within the range, at which the point `at` of a body (rest place, mm) comes nearest to `to` (mm) on the
/// exact way, found from a theta near to it. @pre moving.exact
double nearest_theta(const Moving& moving, double from, int body, const Eigen::Vector3d& at,
                     const Eigen::Vector3d& to);

/// The design's own drive, or else the usual one, as far as theta, rad, in (-pi/2, pi/2).
model::LinkageDrive drive_to(const Design& design, double theta);

/// The design as far as it is shown, for what is made of it: along its closed form by theta alone, whatever drives it,
/// else by its own drive. A flat sheet goes as far as the design says. @param moving of the design
/// @param sheet_theta rad, of the sheet   @param drive_theta rad, of its drive (LinkageDrive::theta)
Design as_far_as_shown(Design design, const Moving& moving, double sheet_theta, double drive_theta);

/// The same for its file, which keeps its drive: that ends where it is shown.
Design saved_as_shown(Design design, const Moving& moving, double sheet_theta, double drive_theta);

/// A design in the engine, ready to be played with, flat. @param springs hinges as elastic as the design says
/// @param linkage of the design; must outlive it
std::unique_ptr<sim::LiveSheet> live_sheet(const Design& design, const model::Linkage& linkage, bool springs);

}  // namespace kinetix::app::studio
