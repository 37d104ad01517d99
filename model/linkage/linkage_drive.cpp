#include "model/linkage/linkage_drive.hpp"

#include <cmath>

namespace kinetix::model {
namespace {

enum Coordinate { turn_x, turn_y, turn_z, shift_x, shift_y, shift_z };

/// Returns the gripped coordinates, the z shift of each middle body, and the remaining rigid motion at the
/// first middle body.
std::vector<std::array<int, 2>> held_by_plates(const LinkageDrive& drive) {
  const bool along_y = drive.axis == Axis::y;
  std::vector<std::array<int, 2>> held;
  for (const auto& row : drive.gripped) {
    for (const int body : row) held.push_back({body, along_y ? shift_y : shift_x});
    held.push_back({row[row.size() / 2], shift_z});
  }
  const int pin = drive.gripped[0][drive.gripped[0].size() / 2];
  held.push_back({pin, along_y ? shift_x : shift_y});
  held.push_back({pin, along_y ? turn_y : turn_x});
  return held;
}

}  // namespace

double LinkageDrive::theta() const {
  if (kind == Kind::plates) return branch * 2 * std::asin(std::sqrt(compression / 2));
  if (kind == Kind::cord) return branch * 2 * std::asin(std::sqrt(shorten_mm / rest_mm / 2));
  if (kind == Kind::shape_memory) return angle / 2;
  if (kind == Kind::none) return 0;
  return theta_at_turn(sense, angle);
}

LinkageDrive LinkageDrive::to(double theta) const {
  const double closer = 2 * std::pow(std::sin(theta / 2), 2);  // 1 - cos(theta) without its rounding
  LinkageDrive out = as_far_as(kind == Kind::plates ? closer
                               : kind == Kind::cord ? closer * rest_mm
                                                    : coordinate_at(theta));
  out.branch = theta < 0 ? -1 : 1;
  return out;
}

LinkageDrive LinkageDrive::as_far_as(double coordinate) const {
  LinkageDrive out = *this;
  (kind == Kind::plates ? out.compression : kind == Kind::cord ? out.shorten_mm : out.angle) = coordinate;
  return out;
}

double LinkageDrive::coordinate_at(double theta) const {
  if (kind == Kind::cord) return rest_mm * (1 - std::cos(theta));
  if (kind == Kind::shape_memory) return 2 * theta;
  return kind == Kind::hinge ? turn_at_theta(sense, theta) : 1 - std::cos(theta);
}

double LinkageDrive::coordinate_rate(double theta) const {
  if (kind == Kind::cord) return rest_mm * std::sin(theta);
  if (kind == Kind::shape_memory) return 2;
  return kind == Kind::hinge ? turn_at_theta(sense, 1) : std::sin(theta);
}

double LinkageDrive::travel(const Linkage& linkage) const {
  if (kind != Kind::plates) return 1;
  const auto row = [&](int plate) {
    return linkage.bodies[gripped[plate].front()].position[component(axis)];
  };
  return linkage.size.edge_mm * (row(1) - row(0));
}

std::string LinkageDrive::coordinate_unit() const {
  if (kind == Kind::plates) return "compression";
  return kind == Kind::cord ? "mm" : "rad";
}

std::string LinkageDrive::coordinate_name() const {
  if (kind == Kind::plates) return "compression";
  return kind == Kind::cord ? "shortened_mm" : "drive_rad";
}

std::string LinkageDrive::coordinate_words() const {
  if (kind == Kind::plates) return "compression";
  if (kind == Kind::hinge) return "hinge angle";
  return kind == Kind::cord ? "cord shortened by" : "springs' rest angle";
}

bool LinkageDrive::tells_fold() const { return kind != Kind::cord && kind != Kind::shape_memory; }

bool LinkageDrive::has_branch() const { return kind == Kind::plates || kind == Kind::cord; }

bool LinkageDrive::has_plates() const { return kind == Kind::plates; }

bool LinkageDrive::only_pulls() const { return kind == Kind::cord; }

bool LinkageDrive::acts_from_outside() const { return kind != Kind::shape_memory; }

bool LinkageDrive::holds_coordinate() const { return kind == Kind::hinge || kind == Kind::cord; }

bool LinkageDrive::has_force() const { return kind == Kind::plates || kind == Kind::cord; }

int LinkageDrive::held_body(const Linkage& linkage) const {
  if (kind == Kind::hinge) return linkage.hinges[hinge].lower;
  return static_cast<int>(linkage.bodies.size() / 2);
}

std::vector<std::array<int, 2>> LinkageDrive::held_coordinates(const Linkage& linkage) const {
  if (kind == Kind::plates) return held_by_plates(*this);
  std::vector<std::array<int, 2>> held;
  for (const int c : {turn_x, turn_y, turn_z, shift_x, shift_y, shift_z})
    held.push_back({held_body(linkage), c});
  return held;
}

}  // namespace kinetix::model
