#include "model/elastic/contact/contact_energy.hpp"

#include <tuple>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Cell edges: a wider margin lists more pairs, a narrower one needs new searches more often.
constexpr double near_margin = 0.3;
constexpr double passing_margin = 0.5;  // cell edges: a point further away may have gone around the end
// Cell edges: rounding difference of a point's position between two ways to compute it.
constexpr double summed_otherwise = 1e-9;
// Rad: a smaller turn has no defined axis.
constexpr double min_turn = 1e-6;
// Fraction of half the thickness. Shallower contact between two states may only seem so, since the actual
// motion differs from the screw.
constexpr double unseen = 0.05;
// Fraction of half the thickness: a point closer to a side slides out of it.
constexpr double deep = 0.25;

bool is_same(const State& a, const State& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pose& x, const Pose& y) { return x.p == y.p && x.R == y.R; });
}

}  // namespace

ContactSearch::ContactSearch(const Linkage& structure, bool planar)
    : all_(contact_plates(structure, planar)),
      walls_(half_walls(structure)),
      placed_boxes_(all_.plates.size()),
      moved_(all_.edge_mm, all_.reach()) {
  const WallContact at_rest(structure);
  for (const WallPair& pair : at_rest.touching_at_rest()) excluded_.emplace_back(pair.first, pair.second);
  overlap_at_rest_ = at_rest.overlap_at_rest();
}

void ContactSearch::place(int plate_index, const State& state) {
  const ContactPlate& plate = all_.plates[plate_index];
  const Pose& pose = state[plate.body];
  const Vector3d origin = pose.p / all_.edge_mm;
  placed_boxes_[plate_index] = {origin, pose.R * plate.edge, pose.R * plate.normal, pose.R * plate.up};
}

void ContactSearch::place(const State& state) {
  for (int plate = 0; plate < static_cast<int>(all_.plates.size()); ++plate) place(plate, state);
}

Vector3d ContactSearch::in_box(const Vector3d& point, int other) const {
  const Box& box = placed_boxes_[other];
  const Vector3d y = point - box.origin;
  return {y.dot(box.edge), y.dot(box.normal), y.dot(box.up)};
}

Vector3d ContactSearch::in_box(const Contact& contact) const {
  return in_box(point_of(placed_boxes_[contact.plate], contact.plate, all_.points[contact.point]),
                contact.other);
}

ContactSearch::Box ContactSearch::in_box(const PlatePair& pair) const {
  const Box &from = placed_boxes_[pair.plate], &box = placed_boxes_[pair.other];
  const auto turned = [&](const Vector3d& v) -> Vector3d {
    return {v.dot(box.edge), v.dot(box.normal), v.dot(box.up)};
  };
  return {in_box(from.origin, pair.other), turned(from.edge), turned(from.normal), turned(from.up)};
}

Vector3d ContactSearch::point_of(const Box& box, int index, const ContactPoint& point) const {
  const double along = point.part * all_.plates[index].length_at(point.high);
  return box.origin + along * box.edge + point.across * box.normal + point.high * box.up;
}

bool ContactSearch::is_within(const Vector3d& y, int other, double margin) const {
  if (!(y[0] > -margin) || !(all_.plates[other].to_end(y[0], y[2]) > -margin)) return false;
  if (!(std::abs(y[1]) < all_.half_thickness + margin)) return false;
  return all_.planar || std::abs(y[2]) <= all_.half_height + margin;
}

ContactSearch::Extent ContactSearch::extent_of(const Box& box, int index) const {
  const ContactPlate& plate = all_.plates[index];
  const double middle = all_.planar ? plate.length : plate.length / 2,
               along = all_.planar ? 0 : plate.length / 2 + all_.slant_length(plate);
  return {box.origin + middle * box.edge, along * box.edge.cwiseAbs() +
                                              all_.half_thickness * box.normal.cwiseAbs() +
                                              all_.half_height * box.up.cwiseAbs()};
}

