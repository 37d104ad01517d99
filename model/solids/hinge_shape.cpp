#include "model/solids/hinge_shape.hpp"

#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using Outline = std::vector<Vector2d>;

constexpr int min_sides = 12;           // sides of a circle: fewer do not look round
constexpr double one_corner_mm = 1e-6;  // mm: corners nearer than that are one
constexpr double step_mm = 1e-3;  // mm: lower steps are ignored, because files store positions as floats.
// Share of the eye in a pin's height. The fork's two knuckles share the rest, so that each end of the rod
// bears half as much as its middle.
constexpr double eye_share = 0.5;
constexpr double sink_share = 0.5;  // depth of a cone over half the eye's height: as much bore remains

Outline circle(const Vector2d& center, double radius, int sides) {
  Outline points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * pi * k / sides;
    points.push_back(center + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// Returns the hull of points, counter-clockwise (Andrew's monotone chain).
Outline hull(Outline points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Outline out;
  const auto add = [&](const Vector2d& p, std::size_t first) {
    while (out.size() >= first + 2 && cross(out.back() - out[out.size() - 2], p - out.back()) <= 0)
      out.pop_back();
    out.push_back(p);
  };
  for (const Vector2d& p : points) add(p, 0);
  const std::size_t lower = out.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  out.pop_back();
  return out;
}

/// Returns the point where a ray from inside leaves a convex polygon.
Vector2d leaves(const Outline& polygon, const Vector2d& from, const Vector2d& towards) {
  double nearest = INFINITY;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d &a = polygon[k], side = polygon[(k + 1) % polygon.size()] - a;
    const double outwards = cross(towards, side);
    if (outwards > 0) nearest = std::min(nearest, cross(a - from, side) / outwards);
  }
  return from + nearest * towards;
}

/// Returns the hull of knuckle and wall end, with a corner at each angle about the axis where rod and bore have one.
Outline knuckle_section(double wall_end, double half_wall, double axis_across, double knuckle_across,
                        double radius, int sides) {
  const Vector2d axis(0, axis_across), low(-wall_end, -half_wall), high(-wall_end, half_wall);
  Outline corners = circle({0, knuckle_across}, radius, sides);
  corners.push_back(low);
  corners.push_back(high);
  const Outline around = hull(corners);
  Outline out{low};
  const auto angle_of = [&](const Vector2d& p) {
    const Vector2d d = p - axis;
    return std::atan2(d.y(), d.x());
  };
  // The wall's end is to the left of the axis. If the axis is beyond the wall's face, both corners are on one side.
  double first = angle_of(low), last = angle_of(high);
  if (first > 0) first -= 2 * pi;
  if (last < 0) last += 2 * pi;
  for (int k = -sides; k <= sides; ++k) {
    const double angle = 2 * pi * k / sides;
    if (!(angle > first && angle < last)) continue;
    const Vector2d p = leaves(around, axis, {std::cos(angle), std::sin(angle)});
    if ((p - low).norm() > one_corner_mm && (p - high).norm() > one_corner_mm) out.push_back(p);
  }
  out.push_back(high);
  return out;
}

/// Returns the sides of rod and bore, and of the knuckle seen from an axis off its middle, where corners are farther
/// apart.
int pin_sides(const HingePrint& hinge) {
  const double radius = hinge.made.diameter_mm / 2 + hinge.made.clearance_mm + hinge.knuckle_wall_mm +
                        hinge.cap_across_mm,
               furthest = radius + hinge.cap_across_mm;
  return circle_sides(furthest * furthest / radius, hinge.tolerance_mm);
}

/// Adds cones if there is room for them inside the rim. @param eye half its height, mm
void add_cones(const HingePrint& hinge, bool fork, double eye, HingeEnd& end) {
  const double rod = hinge.made.diameter_mm / 2, bore = rod + hinge.made.clearance_mm,
               radius = bore + std::min(hinge.knuckle_wall_mm - hinge.rim_mm, sink_share * eye / cone_rise);
  if (!(radius > bore + step_mm)) return;
  const int sides = pin_sides(hinge);
  end.rim_radius = radius;
  end.rim = circle({0, end.axis_across}, fork ? radius : radius / std::cos(pi / sides), sides);
  end.cone = cone_rise * (radius - (fork ? rod : bore));
}

}  // namespace

int circle_sides(double radius_mm, double tolerance_mm) {
  const double half = std::acos(std::max(0.0, 1 - tolerance_mm / radius_mm));
  const int fours = static_cast<int>(std::ceil(pi / half / 4));
  return std::max(min_sides, 4 * fours);
}

double corner_room(double half_wall, double axis_across, double turn) {
  const double lever = half_wall - std::copysign(axis_across, axis_across * turn);
  return std::max(0.0, lever) * std::tan(std::abs(turn) / 2);
}

