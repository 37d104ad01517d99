#include "app/print/sheet/part_distances.hpp"

#include "model/contact/wall_contact.hpp"

namespace kinetix::app {

using Eigen::Vector3d;

namespace {

constexpr double nothing_mm = 1e3;  // mm: distance if there are no two bodies

PathClearance no_parts_clearance() {
  PathClearance none;
  none.in_hinges.mm = none.elsewhere.mm = none.nearest.mm = none.flat_mm = nothing_mm;
  return none;
}

double clearance_of(const model::HingePrint& hinge) { return is_pin(hinge.made.kind) ? gap_mm(hinge) : 0; }

PlacedPiece placed(const PartPiece& piece, const model::State& state) {
  PlacedPiece out{piece, {}};
  for (const PieceEnd& end : piece.ends) out.poses.push_back(&state[end.body]);
  return out;
}

/// Returns the radius of a sphere about the middle of a piece's ends.
double radius(const PlacedPiece& at, const Vector3d& center) {
  double most = 0;
  for (std::size_t k = 0; k < at.poses.size(); ++k) {
    const PieceEnd& end = at.piece.ends[k];
    most = std::max(most, (at.poses[k]->R * end.center + at.poses[k]->p - center).norm() + end.radius);
  }
  return most;
}

}  // namespace

void update_least(const LeastDistance& other, LeastDistance& known) {
  if (other.excess_mm() < known.excess_mm()) known = other;
}

void update_nearest(const LeastDistance& other, LeastDistance& known) {
  if (other.mm < known.mm) known = other;
}

PairRules::PairRules(const PrintSheet& sheet, ClearanceSearch search)
    : sheet_(sheet),
      has_posts_only_(search == ClearanceSearch::verdict_of_posts),
      bodies_(static_cast<int>(sheet.bodies.size())),
      required_(sheet.bodies.size(), nothing_mm),
      hinged_(sheet.bodies.size()) {
  for (std::size_t h = 0; h < sheet.hinges.size(); ++h) {
    const model::RestHinge& hinge = sheet.linkage.hinges[h];
    const double clearance = clearance_of(sheet.hinges[h]);
    hinged_[std::min(hinge.lower, hinge.upper)].emplace_back(std::max(hinge.lower, hinge.upper), clearance);
    max_required_ = std::max(max_required_, clearance);
    if (clearance > 0)
      for (const int b : {hinge.lower, hinge.upper}) required_[b] = std::min(required_[b], clearance);
  }
}

std::optional<PartPair> PairRules::pair(int a, int b) const {
  if (a == b || is_joined_by(a, b) || is_joined_by(b, a)) return std::nullopt;
  if (has_posts_only_ && !sheet_.posts.contains(a) && !sheet_.posts.contains(b)) return std::nullopt;
  std::optional<double> clearance;
  if (const int lower = std::min(a, b); lower < bodies_)
    for (const auto& [upper, of_hinge] : hinged_[lower])
      if (upper == std::max(a, b)) clearance = of_hinge;
  if (clearance) return PartPair{a, b, true, *clearance};
  return PartPair{a, b, false, required_elsewhere(a, b)};
}

std::vector<int> PairRules::bodies_of(int part) const {
  if (part < bodies_) return {part};
  const model::RestHinge& hinge = sheet_.linkage.hinges[part - bodies_];
  return {hinge.lower, hinge.upper};
}

bool PairRules::is_joined_by(int soft, int body) const {
  if (soft < bodies_) return false;
  const model::RestHinge& hinge = sheet_.linkage.hinges[soft - bodies_];
  return hinge.lower == body || hinge.upper == body;
}

double PairRules::required_elsewhere(int a, int b) const {
  if (a >= bodies_ || b >= bodies_) return 0;
  const double least = std::min(required_[a], required_[b]);
  return least < nothing_mm ? least : 0;
}

PathClearance Distances::measured(double theta, const model::State& state) const {
  PathClearance least = no_parts_clearance();
  std::vector<PlacedPiece> all;
  std::vector<double> radii;
  Eigen::Matrix3Xd centers(3, parts.pieces.size());
  double reach = 0;  // mm
  for (std::size_t k = 0; k < parts.pieces.size(); ++k) {
    all.push_back(placed(parts.pieces[k], state));
    centers.col(k) = all.back().center();
    radii.push_back(radius(all.back(), centers.col(k)));
    reach = std::max(reach, 2 * radii.back() + (is_verdict(search_) ? rules.max_required() : 1));
  }
  model::NearPairs near;
  for (const auto& [a, b] : near.find(centers, reach)) {
    const double apart_mm = (centers.col(a) - centers.col(b)).norm() - radii[a] - radii[b];
    if (is_verdict(search_) && apart_mm >= rules.max_required()) continue;
    const auto pair = rules.pair(all[a].piece.part, all[b].piece.part);
    if (!pair) continue;
    LeastDistance& known = pair->is_hinged ? least.in_hinges : least.elsewhere;
    LeastDistance found{apart_mm, pair->first, pair->second, theta, Vector3d::Zero(), pair->required_mm};
    const bool counts = is_verdict(search_)
                            ? found.excess_mm() < 0
                            : found.excess_mm() < known.excess_mm() || found.mm < least.nearest.mm;
    if (!counts) continue;
    const PieceDistance there = piece_distance(all[a], all[b]);
    found.mm = there.mm;
    found.place = there.place;
    update_least(found, known);
    update_nearest(found, least.nearest);
  }
  compare_bores(theta, state, least);
  least.flat_mm = least.nearest.mm;
  return least;
}

void Distances::compare_bores(double theta, const model::State& state, PathClearance& least) const {
  for (std::size_t h = 0; h < sheet_.hinges.size(); ++h)
    if (is_pin(sheet_.hinges[h].made.kind)) compare_bore(h, theta, state, least);
}

void Distances::compare_bore(std::size_t h, double theta, const model::State& state,
                             PathClearance& least) const {
  const model::RestHinge& hinge = sheet_.linkage.hinges[h];
  const model::Pose &lower = state[hinge.lower], &upper = state[hinge.upper];
  const double edge = sheet_.linkage.size.edge_mm, clearance = sheet_.hinges[h].made.clearance_mm;
  const Vector3d axis = lower.R * hinge.axis, place = lower.p + edge * lower.R * hinge.lower_arm,
                 apart = upper.p + edge * upper.R * hinge.upper_arm - place;
  for (const double s : {-0.5, 0.5}) {
    const double high = s * sheet_.hinges[h].made.height_mm;
    const Vector3d gap = apart + high * (upper.R * hinge.axis - axis);
    const LeastDistance found{clearance - (gap - gap.dot(axis) * axis).norm(),
                              hinge.lower,
                              hinge.upper,
                              theta,
                              place + high * axis,
                              clearance};
    update_least(found, least.in_hinges);
    update_nearest(found, least.nearest);
  }
}

}  // namespace kinetix::app
