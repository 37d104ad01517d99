#include "model/elastic/contact_energy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kinetix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

enum Face { side_plus, side_minus, knee_end, top, bottom };

constexpr double near_margin = 0.3;
constexpr double passing_margin = 0.5;
constexpr double flat = 1e-9;

/// The displacement gradient that fits the shifts between two states best, least squares.
Matrix3d homogeneous_strain(const State& from, const State& to) {
  Vector3d middle = Vector3d::Zero(), shift = Vector3d::Zero();
  for (std::size_t b = 0; b < from.size(); ++b) {
    middle += from[b].p;
    shift += to[b].p - from[b].p;
  }
  middle /= static_cast<double>(from.size());
  shift /= static_cast<double>(from.size());
  Matrix3d spread = Matrix3d::Zero(), mixed = Matrix3d::Zero();
  for (std::size_t b = 0; b < from.size(); ++b) {
    const Vector3d at = from[b].p - middle;
    spread += at * at.transpose();
    mixed += (to[b].p - from[b].p - shift) * at.transpose();
  }
  spread.diagonal().array() += flat * spread.trace();
  return mixed * spread.inverse();
}

bool is_same(const State& a, const State& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pose& x, const Pose& y) { return x.p == y.p && x.R == y.R; });
}

bool is_finite(const State& state) {
  return std::all_of(state.begin(), state.end(),
                     [](const Pose& pose) { return pose.R.allFinite() && pose.p.allFinite(); });
}

}  // namespace

/// The signed distance n . m - offset of a carried point from a carried face, in cell edges.
struct ContactModel::Gap {
  Vector3d n;  ///< carried outward normal
  Vector3d a;  ///< from the point's body to the point
  Vector3d m;  ///< from the box's body to the point
  double value;

  Vector12 gradient() const {
    Vector12 g;
    g << a.cross(n), n, n.cross(m), -n;
    return g;
  }

  Matrix12 hessian() const {
    const Matrix3d cross_n = cross_matrix(n), turns = -cross_n * cross_matrix(a);
    Matrix12 h = Matrix12::Zero();
    h.block<3, 3>(0, 0) = turning_hessian(n, a);
    h.block<3, 3>(6, 6) = turning_hessian(m, n);
    h.block<3, 3>(6, 3) = cross_n;
    h.block<3, 3>(3, 6) = -cross_n;
    h.block<3, 3>(6, 9) = -cross_n;
    h.block<3, 3>(9, 6) = cross_n;
    h.block<3, 3>(6, 0) = turns;
    h.block<3, 3>(0, 6) = turns.transpose();
    return h;
  }

  /// Change of gradient() where n, a and m change.
  Vector12 gradient_change(const Vector3d& dn, const Vector3d& da, const Vector3d& dm) const {
    Vector12 g;
    g << da.cross(n) + a.cross(dn), dn, dn.cross(m) + n.cross(dm), -dn;
    return g;
  }
};

ContactModel::ContactModel(const Structure& structure, bool planar)
    : edge_mm_(structure.size.edge_mm),
      half_thickness_(structure.size.thickness_mm / 2 / edge_mm_),
      half_height_(structure.size.height_mm / 2 / edge_mm_),
      planar_(planar),
      weight_(planar ? 1.0 : 1.0 / 3),
      points_per_plate_(planar ? 2 : 6) {
  plates_.reserve(2 * structure.hinges.size());
  for (const Hinge& hinge : structure.hinges)
    for (const bool lower : {true, false})
      plates_.push_back(make_plate(hinge, lower, half_thickness_, half_height_));
  placed_points_.resize(plates_.size() * points_per_plate_);
  placed_boxes_.resize(plates_.size());
  WallContact at_rest(structure);
  const auto& touching = at_rest.touching_at_rest();
  for (const WallPair& pair : touching) excluded_.emplace_back(pair.first, pair.second);
  const auto overlapping = at_rest.overlapping(rest_state(structure), touching);
  if (!overlapping.empty()) overlap_at_rest_ = overlapping.front();
}

