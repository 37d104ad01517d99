#include "model/linkage/linkage_drive.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double straight = 1e-14;  // width of a row over its length, squared: below, it is rounding
constexpr double off = 1e-8;        // cell edges: a row that is meant to bend leaves its plane by far more

Vector3d centre(const std::vector<int>& row, const State& state) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : row) sum += state[body].p;
  return sum / static_cast<double>(row.size());
}

/// Returns the offsets of the bodies in both rows from the centre of their row, one body per column.
Eigen::Matrix3Xd offsets(const GrippedRows& rows, const State& state) {
  Eigen::Matrix3Xd out(3, rows[0].size() + rows[1].size());
  Eigen::Index k = 0;
  for (const auto& row : rows) {
    const Vector3d middle = centre(row, state);
    for (const int body : row) out.col(k++) = state[body].p - middle;
  }
  return out;
}

/// Returns the direction n with the least |points' n| / (n . across). If several have none, the result is the
/// one nearest to `across`.
Vector3d flattest(const Eigen::Matrix3Xd& points, const Vector3d& across) {
  const auto [axes, values] = principal_axes(points * points.transpose());
  const double least = straight * values.sum();
  const Vector3d weights = (values.array().max(0.0) + least).inverse();
  return (axes * weights.cwiseProduct(axes.transpose() * across)).normalized();
}

}  // namespace

RowPlanes planes_of(const GrippedRows& rows, const State& state) {
  const Eigen::Matrix3Xd points = offsets(rows, state);
  const Vector3d across = centre(rows[1], state) - centre(rows[0], state);
  RowPlanes planes;
  planes.normal = flattest(points, across);
  planes.distance = planes.normal.dot(across);
  planes.off_plane = (planes.normal.transpose() * points).cwiseAbs().maxCoeff();
  return planes;
}

bool keeps_between_plates(const Linkage& structure, const GrippedRows& rows,
                          const std::function<State(double)>& fold) {
  const double rest = planes_of(rows, rest_state(structure)).distance;
  const double allowed = off * structure.size.edge_mm;
  return std::all_of(std::begin(probe_thetas), std::end(probe_thetas), [&](double theta) {
    const RowPlanes planes = planes_of(rows, fold(theta));
    return planes.off_plane <= allowed && std::abs(planes.distance - rest * std::cos(theta)) <= allowed;
  });
}

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
  LinkageDrive out = limited_to(kind == Kind::plates ? closer
                                : kind == Kind::cord ? closer * rest_mm
                                                     : coordinate_at(theta));
  out.branch = theta < 0 ? -1 : 1;
  return out;
}