HingeEnd pin_end(const HingePrint& hinge, const CellSize& size, double axis_across, bool fork) {
  const ManufacturedHinge& p = hinge.made;
  const bool is_cap = hinge.cap_across_mm > 0;
  const double beside = is_cap ? std::max(hinge.cap_across_mm, std::abs(axis_across)) : 0,
               widest = is_cap ? std::copysign(beside, -hinge.turn) : axis_across;
  const double rod = p.diameter_mm / 2, half_wall = size.thickness_mm / 2,
               radius = rod + p.clearance_mm + hinge.knuckle_wall_mm + beside,
               swept = radius + beside * std::sin(std::min(std::abs(hinge.turn), pi / 2)),
               corners = corner_room(half_wall, widest, hinge.turn);
  const int sides = pin_sides(hinge);
  HingeEnd end;
  end.wall_end = std::max(swept, corners) + gap_mm(hinge);
  end.axis_across = axis_across;
  end.knuckle_across = is_cap ? 0 : axis_across;
  end.knuckle_radius = radius;
  end.section = knuckle_section(end.wall_end, half_wall, axis_across, end.knuckle_across, radius, sides);
  const double half = p.height_mm / 2, eye = eye_share * (half - hinge.axial_clearance_mm);
  const Vector2d axis(0, axis_across);
  if (fork) {
    end.lugs = {{-half, -eye - hinge.axial_clearance_mm}, {eye + hinge.axial_clearance_mm, half}};
    if (hinge.loose) {
      end.bore_radius = rod;
      end.bore = circle(axis, rod / std::cos(pi / sides), sides);
    } else {
      end.rod = circle(axis, rod, sides);
      end.rod_radius = rod;
    }
  } else {
    end.lugs = {{-eye, eye}};
    end.bore_radius = rod + p.clearance_mm;
    end.bore = circle(axis, end.bore_radius / std::cos(pi / sides), sides);
  }
  if (hinge.rim_mm > 0 && !hinge.loose) add_cones(hinge, fork, eye, end);
  return end;
}

HingeEnd block_end(const HingePrint& hinge, const CellSize& size, double axis_across) {
  const double half_wall = size.thickness_mm / 2, half_gap = hinge.made.gap_mm / 2,
               low = axis_across - hinge.made.thickness_mm / 2,
               high = axis_across + hinge.made.thickness_mm / 2;
  const double beyond = std::max({0.0, high - half_wall, -half_wall - low});
  HingeEnd end;
  end.wall_end = half_gap;
  end.axis_across = axis_across;
  if (!(beyond > step_mm)) return end;
  const bool is_flat = beyond <= size.thickness_mm + step_mm;
  const double deep = is_flat ? beyond : size.thickness_mm, upright = beyond - deep;
  end.wall_end = half_gap + deep;
  end.section = {{-end.wall_end, -half_wall}};
  if (upright > 0 && low < -half_wall) end.section.emplace_back(-end.wall_end, -half_wall - upright);
  end.section.emplace_back(-half_gap, std::min(low, -half_wall));
  end.section.emplace_back(-half_gap, std::max(high, half_wall));
  if (upright > 0 && high > half_wall) end.section.emplace_back(-end.wall_end, half_wall + upright);
  end.section.emplace_back(-end.wall_end, half_wall);
  end.lugs = {{-size.height_mm / 2, size.height_mm / 2}};
  return end;
}

std::vector<Vector2d> rod_section(const HingePrint& hinge) {
  return circle(Vector2d::Zero(), hinge.made.diameter_mm / 2, pin_sides(hinge));
}

HingeEnd hinge_end(const HingePrint& hinge, const CellSize& size, double axis_across, bool fork) {
  return is_pin(hinge.made.kind) ? pin_end(hinge, size, axis_across, fork)
                                 : block_end(hinge, size, axis_across);
}

namespace {

// Length of a block over its thickness: below it no stiffness formula is valid
constexpr double slender = 1.25;
constexpr double more_room = 1.1;  // ratio to the length at which the corners of a wall would meet
constexpr double film_mm = 0.4;  // thickness of a film: one nozzle line; strain 0.1 over 3 mm and 90 degrees
constexpr double widest_turn = 2.8;           // rad: at half a turn corners meet for any gap
constexpr double tenth = 10;                  // gaps are whole tenths of a mm
constexpr const char* rod_material = "pa12";  // material of printed rods
// Clearance of a separate rod in standard deviations of printed clearances: 97 of 100 bores are open.
constexpr double bore_deviations = 2;
constexpr const char* wire_material = "steel";  // material of separate rods
constexpr const char* strip_material = "pp";    // material of films that are separate prints

}  // namespace

ManufacturedHinge open_hinge(HingeKind kind, const Process& process, const CellSize& size) {
  ManufacturedHinge hinge;
  hinge.kind = kind;
  hinge.height_mm = size.height_mm;
  if (is_pin(kind)) {
    const bool is_wire = kind == HingeKind::rod;
    hinge.material = *find_material(is_wire ? wire_material : rod_material);
    hinge.diameter_mm = is_wire ? usual_rod_mm : process.min_pin_mm;
    hinge.clearance_mm = is_wire ? std::min(bore_deviations * process.sd.clearance_mm, process.clearance_mm)
                                 : process.clearance_mm;
    return hinge;
  }
  const bool film = kind == HingeKind::film;
  hinge.material = *find_material(!film                  ? process.rubber
                                  : process.film.empty() ? strip_material
                                                         : process.film);
  const double thin_mm = std::max(film_mm, process.min_film_mm);
  hinge.thickness_mm = film ? std::min(thin_mm, size.thickness_mm) : size.thickness_mm;
  return hinge;
}

double open_gap_mm(const ManufacturedHinge& hinge, double wall_mm, double offset_mm, double turn,
                   double stretch_mm) {
  const double bounded = std::clamp(turn, -widest_turn, widest_turn),
               half = std::max(corner_room(wall_mm / 2, offset_mm, bounded),
                               corner_room(hinge.thickness_mm / 2, 0, bounded)),
               corners = more_room * (2 * half + stretch_mm),
               strain = (std::abs(turn) * hinge.thickness_mm / 2 + stretch_mm) / hinge.material.strain_max;
  return std::ceil(tenth * std::max({slender * hinge.thickness_mm, corners, strain})) / tenth;
}

}  // namespace kinetix::model