ContactModel::Plate ContactModel::make_plate(const Hinge& hinge, bool lower, double half_thickness,
                                             double half_height) const {
  Plate plate;
  const Axis axis = hinge.wall.axis;
  plate.body = lower ? hinge.lower : hinge.upper;
  plate.sign = lower ? 1 : -1;
  plate.length = lower ? hinge.parameters.t : 1 - hinge.parameters.t;
  plate.edge = plate.sign * edge_direction(axis);
  plate.up = wall_up(axis, hinge.parameters.beta);
  plate.up_rate = wall_up(axis, hinge.parameters.beta + pi / 2);
  plate.normal = plate.edge.cross(plate.up);
  plate.normal_rate = plate.edge.cross(plate.up_rate);
  for (const double side : {1.0, -1.0})
    for (const double level : planar_ ? std::vector<double>{0} : std::vector<double>{-1, 0, 1}) {
      plate.points.push_back(plate.length * plate.edge + side * half_thickness * plate.normal +
                             level * half_height * plate.up);
      plate.point_rates.push_back(side * half_thickness * plate.normal_rate +
                                  level * half_height * plate.up_rate);
    }
  return plate;
}

void ContactModel::place(int plate_index, const State& state) {
  const Plate& plate = plates_[plate_index];
  const Pose& pose = state[plate.body];
  const Vector3d origin = pose.p / edge_mm_;
  for (int k = 0; k < points_per_plate_; ++k)
    placed_points_[plate_index * points_per_plate_ + k] = origin + pose.R * plate.points[k];
  placed_boxes_[plate_index] = {origin, pose.R * plate.edge, pose.R * plate.normal, pose.R * plate.up};
}

void ContactModel::place(const State& state) {
  for (int plate = 0; plate < static_cast<int>(plates_.size()); ++plate) place(plate, state);
}

/// Far enough for a point to have come into a box that it was a margin away from. What the bodies share, a
/// homogeneous strain, brings plates closer by a part of their distance; each body's own motion adds to it. No
/// point of a plate is further than 1.2 edges from its vertex.
bool ContactModel::has_moved(const State& state) const {
  if (near_state_.size() != state.size()) return true;
  const double reach = 1.2 * (planar_ ? 1.0 : std::max(1.0, half_height_));
  const Matrix3d strain = homogeneous_strain(near_state_, state);
  const Vector3d shift = state[0].p - near_state_[0].p - strain * near_state_[0].p;
  const double allowed = (near_margin - strain.norm() * (2 * reach + near_margin)) / 2;
  for (std::size_t b = 0; b < state.size(); ++b) {
    const Vector3d own = state[b].p - near_state_[b].p - strain * near_state_[b].p - shift;
    const double turn = (state[b].R - near_state_[b].R).norm() / std::sqrt(2.0);
    if (!(own.norm() / edge_mm_ + reach * turn <= allowed)) return true;
  }
  return false;
}

bool ContactModel::is_within(const Vector3d& point, int other, double margin) const {
  const PlacedBox& box = placed_boxes_[other];
  const Vector3d y = point - box.origin;
  const double along = y.dot(box.edge);
  if (!(along > -margin) || !(along < plates_[other].length + margin)) return false;
  if (!(std::abs(y.dot(box.normal)) < half_thickness_ + margin)) return false;
  return planar_ || std::abs(y.dot(box.up)) <= half_height_ + margin;
}

