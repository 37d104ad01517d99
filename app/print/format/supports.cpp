#include "app/print/format/print_format.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace kinetix::app {
namespace {

constexpr double shown_area_mm2 = 0.05;  // mm^2: less is shown as 0.0
constexpr double steep_margin = 1e-6;    // of the cosine: axes at the limit do not depend on rounding

/// Room of a pin's knuckles: a cylinder about its axis.
struct PinRoom {
  Eigen::Vector3d point, axis;  // mm; unit vector
  double radius_mm;

  bool contains(const Eigen::Vector3d& p) const { return (p - point).cross(axis).norm() <= radius_mm; }
};

/// Returns the radius in which knuckles face each other, mm. The other plate begins one clearance outside them, and its
/// corners are up to the root of 2 times as far away.
double room_radius_mm(const model::HingePrint& pin) {
  const double knuckle =
      pin.made.diameter_mm / 2 + pin.made.clearance_mm + pin.knuckle_wall_mm + pin.cap_across_mm;
  return std::sqrt(2.0) * (knuckle + gap_mm(pin));
}

/// Returns the rooms of the pins of each body as the job lies.
std::vector<std::vector<PinRoom>> pin_rooms(const PrintJob& job) {
  const PrintSheet& sheet = job.sheet;
  const double upright = std::cos(steep_deg * radians_per_degree) - steep_margin;
  std::vector<std::vector<PinRoom>> rooms(sheet.meshes.size());
  for (std::size_t h = 0; h < sheet.hinges.size(); ++h) {
    if (!is_pin(sheet.hinges[h].made.kind)) continue;
    const model::RestHinge& hinge = sheet.linkage.hinges[h];
    for (const bool is_lower : {true, false}) {
      const int body = is_lower ? hinge.lower : hinge.upper;
      const model::Pose& pose = job.state()[body];
      const Eigen::Vector3d axis = pose.R * hinge.axis,
                            arm = pose.R * (is_lower ? hinge.lower_arm : hinge.upper_arm);
      if (std::abs(axis.z()) >= upright)
        rooms[body].push_back(
            {pose.p + sheet.linkage.size.edge_mm * arm, axis, room_radius_mm(sheet.hinges[h])});
    }
  }
  return rooms;
}

/// Returns all parts without the faces in rooms of pins. All points stay, so that the bed is at the same height.
model::Polyhedron without_pins(const PrintJob& job) {
  const std::vector<std::vector<PinRoom>> rooms = pin_rooms(job);
  model::Polyhedron all;
  for (std::size_t b = 0; b < rooms.size(); ++b) {
    model::Polyhedron mesh = placed(job.sheet.meshes[b], job.state()[b]);
    std::erase_if(mesh.triangles, [&](const auto& triangle) {
      return std::any_of(rooms[b].begin(), rooms[b].end(), [&](const PinRoom& room) {
        return std::all_of(triangle.begin(), triangle.end(),
                           [&](int corner) { return room.contains(mesh.points[corner]); });
      });
    });
    append(mesh, all);
  }
  return joined(rounded_for_file(std::move(all)), soft_part(job));
}

}  // namespace

SupportPlan plan_supports(const PrintJob& job) {
  const Eigen::Matrix3d as_it_lies = Eigen::Matrix3d::Identity();
  SupportPlan plan;
  plan.overhang_mm2 = overhang_mm2(joined(hard_part(job), soft_part(job)), as_it_lies);
  const double outside = overhang_mm2(without_pins(job), as_it_lies);
  plan.within_pins_mm2 = std::max(0.0, plan.overhang_mm2 - outside);
  plan.is_needed = job.sheet.process.carries.empty() && outside >= shown_area_mm2;
  return plan;
}

std::string describe_supports(const PrintJob& job) {
  const SupportPlan plan = plan_supports(job);
  if (plan.overhang_mm2 < shown_area_mm2) return "none";
  if (const std::string& carries = job.sheet.process.carries; !carries.empty())
    return fmt::format("none to plan: {} carries the {:.1f} mm2 that lean", carries, plan.overhang_mm2);
  const std::string bridges = fmt::format(
      "the {:.1f} mm2 between the knuckles of pins bridge their gaps, and supports there could "
      "not be removed",
      plan.within_pins_mm2);
  if (!plan.is_needed) return "none: " + bridges;
  const std::string outside =
      fmt::format("under the {:.1f} mm2 that lean more than {:g} degrees over the bed",
                  plan.overhang_mm2 - plan.within_pins_mm2, steep_deg);
  return plan.within_pins_mm2 < shown_area_mm2 ? outside : outside + "; " + bridges;
}

}  // namespace kinetix::app
