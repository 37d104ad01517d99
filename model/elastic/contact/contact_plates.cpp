#include "model/elastic/contact/contact_plates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

ContactPlate contact_plate(const ContactPlates& all, const Plate& half_wall) {
  ContactPlate plate;
  plate.body = half_wall.body;
  plate.sign = half_wall.length_t;
  plate.length = half_wall.length;
  plate.edge = half_wall.edge;
  plate.up = half_wall.up;
  plate.up_rate = half_wall.up_beta;
  plate.normal = plate.edge.cross(plate.up);
  plate.normal_rate = plate.edge.cross(plate.up_rate);
  for (const double side : {1.0, -1.0})
    for (const double level : all.planar ? std::vector<double>{0} : std::vector<double>{-1, 0, 1}) {
      const double across = side * all.half_thickness, high = level * all.half_height;
      plate.points.push_back(plate.length * plate.edge + across * plate.normal + high * plate.up);
      plate.point_gradients.push_back(across * plate.normal_rate + high * plate.up_rate);
    }
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
      return edge;
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
      return Vector3d::Zero();
    case Face::top:
      return up_rate;
    case Face::bottom:
      break;
  }
  return -up_rate;
}

double ContactPlates::wall_tip_radius() const {
  return planar ? half_thickness : std::hypot(half_thickness, half_height);
}

double ContactPlates::reach() const {
  double longest = 0;
  for (const ContactPlate& plate : plates) longest = std::max(longest, plate.length);
  return longest + wall_tip_radius();
}

double ContactPlates::face_offset(const ContactPlate& plate, Face face) const {
  if (face == Face::wall_tip_end) return plate.length;
  return face == Face::top || face == Face::bottom ? half_height : half_thickness;
}

ContactPlates contact_plates(const Linkage& structure, bool planar) {
  ContactPlates all;
  all.edge_mm = structure.size.edge_mm;
  all.half_thickness = structure.size.thickness_mm / 2 / all.edge_mm;
  all.half_height = structure.size.height_mm / 2 / all.edge_mm;
  all.planar = planar;
  all.plates.reserve(structure.plates.size());
  for (const Plate& plate : structure.plates) all.plates.push_back(contact_plate(all, plate));
  return all;
}

}  // namespace kinetix::model