std::vector<ContactModel::Pair> ContactModel::pairs_within(double margin) {
  Eigen::Matrix3Xd centers(3, plates_.size());
  double longest = 0;
  for (std::size_t k = 0; k < plates_.size(); ++k) {
    centers.col(k) = placed_boxes_[k].origin + plates_[k].length / 2 * placed_boxes_[k].edge;
    longest = std::max(longest, plates_[k].length);
  }
  std::vector<Pair> pairs;
  const double knee = planar_ ? half_thickness_ : std::hypot(half_thickness_, half_height_);
  const auto add = [&](int plate, int other) {
    const PlacedBox& box = placed_boxes_[plate];
    if (!is_within(box.origin + plates_[plate].length * box.edge, other, margin + knee)) return;
    for (int k = 0; k < points_per_plate_; ++k)
      if (is_within(placed_points_[plate * points_per_plate_ + k], other, margin) && may_touch(plate, other))
        pairs.push_back({plate * points_per_plate_ + k, other});
  };
  for (const auto& [first, second] : finder_.find(centers, longest + 2 * knee + margin)) {
    const double reach = (plates_[first].length + plates_[second].length) / 2 + 2 * knee + margin;
    if ((centers.col(first) - centers.col(second)).squaredNorm() >= reach * reach) continue;
    add(first, second);
    add(second, first);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool ContactModel::may_touch(int plate, int other) const {
  const bool one_body = plates_[plate].body == plates_[other].body, one_wall = plate / 2 == other / 2;
  const std::pair<int, int> pair = std::minmax({plate, other});
  return !one_body && !one_wall && !std::binary_search(excluded_.begin(), excluded_.end(), pair);
}

Vector3d ContactModel::face_normal(const Plate& plate, int face) const {
  switch (face) {
    case side_plus:
      return plate.normal;
    case side_minus:
      return -plate.normal;
    case knee_end:
      return plate.edge;
    case top:
      return plate.up;
    default:
      return -plate.up;
  }
}

Vector3d ContactModel::face_normal_rate(const Plate& plate, int face) const {
  switch (face) {
    case side_plus:
      return plate.normal_rate;
    case side_minus:
      return -plate.normal_rate;
    case knee_end:
      return Vector3d::Zero();
    case top:
      return plate.up_rate;
    default:
      return -plate.up_rate;
  }
}

double ContactModel::face_offset(const Plate& plate, int face) const {
  if (face == knee_end) return plate.length;
  return face == top || face == bottom ? half_height_ : half_thickness_;
}

void ContactModel::add_if_inside(int point, int other) {
  if (!is_within(placed_points_[point], other, 0)) return;
  const PlacedBox& box = placed_boxes_[other];
  const Vector3d y = placed_points_[point] - box.origin;
  const double across = y.dot(box.normal), high = y.dot(box.up);
  const double to_end = plates_[other].length - y.dot(box.edge), to_rim = half_height_ - std::abs(high);
  Contact contact{point / points_per_plate_, point % points_per_plate_, other,
                  across > 0 ? side_plus : side_minus, half_thickness_ - std::abs(across)};
  if (to_end < contact.depth) {
    contact.depth = to_end;
    contact.face = knee_end;
  }
  if (!planar_ && to_rim < contact.depth) {
    contact.depth = to_rim;
    contact.face = high > 0 ? top : bottom;
  }
  if (contact.depth > 0) found_.push_back(contact);
}

void ContactModel::update_near(const State& state) {
  place(state);
  near_ = pairs_within(near_margin);
  near_state_ = state;
  std::vector<char> is_near(plates_.size());
  for (const Pair& pair : near_) is_near[pair.point / points_per_plate_] = is_near[pair.other] = true;
  near_plates_.clear();
  for (int plate = 0; plate < static_cast<int>(plates_.size()); ++plate)
    if (is_near[plate]) near_plates_.push_back(plate);
}

const std::vector<Contact>& ContactModel::find(const State& state) {
  if (is_same(state, found_state_)) return found_;
  found_.clear();
  found_state_ = state;
  if (!is_finite(state)) return found_;
  if (has_moved(state))
    update_near(state);
  else
    for (const int plate : near_plates_) place(plate, state);
  for (const Pair& pair : near_) add_if_inside(pair.point, pair.other);
  return found_;
}

int ContactModel::side_of(int point, int other) const {
  const PlacedBox& box = placed_boxes_[other];
  const Vector3d y = placed_points_[point] - box.origin;
  const double along = y.dot(box.edge), across = y.dot(box.normal);
  const double to_end = plates_[other].length - along;
  if (!(along > 0) || !(to_end > std::max(0.0, half_thickness_ - std::abs(across)))) return 0;
  if (!planar_ && !(std::abs(y.dot(box.up)) <= half_height_)) return 0;
  return across > 0 ? 1 : -1;
}

bool ContactModel::passed_through(const State& before, const State& after) {
  const bool kept = !has_moved(before) && !has_moved(after);
  place(before);
  const std::vector<Pair> near = kept ? near_ : pairs_within(passing_margin);
  std::vector<int> sides;
  sides.reserve(near.size());
  for (const Pair& pair : near) sides.push_back(side_of(pair.point, pair.other));
  place(after);
  for (std::size_t k = 0; k < near.size(); ++k)
    if (sides[k] * side_of(near[k].point, near[k].other) < 0) return true;
  return false;
}

ContactModel::Gap ContactModel::gap(const Contact& c, const State& state) const {
  const Plate& plate = plates_[c.plate];
  const Plate& box = plates_[c.other];
  const Pose& pose = state[plate.body];
  const Pose& frame = state[box.body];
  Gap gap;
  gap.n = frame.R * face_normal(box, c.face);
  gap.a = pose.R * plate.points[c.point];
  gap.m = (pose.p - frame.p) / edge_mm_ + gap.a;
  gap.value = gap.n.dot(gap.m) - face_offset(box, c.face);
  return gap;
}

Element ContactModel::element(const Contact& contact, double stiffness, const State& state) const {
  const Gap g = gap(contact, state);
  const double k = weight_ * stiffness;
  const Vector12 gradient = g.gradient();
  Element e;
  e.energy = 0.5 * k * g.value * g.value;
  e.gradient = k * g.value * gradient;
  e.hessian = k * (gradient * gradient.transpose() + g.value * g.hessian());
  return e;
}

double ContactModel::energy(const std::vector<Contact>& contacts, double stiffness) const {
  double sum = 0;
  for (const Contact& c : contacts) sum += 0.5 * weight_ * stiffness * c.depth * c.depth;
  return sum;
}

Eigen::Vector4d ContactModel::gap_rates(const Gap& g, const Contact& c, const State& state) const {
  const Plate& plate = plates_[c.plate];
  const Plate& box = plates_[c.other];
  const Matrix3d& R = state[plate.body].R;
  return {plate.sign * g.n.dot(R * plate.edge), g.n.dot(R * plate.point_rates[c.point]),
          c.face == knee_end ? -box.sign : 0, g.m.dot(state[box.body].R * face_normal_rate(box, c.face))};
}

Eigen::Vector4d ContactModel::depth_rates(const Contact& c, const State& state) const {
  return -gap_rates(gap(c, state), c, state);
}

Eigen::Matrix<double, 12, 4> ContactModel::rates(const Contact& c, double stiffness,
                                                 const State& state) const {
  const Gap g = gap(c, state);
  const Plate& plate = plates_[c.plate];
  const Plate& box = plates_[c.other];
  const Matrix3d& R = state[plate.body].R;
  const Vector3d by_t = plate.sign * (R * plate.edge), by_beta = R * plate.point_rates[c.point];
  const Vector3d normal_by_beta = state[box.body].R * face_normal_rate(box, c.face);
  const Vector3d none = Vector3d::Zero();
  const Eigen::Vector4d value = gap_rates(g, c, state);
  Eigen::Matrix<double, 12, 4> out;
  out.col(0) = g.gradient_change(none, by_t, by_t);
  out.col(1) = g.gradient_change(none, by_beta, by_beta);
  out.col(2).setZero();
  out.col(3) = g.gradient_change(normal_by_beta, none, none);
  return weight_ * stiffness * (g.value * out + g.gradient() * value.transpose());
}

Vector12 ContactModel::stiffness_rate(const Contact& contact, const State& state) const {
  const Gap g = gap(contact, state);
  return weight_ * g.value * g.gradient();
}

}  // namespace kinetix
