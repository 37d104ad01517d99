#include "sim/physics_options.hpp"

#include <fmt/format.h>
#include <limits>

#include "model/base/invalid_input.hpp"

namespace kinetix::sim {
namespace {

// Marks values without an upper limit: any finite number, in any unit, is allowed.
constexpr double no_limit = std::numeric_limits<double>::max();
constexpr double max_steps = 1e7;  // time steps: a mistyped step_s gives a message instead of an endless run

void positive(const char* field, double value, double largest = no_limit) {
  if (value > 0 && value <= largest) return;
  const auto range = largest < no_limit ? fmt::format("in (0, {}]", largest) : "positive and finite";
  throw InvalidInput(fmt::format("physics.{} is {}, must be {}", field, value, range));
}

void not_negative(const char* field, double value, double largest) {
  if (value >= 0 && value <= largest) return;
  throw InvalidInput(fmt::format("physics.{} is {}, must be in [0, {}]", field, value, largest));
}

void check(const model::Stiffness& elastic) {
  positive("elastic.turn", elastic.turn);
  positive("elastic.reach", elastic.reach, 10);
  positive("elastic.contact", elastic.contact);
  positive("elastic.ratios.axial", elastic.ratios.axial);
  positive("elastic.ratios.shear", elastic.ratios.shear);
  positive("elastic.ratios.along", elastic.ratios.along);
  if (elastic.tilt.rock) positive("elastic.tilt.rock", *elastic.tilt.rock);
  if (elastic.tilt.twist) positive("elastic.tilt.twist", *elastic.tilt.twist);
  not_negative("elastic.play", elastic.play, elastic.reach);
}

}  // namespace

void PhysicsOptions::validate() const {
  positive("step_s", step_s, 0.1);
  positive("joint_stiffness", joint_stiffness, 1e12);
  positive("reach", reach, 10);
  positive("part_inertia", part_inertia, 100);
  not_negative("disturbance", disturbance, 1);
  positive("drive_seconds", drive_seconds, 1000);
  not_negative("settle_seconds", settle_seconds, 1000);
  not_negative("settle_unrest", settle_residual_motion, 0.1);
  not_negative("settle_damping", settle_damping, 1e6);
  const double steps = (drive_seconds + settle_seconds) / step_s;
  if (!(steps <= max_steps))
    throw InvalidInput(fmt::format("physics.step_s is {}: {:.3g} s in such steps are more than 10 million",
                                   step_s, drive_seconds + settle_seconds));
  positive("settle_speed", settle_speed);
  if (elastic) {
    check(*elastic);
    for (const model::Stiffness& hinge : elastic->each) check(hinge);
  }
  not_negative("spring_turn", spring_turn, no_limit);
  positive("settle_force", settle_force);
  positive("stretch_limit", stretch_limit);
  positive("gap_limit", gap_limit);
  positive("tear_limit", tear_limit);
  positive("overlap_limit", overlap_limit);
  positive("speed_limit", speed_limit);
}

}  // namespace kinetix::sim
