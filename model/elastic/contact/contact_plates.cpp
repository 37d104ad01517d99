#include "model/elastic/contact/contact_plates.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Limit of points along top or bottom of a half wall, on one side.
constexpr double max_edge_points = 80;

/// Returns the number of points along top or bottom of a half wall, without that of the wall tip. It depends
/// on whole walls, whose lengths do not change with the positions of hinges: the energy must not jump with t.
int edge_points(const ContactPlates& all, const Linkage& structure) {
  double longest = 0;
  for (std::size_t k = 0; k + 1 < structure.plates.size(); k += 2)
    longest = std::max(longest, structure.plates[k].length + structure.plates[k + 1].length);
  // The length of a wall is 1 up to rounding.
  return static_cast<int>(
      std::clamp(std::ceil(longest / (2 * all.half_thickness) - 1e-6), 1.0, max_edge_points));
}

std::vector<ContactPoint> contact_points(const ContactPlates& all, int edge_point_count) {
  std::vector<ContactPoint> points;
  const auto add = [&](double part, double side, double level) {
    points.push_back({part, side * all.half_thickness, level * all.half_height});
  };
  for (const double side : {1.0, -1.0})
    for (const double level : all.planar ? std::vector<double>{0} : std::vector<double>{-1, 0, 1})
      add(1, side, level);
  for (int k = 0; k < edge_point_count; ++k)
    for (const double side : {1.0, -1.0})
      for (const double level : {1.0, -1.0}) add(static_cast<double>(k) / edge_point_count, side, level);
  return points;
}

ContactPlate contact_plate(const Plate& half_wall) {
  ContactPlate plate;
  plate.body = half_wall.body;
  plate.sign = half_wall.length_t;
  plate.length = half_wall.length;
  plate.slant = half_wall.slant;
  // cot(alpha) for the half wall whose length is t, and its negative for the other one.
  plate.slant_rate = -std::copysign(1 + plate.slant * plate.slant, half_wall.length_t);
  plate.edge = half_wall.edge;
  plate.up = half_wall.up;
  plate.up_rate = half_wall.up_beta;
  plate.normal = plate.edge.cross(plate.up);
  plate.normal_rate = plate.edge.cross(plate.up_rate);
  return plate;
}

}  // namespace

Vector3d ContactPlate::face_normal(Face face) const {
  switch (face) {
    case Face::side_plus:
      return normal;
    case Face::side_minus:
      return -normal;
    case Face::wall_tip_end:
      return (edge - slant * up) / end_slope();
    case Face::top:
      return up;
    case Face::bottom:
      break;
  }
  return -up;
}

Vector3d ContactPlate::face_normal_rate(Face face) const {
  switch (face) {
    case Face::side_plus:
      return normal_rate;
    case Face::side_minus:
      return -normal_rate;
    case Face::wall_tip_end:
      return -slant * up_rate / end_slope();
    case Face::top:
      return up_rate;
    case Face::bottom:
      break;
  }
  return -up_rate;
}

Vector3d ContactPlate::face_normal_alpha_rate(Face face) const {
  if (face != Face::wall_tip_end) return Vector3d::Zero();
  const double slope = end_slope();
  return -slant_rate * (up + slant * edge) / (slope * slope * slope);
}

Vector3d ContactPlate::place(const ContactPoint& point) const {
  return point.part * length_at(point.high) * edge + point.across * normal + point.high * up;
}

Vector3d ContactPlate::place_length_rate(const ContactPoint& point) const {
  return point.part * length_rate_at(point.high) * edge;
}

Vector3d ContactPlate::place_alpha_rate(const ContactPoint& point) const {
  return slant_rate * point.high * place_length_rate(point);
}

Vector3d ContactPlate::place_rate(const ContactPoint& point) const {
  return point.across * normal_rate + point.high * up_rate;
}

double ContactPlates::wall_tip_radius() const {
  if (planar) return half_thickness;
  double longest = 0;
  for (const ContactPlate& plate : plates) longest = std::max(longest, plate.end_slope());
  return std::hypot(half_thickness, half_height * longest);
}

double ContactPlates::reach() const {
  double longest = 0;
  for (const ContactPlate& plate : plates) longest = std::max(longest, plate.length);
  return longest + wall_tip_radius();
}

double ContactPlates::face_offset(const ContactPlate& plate, Face face) const {
  if (face == Face::wall_tip_end) return plate.length / plate.end_slope();
  return face == Face::top || face == Face::bottom ? half_height : half_thickness;
}

ContactPlates contact_plates(const Linkage& structure, bool planar) {
  ContactPlates all;
  all.edge_mm = structure.size.edge_mm;
  all.half_thickness = structure.size.thickness_mm / 2 / all.edge_mm;
  all.half_height = structure.size.height_mm / 2 / all.edge_mm;
  all.planar = planar;
  all.plates.reserve(structure.plates.size());
  for (const Plate& plate : structure.plates) all.plates.push_back(contact_plate(plate));
  all.points = contact_points(all, planar ? 0 : edge_points(all, structure));
  return all;
}

}  // namespace kinetix::model
