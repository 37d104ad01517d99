#include "app/design_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/closure_drive.hpp"
#include "model/invalid_input.hpp"
#include "model/net_grip.hpp"

namespace kinetix {
namespace {

constexpr double settle_unrest = 0.01;

constexpr int scan_steps = 900;
constexpr double widest = 89.9 * radians_per_degree;

/// What the drive prescribes, as a structure in a state has it, minus what is asked.
class DriveMiss {
 public:
  DriveMiss(const Drive& drive, const Classification& family, const Structure& structure)
      : drive_(drive), family_(family), structure_(structure) {
    if (drive.kind == Drive::Kind::hinge) hinge_ = *structure.hinge_at(drive.wall);
    const auto along = [&](Vertex v) { return drive_.axis == Axis::x ? v.i : v.j; };
    for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
      if (along(structure.bodies[b]) < along(structure.bodies[first_])) first_ = static_cast<int>(b);
      if (along(structure.bodies[b]) > along(structure.bodies[last_])) last_ = static_cast<int>(b);
    }
  }

  double operator()(double theta) const {
    const State state = fold(family_, structure_, theta);
    if (drive_.kind == Drive::Kind::hinge) return hinge_turn(structure_, state, hinge_) - drive_.angle;
    const int d = drive_.axis == Axis::x ? 0 : 1;
    const double rest = structure_.rest_position(last_)[d] - structure_.rest_position(first_)[d];
    return 1 - (state[last_].p[d] - state[first_].p[d]) / rest - drive_.compression;
  }

 private:
  const Drive& drive_;
  const Classification& family_;
  const Structure& structure_;
  int hinge_ = 0, first_ = 0, last_ = 0;
};

double bisect(const DriveMiss& miss, double a, double b) {
  const bool rising = miss(b) > 0;
  for (int k = 0; k < 80; ++k) {
    const double middle = (a + b) / 2;
    ((miss(middle) > 0) == rising ? b : a) = middle;
  }
  return (a + b) / 2;
}

/// Between plates normal to the direction in which it bends, a sheet can roll: its theta is not determined.
void refuse_plates_that_tilt(const Drive& drive, const Classification& family) {
  const Axis bends_along = family.transposed ? Axis::y : Axis::x;
  if (drive.kind != Drive::Kind::plates || family.family == Family::F1 || drive.axis != bends_along) return;
  throw InvalidInput(
      fmt::format("this sheet bends along {0} and would roll between plates normal to {0}; allowed: {1}, "
                  "or kind: hinge",
                  bends_along == Axis::x ? "x" : "y", bends_along == Axis::x ? "y" : "x"),
      {"", 0, 0, "drive.axis"});
}

}  // namespace

Drive drive_of(const DesignFile& design) {
  if (!design.drive) return drive_to(design.structure, design.theta);
  Drive drive;
  const bool plates = design.drive->kind == DriveSection::Kind::plates;
  drive.kind = plates ? Drive::Kind::plates : Drive::Kind::hinge;
  drive.axis = design.drive->axis;
  drive.compression = design.drive->compression;
  drive.branch = design.drive->branch.value_or(design.theta < 0 ? -1 : 1);
  drive.grip = design.drive->grip;
  drive.wall = design.drive->wall;
  drive.angle = design.drive->angle;
  return drive;
}

double theta_of(const Drive& drive, const Classification& family, const Structure& structure) {
  const bool plates = drive.kind == Drive::Kind::plates;
  if (plates && (drive.grip || family.family == Family::F4)) {
    require_kept_rows(structure, family, drive.axis, drive.grip);
    return drive.theta();
  }
  refuse_plates_that_tilt(drive, family);
  const DriveMiss miss(drive, family, structure);
  const bool backwards = plates ? drive.branch < 0 : drive.theta() < 0;
  const double step = (backwards ? -widest : widest) / scan_steps;
  double before = miss(0);
  if (before == 0) return 0;
  for (int k = 1; k <= scan_steps; ++k) {
    const double now = miss(k * step);
    if (now == 0 || (now > 0) != (before > 0)) return bisect(miss, (k - 1) * step, k * step);
    before = now;
  }
  throw InvalidInput(
      fmt::format("drive: no theta up to {:.1f} deg gives this structure what the drive asks for",
                  widest / radians_per_degree));
}

Elasticity elasticity_of(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm) {
  if (!(hinge.k_turn > 0))
    throw InvalidInput("0 is out of range for the elastic model; allowed: a number above 0, in N mm/rad",
                       {"", 0, 0, "hinge.k_turn"});
  return {.k_point = hinge.k_point,
          .k_turn = hinge.k_turn,
          .reach_mm = hinge.reach_mm.value_or(physics_options(physics, edge_mm).reach * edge_mm),
          .k_contact = hinge.k_contact.value_or(10 * hinge.k_point)};
}

PhysicsOptions elastic_physics(const Elasticity& elasticity, const PhysicsSection& section, double edge_mm,
                               bool planar) {
  PhysicsOptions options = physics_options(section, edge_mm);
  options.elastic = relative(elasticity, edge_mm);
  options.reach = options.elastic->reach;
  options.planar = planar;
  options.settle_unrest = settle_unrest;
  return options;
}

PhysicsOptions physics_options(const PhysicsSection& section, double edge_mm) {
  PhysicsOptions options;
  options.solver = section.solver.value_or(options.solver);
  options.step_s = section.step_s.value_or(options.step_s);
  options.iterations = section.iterations.value_or(options.iterations);
  options.error_reduction = section.error_reduction.value_or(options.error_reduction);
  if (section.reach_mm) options.reach = *section.reach_mm / edge_mm;
  return options;
}

Elasticity elasticity_of(const DesignFile& design) {
  return elasticity_of(design.hinge, design.physics, design.structure.size.edge_mm);
}

PhysicsOptions physics_of(const DesignFile& design, bool planar) {
  const double edge = design.structure.size.edge_mm;
  if (design.hinge.model == HingeSection::Model::elastic)
    return elastic_physics(elasticity_of(design), design.physics, edge, planar);
  PhysicsOptions physics = physics_options(design.physics, edge);
  if (design.hinge.reach_mm) physics.reach = *design.hinge.reach_mm / edge;
  return physics;
}

}  // namespace kinetix