LinkageDrive LinkageDrive::limited_to(double coordinate) const {
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

std::string LinkageDrive::describe_coordinate() const {
  if (kind == Kind::plates) return "compression";
  if (kind == Kind::hinge) return "hinge angle";
  return kind == Kind::cord ? "tendon shortened by" : "springs' rest angle";
}

bool LinkageDrive::determines_fold() const { return kind != Kind::cord && kind != Kind::shape_memory; }

bool LinkageDrive::has_branch() const { return kind == Kind::plates || kind == Kind::cord; }

bool LinkageDrive::has_plates() const { return kind == Kind::plates; }

bool LinkageDrive::only_pulls() const { return kind == Kind::cord; }

bool LinkageDrive::is_external() const { return kind != Kind::shape_memory; }

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

LinkageDrive plates_between(GrippedRows rows, Axis axis, double compression, int branch, int bodies) {
  require("drive.compression", compression, compression >= 0 && compression < 1, "in [0, 1)");
  require("drive.branch", branch, branch == 1 || branch == -1, "1 or -1");
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::plates;
  drive.axis = axis;
  drive.compression = compression;
  drive.branch = branch;
  drive.gripped = std::move(rows);
  drive.held.resize(bodies);
  std::iota(drive.held.begin(), drive.held.end(), 0);
  return drive;
}

LinkageDrive turned_hinge(int hinge, int sense, double angle) {
  require("drive.angle", angle, std::abs(angle) < pi, "in (-pi, pi) rad");
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::hinge;
  drive.hinge = hinge;
  drive.sense = sense;
  drive.angle = angle;
  return drive;
}

namespace {

bool have_common_body(const RestHinge& a, const RestHinge& b) {
  return a.lower == b.lower || a.lower == b.upper || a.upper == b.lower || a.upper == b.upper;
}

bool can_shorten(const Linkage& linkage, const std::vector<int>& through) {
  for (std::size_t k = 1; k < through.size(); ++k)
    if (!have_common_body(linkage.hinges[through[k - 1]], linkage.hinges[through[k]])) return true;
  return false;
}

[[noreturn]] void refuse_cord(const std::string& why) {
  throw InvalidInput(why, {"", 0, 0, "drive.through"});
}

void check_cord(const Linkage& linkage, const std::vector<int>& through) {
  if (through.size() < 2) refuse_cord("a tendon runs through the hinges of at least two walls");
  for (std::size_t k = 1; k < through.size(); ++k)
    if (through[k] == through[k - 1])
      refuse_cord("wall " + linkage.wall_name(through[k]) + " is named twice in a row");
  if (!can_shorten(linkage, through))
    refuse_cord(
        "each two neighbouring walls share a vertex, whose rigid body carries both hinge points: no drive "
        "shortens this tendon. Name walls that face each other, e.g. [[[0, 0], [0, 1]], [[1, 0], [1, 1]], "
        "...], or every "
        "other one");
}

}  // namespace

Eigen::Vector3d hinge_point(const Linkage& linkage, int hinge, const State& state) {
  const RestHinge& h = linkage.hinges[hinge];
  const Pose &lower = state[h.lower], &upper = state[h.upper];
  return (lower.p + upper.p + linkage.size.edge_mm * (lower.R * h.lower_arm + upper.R * h.upper_arm)) / 2;
}

double cord_length(const Linkage& linkage, const std::vector<int>& through, const State& state) {
  double sum = 0;
  for (std::size_t k = 1; k < through.size(); ++k)
    sum += (hinge_point(linkage, through[k], state) - hinge_point(linkage, through[k - 1], state)).norm();
  return sum;
}

LinkageDrive cord_drive(const Linkage& linkage, const std::vector<int>& through, double shorten_mm,
                        int branch) {
  check_cord(linkage, through);
  require("drive.branch", branch, branch == 1 || branch == -1, "1 or -1");
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::cord;
  drive.through = through;
  drive.branch = branch;
  drive.rest_mm = cord_length(linkage, through, rest_state(linkage));
  drive.shorten_mm = shorten_mm;
  if (shorten_mm >= 0 && shorten_mm < drive.rest_mm) return drive;
  throw InvalidInput(number_text(shorten_mm) +
                         " is out of range. Give a number from 0 and below the tendon's length, " +
                         number_text(drive.rest_mm) + " mm",
                     {"", 0, 0, "drive.shorten_mm"});
}

LinkageDrive shape_memory_drive(const Linkage& linkage, std::vector<int> hinges, double k_turn,
                                double angle) {
  require("drive.k_turn", k_turn, k_turn >= 1e-30 && k_turn <= 1e30, "positive, from 1e-30 to 1e30 N mm/rad");
  require("drive.angle", angle, std::abs(angle) < pi, "in (-pi, pi) rad");
  if (hinges.empty()) {
    hinges.resize(linkage.hinges.size());
    std::iota(hinges.begin(), hinges.end(), 0);
  }
  std::sort(hinges.begin(), hinges.end());
  if (const auto twice = std::adjacent_find(hinges.begin(), hinges.end()); twice != hinges.end())
    throw InvalidInput("wall " + linkage.wall_name(*twice) + " is named twice", {"", 0, 0, "drive.walls"});
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::shape_memory;
  drive.springs = std::move(hinges);
  drive.k_spring = k_turn;
  drive.angle = angle;
  return drive;
}

}  // namespace kinetix::model