ContactSearch::Extent ContactSearch::whole_extent_of(const Box& box, int index) const {
  const ContactPlate& plate = all_.plates[index];
  const double along = plate.length / 2 + all_.slant_length(plate);
  return {box.origin + plate.length / 2 * box.edge, along * box.edge.cwiseAbs() +
                                                        all_.half_thickness * box.normal.cwiseAbs() +
                                                        all_.half_height * box.up.cwiseAbs()};
}

bool ContactSearch::may_be_within(const Extent& extent, int other, double margin) const {
  const Vector3d far = extent.half.array() + margin;
  const ContactPlate& box = all_.plates[other];
  return extent.middle[0] + far[0] > 0 && extent.middle[0] - far[0] < box.length + all_.slant_length(box) &&
         std::abs(extent.middle[1]) < all_.half_thickness + far[1] &&
         (all_.planar || std::abs(extent.middle[2]) <= all_.half_height + far[2]);
}

Eigen::Matrix3Xd ContactSearch::placed_centers() const {
  Eigen::Matrix3Xd centers(3, all_.plates.size());
  for (std::size_t k = 0; k < all_.plates.size(); ++k)
    centers.col(k) = placed_boxes_[k].origin + all_.plates[k].length / 2 * placed_boxes_[k].edge;
  return centers;
}

std::vector<ContactSearch::PlatePair> ContactSearch::pairs_within(double margin) {
  const Eigen::Matrix3Xd centers = placed_centers();
  std::vector<PlatePair> pairs;
  const double wall_tip = all_.wall_tip_radius();
  const auto add = [&](const PlatePair& pair) {
    const Extent extent = extent_of(in_box(pair), pair.plate);
    if (may_be_within(extent, pair.other, margin) && may_touch(pair.plate, pair.other)) pairs.push_back(pair);
  };
  for (const auto& [first, second] : finder_.find(centers, all_.reach() + wall_tip + margin)) {
    const double reach = (all_.plates[first].length + all_.plates[second].length) / 2 + 2 * wall_tip + margin;
    if ((centers.col(first) - centers.col(second)).squaredNorm() >= reach * reach) continue;
    add({first, second});
    add({second, first});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool ContactSearch::may_touch(int plate, int other) const {
  const bool one_body = all_.plates[plate].body == all_.plates[other].body, one_wall = plate / 2 == other / 2;
  const std::pair<int, int> pair = std::minmax({plate, other});
  return !one_body && !one_wall && !std::binary_search(excluded_.begin(), excluded_.end(), pair);
}

void ContactSearch::add_if_inside(Contact contact) {
  const Vector3d y = in_box(contact);
  if (!is_within(y, contact.other, 0)) return;
  const double to_end = all_.plates[contact.other].to_end(y[0], y[2]),
               to_edge = all_.half_height - std::abs(y[2]);
  contact.face = y[1] > 0 ? Face::side_plus : Face::side_minus;
  contact.depth = all_.half_thickness - std::abs(y[1]);
  if (to_end < contact.depth) {
    contact.depth = to_end;
    contact.face = Face::wall_tip_end;
  }
  if (!all_.planar && to_edge < contact.depth) {
    contact.depth = to_edge;
    contact.face = y[2] > 0 ? Face::top : Face::bottom;
  }
  if (contact.depth > 0) found_.push_back(contact);
}

void ContactSearch::add_inside(const PlatePair& pair) {
  const Box plate = in_box(pair);
  if (!may_be_within(extent_of(plate, pair.plate), pair.other, summed_otherwise)) return;
  for (int point = 0; point < static_cast<int>(all_.points.size()); ++point)
    if (is_within(point_of(plate, pair.plate, all_.points[point]), pair.other, summed_otherwise))
      add_if_inside({.plate = pair.plate, .point = point, .other = pair.other});
}

void ContactSearch::update_near(const State& state) {
  place(state);
  near_ = pairs_within(near_margin);
  moved_.remember(state);
  std::vector<char> is_near(all_.plates.size());
  for (const PlatePair& pair : near_) is_near[pair.plate] = is_near[pair.other] = true;
  near_plates_.clear();
  for (int plate = 0; plate < static_cast<int>(all_.plates.size()); ++plate)
    if (is_near[plate]) near_plates_.push_back(plate);
}

const std::vector<Contact>& ContactSearch::find(const State& state) {
  if (is_same(state, found_state_)) return found_;
  found_.clear();
  found_state_ = state;
  if (!is_finite(state)) return found_;
  if (moved_.keeps_apart(state, near_margin))
    for (const int plate : near_plates_) place(plate, state);
  else
    update_near(state);
  for (const PlatePair& pair : near_) add_inside(pair);
  std::sort(found_.begin(), found_.end(), [](const Contact& a, const Contact& b) {
    return std::tuple(a.plate, a.point, a.other) < std::tuple(b.plate, b.point, b.other);
  });
  return found_;
}

int ContactSearch::side_of(const Vector3d& y, int other) const {
  const double to_end = all_.plates[other].to_end(y[0], y[2]);
  if (!(y[0] > 0) || !(to_end > std::max(0.0, all_.half_thickness - std::abs(y[1])))) return 0;
  if (!all_.planar && !(std::abs(y[2]) <= all_.half_height)) return 0;
  return y[1] > 0 ? 1 : -1;
}

bool ContactSearch::is_over(const Vector3d& y, int other) const {
  return std::abs(y[2]) > all_.half_height && std::abs(y[1]) < all_.half_thickness && y[0] > 0 &&
         y[0] < all_.plates[other].length_at(std::copysign(all_.half_height, y[2]));
}

bool ContactSearch::is_past_edge(const Vector3d& y, int other) const {
  const double to_side = all_.half_thickness - std::abs(y[1]);
  return is_within(y, other, 0) && to_side > deep * all_.half_thickness &&
         to_side < all_.half_height - std::abs(y[2]);
}

bool ContactSearch::is_cut(int plate, int other) const {
  const Box &from = placed_boxes_[plate], &box = placed_boxes_[other];
  const Vector3d start = from.origin - box.origin, end = start + all_.plates[plate].length * from.edge;
  const double before = start.dot(box.normal), behind = end.dot(box.normal);
  if (!(before * behind < 0)) return false;
  const double far = (start + before / (before - behind) * (end - start)).dot(box.edge);
  return far > 0 && far < all_.plates[other].length;
}

bool ContactSearch::are_deep(int plate, int other, const State& state) const {
  const HalfWall &one = walls_[plate], &two = walls_[other];
  return overlap(placed(one, state[one.body]), placed(two, state[two.body]),
                 all_.half_thickness * all_.edge_mm);
}

std::vector<std::pair<int, int>> ContactSearch::crossing(const State& state) {
  place(state);
  std::vector<std::pair<int, int>> out;
  for (const auto& [a, b] : finder_.find(placed_centers(), all_.reach() + all_.wall_tip_radius())) {
    const bool crosses = all_.planar ? is_cut(a, b) && is_cut(b, a) : are_deep(a, b, state);
    if (crosses && may_touch(a, b)) out.emplace_back(a, b);
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool ContactSearch::newly_cross(const State& before, const State& after) {
  const auto now = crossing(after);
  if (now.empty()) return false;
  const auto then = crossing(before);
  return !std::includes(then.begin(), then.end(), now.begin(), now.end());
}

OrientedBox ContactSearch::oriented(const Box& box, int index) const {
  const ContactPlate& plate = all_.plates[index];
  OrientedBox out;
  out.center = box.origin + plate.length / 2 * box.edge;
  out.axes << box.edge, box.up, box.normal;
  out.half << plate.length / 2, all_.half_height, all_.half_thickness;
  out.slant = plate.slant;
  return out;
}

bool ContactSearch::stays_off(const PlatePair& pair, const Box& before, const Box& after) const {
  const ContactPlate& other = all_.plates[pair.other];
  const double length = other.length + all_.slant_length(other);
  const Vector3d middle(length / 2, 0, 0), half(length / 2, all_.half_thickness, all_.half_height);
  const Extent then = whole_extent_of(before, pair.plate), now = whole_extent_of(after, pair.plate);
  // Largest distance of an arc from its chord.
  const double bulge = ((after.edge - before.edge).squaredNorm() + (after.up - before.up).squaredNorm()) / 8 *
                       (all_.plates[pair.plate].length + all_.wall_tip_radius());
  for (int k = 0; k < 3; ++k) {
    const double from = then.middle[k] - middle[k], to = now.middle[k] - middle[k];
    if (from * to > 0 && std::abs(from) > half[k] + then.half[k] + bulge &&
        std::abs(to) > half[k] + now.half[k] + bulge)
      return true;
  }
  return false;
}

bool ContactSearch::sweeps_through(const PlatePair& pair, const Box& before, const Box& after) const {
  const auto axes = [](const Box& box) {
    Eigen::Matrix3d all;
    all << box.edge, box.normal, box.up;
    return all;
  };
  const Eigen::Matrix3d turned = axes(after) * axes(before).transpose();
  const Eigen::AngleAxisd turn(turned);
  const double length = all_.plates[pair.plate].length;
  const auto middle = [&](const Box& box) -> Vector3d { return box.origin + length / 2 * box.edge; };
  const Vector3d shift = middle(after) - middle(before), axis = turn.axis();
  const double along = shift.dot(axis);
  // Vector from the middle to the screw axis. A turn by this angle about it moves the middle by `across`.
  const bool is_screw = std::abs(turn.angle()) > min_turn;
  const Vector3d across = shift - along * axis;
  const Vector3d to_axis =
      is_screw ? Vector3d((across + axis.cross(across) / std::tan(turn.angle() / 2)) / 2) : Vector3d::Zero();
  const auto at = [&](double part) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(part * turn.angle(), axis).toRotationMatrix();
    const Vector3d moved =
        is_screw ? Vector3d(part * along * axis + to_axis - R * to_axis) : Vector3d(part * shift);
    OrientedBox box = oriented(before, pair.plate);
    box.center += moved;
    box.axes = R * box.axes;
    return box;
  };
  const Box origin{Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  const OrientedBox still = oriented(origin, pair.other), first = at(0), last = at(1);
  const double way =
      std::abs(turn.angle()) * (to_axis.norm() + radius(first)) + (is_screw ? std::abs(along) : shift.norm());
  if (!overlap(first, still, -way)) return false;
  const bool touches = overlap(first, still) || overlap(last, still);
  const double depth = (touches ? 1 : unseen) * all_.half_thickness;
  if (overlap(first, still, depth)) return false;
  const double least = all_.half_thickness / (2 * way);
  for (double part = 0; part < 1;) {
    const OrientedBox box = at(part);
    if (overlap(box, still, depth)) return true;
    part += std::max(least, separation(box, still) / way);
  }
  return false;
}

bool ContactSearch::went_through(const PlatePair& pair, const Box& before, const Box& after) const {
  const Extent then = extent_of(before, pair.plate), now = extent_of(after, pair.plate);
  if (then.stays_beside(now, all_.half_thickness)) return false;
  for (const ContactPoint& point : all_.points) {
    const Vector3d from = point_of(before, pair.plate, point), to = point_of(after, pair.plate, point);
    if (!is_within(from, pair.other, passing_margin)) continue;
    if (side_of(from, pair.other) * side_of(to, pair.other) < 0) return true;
    if (!all_.planar && is_over(from, pair.other) && is_past_edge(to, pair.other)) return true;
  }
  return false;
}

std::vector<ContactSearch::PlatePair> ContactSearch::pairs_between(const State& before, const State& after,
                                                                   std::vector<Box>& from) {
  const bool kept = moved_.keeps_apart(before, near_margin) && moved_.keeps_apart(after, near_margin);
  place(before);
  std::vector<PlatePair> near = kept ? near_ : pairs_within(passing_margin);
  from.reserve(near.size());
  for (const PlatePair& pair : near) from.push_back(in_box(pair));
  place(after);
  return near;
}

bool ContactSearch::passed_through(const State& before, const State& after) {
  std::vector<Box> from;
  const std::vector<PlatePair> near = pairs_between(before, after, from);
  for (std::size_t k = 0; k < near.size(); ++k)
    if (went_through(near[k], from[k], in_box(near[k]))) return true;
  return false;
}

bool ContactSearch::sweep_through(const State& before, const State& after) {
  std::vector<Box> from;
  const std::vector<PlatePair> near = pairs_between(before, after, from);
  for (std::size_t k = 0; k < near.size(); ++k) {
    // Each pair once: the other plate has the same relative motion.
    const PlatePair back{near[k].other, near[k].plate};
    if (back < near[k] && std::binary_search(near.begin(), near.end(), back)) continue;
    const Box to = in_box(near[k]);
    if (!stays_off(near[k], from[k], to) && sweeps_through(near[k], from[k], to)) return true;
  }
  return false;
}

namespace {

using Eigen::Matrix3d;

}  // namespace

ContactModel::ContactModel(const Linkage& structure, bool planar)
    : search_(structure, planar), weight_(planar ? 1.0 : 1.0 / 3) {}

PointGap ContactModel::gap(const Contact& c, const State& state) const {
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const Pose& pose = state[plate.body];
  const Pose& frame = state[box.body];
  PointGap gap;
  gap.n = frame.R * box.face_normal(c.face);
  gap.a = pose.R * plate.place(all().points[c.point]);
  gap.m = (pose.p - frame.p) / all().edge_mm + gap.a;
  gap.value = gap.n.dot(gap.m) - all().face_offset(box, c.face);
  return gap;
}

Element ContactModel::element(const Contact& contact, double stiffness, const State& state) const {
  return gap(contact, state).pressed(weight_ * stiffness);
}

double ContactModel::energy(const std::vector<Contact>& contacts, double stiffness) const {
  double sum = 0;
  for (const Contact& c : contacts) sum += 0.5 * weight_ * stiffness * c.depth * c.depth;
  return sum;
}

ContactModel::ByTwoHinges ContactModel::gap_gradient(const PointGap& g, const Contact& c,
                                                     const State& state) const {
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const ContactPoint& point = all().points[c.point];
  const Matrix3d &R = state[plate.body].R, &frame = state[box.body].R;
  ByTwoHinges out;
  out << plate.sign * g.n.dot(R * plate.place_length_rate(point)), g.n.dot(R * plate.place_alpha_rate(point)),
      g.n.dot(R * plate.place_rate(point)), -box.sign * ContactPlates::face_offset_rate(box, c.face),
      g.m.dot(frame * box.face_normal_alpha_rate(c.face)) -
          ContactPlates::face_offset_alpha_rate(box, c.face),
      g.m.dot(frame * box.face_normal_rate(c.face));
  return out;
}

ContactModel::ByTwoHinges ContactModel::depth_gradient(const Contact& c, const State& state) const {
  return -gap_gradient(gap(c, state), c, state);
}

Eigen::Matrix<double, 12, 6> ContactModel::derivatives(const Contact& c, double stiffness,
                                                       const State& state) const {
  const PointGap g = gap(c, state);
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const ContactPoint& point = all().points[c.point];
  const Matrix3d &R = state[plate.body].R, &frame = state[box.body].R;
  const Vector3d none = Vector3d::Zero();
  const auto by_point = [&](const Vector3d& moved) -> Vector12 {
    return g.gradient_change(none, R * moved, R * moved);
  };
  const auto by_normal = [&](const Vector3d& turned) -> Vector12 {
    return g.gradient_change(frame * turned, none, none);
  };
  Eigen::Matrix<double, 12, 6> out;
  out << by_point(plate.sign * plate.place_length_rate(point)), by_point(plate.place_alpha_rate(point)),
      by_point(plate.place_rate(point)), Vector12::Zero(), by_normal(box.face_normal_alpha_rate(c.face)),
      by_normal(box.face_normal_rate(c.face));
  const ByTwoHinges value = gap_gradient(g, c, state);
  return weight_ * stiffness * (g.value * out + g.gradient() * value.transpose());
}

Vector12 ContactModel::stiffness_rate(const Contact& contact, const State& state) const {
  const PointGap g = gap(contact, state);
  return weight_ * g.value * g.gradient();
}

}  // namespace kinetix::model
