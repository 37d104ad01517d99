#include "model/contact/certified_range.hpp"

#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/contact/swept_motion.hpp"

namespace kinetix::model {
namespace {

/// Data of a linkage common to all states, for proofs that its plates stay apart.
struct LinkagePlates : LinkageMotion {
  /// @param structure kept by reference   @param turns one per hinge   @param growth_mm growth of every plate on all
  /// sides
  LinkagePlates(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm);

  /// Returns true if a pair must be examined: not of one wall, and not touching at rest. @pre plates of two bodies
  bool can_touch(const WallPair& pair) const;

  std::vector<HalfWall> walls;              ///< with growth
  WallContact at_rest;                      ///< without growth
  std::vector<std::vector<int>> plates_of;  ///< plates of each body
  std::vector<double> reach;                ///< largest distance of each body's plates from its vertex, mm
};

/// Two bodies, the hinges from the first to the second, and their plates that are not yet proven apart.
struct PlatesOfPair {
  int first = 0, second = 0;
  HingeChain chain;
  std::vector<WallPair> walls;
};

/// Two bodies within an interval of theta, each in the other's frame.
class SweptPair {
 public:
  /// @param plates, interval, pair kept by reference   @param margin_mm required distance of the plates
  SweptPair(const LinkagePlates& plates, const ThetaInterval& interval, const PlatesOfPair& pair,
            double margin_mm);

  /// Returns true if all plates are proven to stay apart over the interval, by the spheres around the bodies.
  bool is_apart() const;
  /// Returns true if two plates are proven apart, by their spheres or by a separating direction. @pre one of each
  /// body
  bool is_apart(const WallPair& walls);

 private:
  bool is_apart_from_there(const OrientedBox& own, const OrientedBox& other);

  const LinkagePlates& plates_;
  const ThetaInterval& interval_;
  const PlatesOfPair& pair_;
  double margin_mm_;
  Pose second_;                      ///< pose of the second body in the first one's frame
  SweptMotion there_;                ///< motion of the second body in the first one's frame
  std::optional<SweptMotion> back_;  ///< motion of the first body in the second one's frame
};

LinkagePlates::LinkagePlates(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm)
    : LinkageMotion(structure, turns),
      walls(half_walls(structure)),
      at_rest(structure),
      plates_of(structure.bodies.size()),
      reach(structure.bodies.size()) {
  for (int k = 0; k < static_cast<int>(walls.size()); ++k) {
    HalfWall& wall = walls[k];
    // A slanted end that moves out by this distance moves farther along the edge.
    wall.box.half += growth_mm * Eigen::Vector3d(std::hypot(1, wall.box.slant), 1, 1);
    plates_of[wall.body].push_back(k);
    reach[wall.body] = std::max(reach[wall.body], wall.box.center.norm() + radius(wall.box));
  }
}

bool LinkagePlates::can_touch(const WallPair& pair) const {
  return walls[pair.first].hinge != walls[pair.second].hinge &&
         !std::binary_search(at_rest.touching_at_rest().begin(), at_rest.touching_at_rest().end(), pair);
}

/// A box at rest and a box that moves relative to it. Both are in the frame of the first one's body, in the middle of
/// an interval of theta, mm.
struct SweptBoxes {
  const OrientedBox& still;
  const OrientedBox& moving;
  const SweptMotion& motion;
  double half_width;  ///< of the interval, rad
  double margin;      ///< required distance, mm
};

using Eigen::Vector3d;

// Length of a cross product of unit vectors: below it, rounding dominates
constexpr double no_direction = 1e-6;

class SweptGap {
 public:
  explicit SweptGap(const SweptBoxes& boxes)
      : boxes_(boxes),
        apart_(boxes.moving.center - boxes.still.center),
        speed_(boxes.motion.speed(boxes.moving.center)),
        lost_(boxes.margin + boxes.motion.change(boxes.moving.center, radius(boxes.moving)) *
                                 boxes.half_width * boxes.half_width / 2) {}

  /// @param direction unit
  bool along(Vector3d direction) const {
    if (direction.dot(apart_) < 0) direction = -direction;
    const double free = direction.dot(apart_) - support(boxes_.still, direction) - lost_;
    const Vector3d turned = direction.cross(boxes_.motion.omega());
    const auto gap = [&](double tau) {
      return free + tau * direction.dot(speed_) - support(boxes_.moving, -direction - tau * turned);
    };
    return gap(boxes_.half_width) > 0 && gap(-boxes_.half_width) > 0;
  }

 private:
  const SweptBoxes& boxes_;
  Vector3d apart_, speed_;
  double lost_;  ///< mm: margin, and the deviation from the straight path
};

/// Returns true if one face normal of the box at rest proves that the two boxes stay apart over the whole interval.
/// Along a direction n the gap at theta = middle + tau is at least
///   n . (c + tau c') - s(-(n + tau n x w)) - (that of the box at rest along n) - change half_width^2 / 2.
/// The convex function s is the reach of the moving box from its center along a direction. The bound `change` is that
/// of the second derivative of every corner. The gap is concave in tau, so its minimum is at an end.
bool stay_apart_by_faces(const SweptBoxes& boxes) {
  const SweptGap gap(boxes);
  for (const Vector3d& normal : face_normals(boxes.still))
    if (gap.along(normal)) return true;
  return false;
}

/// Returns true if a direction normal to an edge of each box proves that they stay apart over the interval.
bool stay_apart_by_edges(const SweptBoxes& boxes) {
  const SweptGap gap(boxes);
  for (const Vector3d& still : edge_directions(boxes.still))
    for (const Vector3d& moving : edge_directions(boxes.moving)) {
      const Vector3d across = still.cross(moving);
      const double length = across.norm();
      if (length > no_direction && gap.along(across / length)) return true;
    }
  return false;
}

SweptPair::SweptPair(const LinkagePlates& plates, const ThetaInterval& interval, const PlatesOfPair& pair,
                     double margin_mm)
    : plates_(plates),
      interval_(interval),
      pair_(pair),
      margin_mm_(margin_mm),
      second_(interval.relative(pair.first, pair.second)),
      there_(interval.motion(pair.first, pair.chain)) {}

bool SweptPair::is_apart() const {
  const double reach = plates_.reach[pair_.first] + plates_.reach[pair_.second];
  return second_.p.norm() - reach - there_.travel(second_.p, plates_.reach[pair_.second]) > margin_mm_;
}

bool SweptPair::is_apart(const WallPair& walls) {
  const bool in_order = plates_.walls[walls.first].body == pair_.first;
  const OrientedBox& own = plates_.walls[in_order ? walls.first : walls.second].box;
  const HalfWall& other = plates_.walls[in_order ? walls.second : walls.first];
  const Eigen::Vector3d center = second_.p + second_.R * other.box.center;
  const double around = radius(other.box);
  if ((center - own.center).norm() - radius(own) - around - there_.travel(center, around) > margin_mm_)
    return true;
  const OrientedBox moving = placed(other, second_);
  const SweptBoxes forth{own, moving, there_, interval_.half_width(), margin_mm_};
  return stay_apart_by_faces(forth) || is_apart_from_there(own, other.box) || stay_apart_by_edges(forth);
}

bool SweptPair::is_apart_from_there(const OrientedBox& own, const OrientedBox& other) {
  if (!back_) back_ = interval_.motion(pair_.second, reversed(pair_.chain));
  const Pose first = interval_.relative(pair_.second, pair_.first);
  const OrientedBox moving{first.p + first.R * own.center, first.R * own.axes, own.half, own.slant};
  return stay_apart_by_faces({other, moving, *back_, interval_.half_width(), margin_mm_});
}

// Rad, widest interval that is examined as a whole: about a sixteenth of a right angle
constexpr double widest_interval = 0.1;
// Cell edges: above the rounding of poses of thousands of bodies, as in WallContact
constexpr double rounding = 1e-9;
// Cell edges, largest motion of bodies in such an interval: keeps neighbours few
constexpr double wander = 1;
constexpr double contact_near = 0.01;  // ratio to theta: range beyond the end in which an overlap is searched

/// Search to one side of flat.
class CertifiedSide {
 public:
  CertifiedSide(LinkagePlates& plates, const ExactMotion& exact, const CertifiedOptions& options, double sign,
                ContactRange& out)
      : plates_(plates), exact_(exact), options_(options), sign_(sign), out_(out) {}

  ContactLimit run() {
    double free = 0;
    double width = widest_interval;
    while (free < options_.limit && states_ < options_.max_states) {
      const double next = std::min(free + width, options_.limit);
      const ThetaInterval interval = at(free, next);
      if (!is_finite(interval.state()) || !is_finite(exact_.at(sign_ * next)) || !is_lawful(interval)) break;
      const auto suspects = near_pairs(interval);
      if (is_stopped()) break;
      if (!suspects) {
        width /= 2;
        continue;
      }
      if (auto end = split(free, next, *suspects)) return *end;
      free = next;
    }
    return {sign_ * free, false, {}};
  }

 private:
  bool is_stopped() {
    if (options_.stop.stop_requested()) out_.why_not = "the run was stopped before it was computed";
    return !out_;
  }

  ThetaInterval at(double low, double high) {
    ++states_;
    ++out_.states;
    return {plates_, exact_, sign_, low, high};
  }

  /// Returns true if the state turns its hinges by their laws. Records the remaining misfit.
  bool is_lawful(const ThetaInterval& interval) {
    const LawDeviation there = interval.deviation();
    if (there.hinge >= 0) {
      out_.why_not = "the hinge on wall " + plates_.structure.wall_name(there.hinge) +
                     " does not turn as its family has it";
      return false;
    }
    gap_ = std::max(gap_, there.gap);
    off_ = std::max(off_, there.off);
    return true;
  }

  double margin(const HingeChain& chain) const {
    return plates_.edge() * rounding + plates_.margin_mm(chain.size(), gap_, off_);
  }

  /// Returns a bound of the displacement of each body's plates over the interval, mm.
  std::vector<double> travel_of_bodies(const ThetaInterval& interval) const {
    std::vector<double> out;
    const std::vector<SweptMotion> motions = interval.motions();
    for (std::size_t b = 0; b < motions.size(); ++b)
      out.push_back(motions[b].travel(interval.state()[b].p, plates_.reach[b]));
    return out;
  }

  /// Returns the pairs that may meet within the interval; empty if bodies move too far to find neighbours.
  std::optional<std::vector<PlatesOfPair>> near_pairs(const ThetaInterval& interval) {
    const std::vector<double> travel = travel_of_bodies(interval);
    const double most = *std::max_element(travel.begin(), travel.end());
    if (!(most <= wander * plates_.edge()) && interval.half_width() > options_.precision) return std::nullopt;
    Eigen::Matrix3Xd places(3, interval.state().size());
    double far = 0;
    for (std::size_t b = 0; b < interval.state().size(); ++b) {
      places.col(b) = interval.state()[b].p;
      far = std::max(far, 2 * (plates_.reach[b] + travel[b]));
    }
    std::vector<std::vector<int>> partners(interval.state().size());
    for (const auto& [a, b] : near_.find(places, far + rounding * plates_.edge()))
      if ((places.col(a) - places.col(b)).norm() <=
          plates_.reach[a] + plates_.reach[b] + travel[a] + travel[b])
        partners[a].push_back(b);
    std::vector<PlatesOfPair> all;
    for (int a = 0; a < static_cast<int>(partners.size()) && !is_stopped(); ++a)
      add_suspects(interval, a, partners[a], all);
    return all;
  }

  void add_suspects(const ThetaInterval& interval, int body, std::vector<int>& partners,
                    std::vector<PlatesOfPair>& all) {
    std::sort(partners.begin(), partners.end());
    const std::vector<HingeChain>& chains = plates_.chains.find(body, partners);
    for (std::size_t k = 0; k < partners.size(); ++k) {
      PlatesOfPair pair{body, partners[k], chains[k], {}};
      for (const int p : plates_.plates_of[body])
        for (const int q : plates_.plates_of[partners[k]])
          if (const WallPair walls{std::min(p, q), std::max(p, q)}; plates_.can_touch(walls))
            pair.walls.push_back(walls);
      keep_unproven(interval, pair);
      if (!pair.walls.empty()) all.push_back(std::move(pair));
    }
  }

  /// Removes the pairs of plates that are proven apart over the interval.
  void keep_unproven(const ThetaInterval& interval, PlatesOfPair& pair) const {
    SweptPair bodies(plates_, interval, pair, margin(pair.chain));
    if (bodies.is_apart()) return pair.walls.clear();
    std::erase_if(pair.walls, [&](const WallPair& walls) { return bodies.is_apart(walls); });
  }

  /// @param suspects pairs that are unproven over the whole interval
  std::optional<ContactLimit> split(double low, double high, const std::vector<PlatesOfPair>& suspects) {
    if (suspects.empty()) return std::nullopt;
    if (high - low <= options_.precision || states_ >= options_.max_states) return end_at(low, suspects);
    const double middle = (low + high) / 2;
    if (auto end = look(low, middle, suspects)) return end;
    return look(middle, high, suspects);
  }

  std::optional<ContactLimit> look(double low, double high, const std::vector<PlatesOfPair>& suspects) {
    const ThetaInterval interval = at(low, high);
    if (is_stopped()) return end_at(low, suspects);
    std::vector<PlatesOfPair> left;
    for (PlatesOfPair pair : suspects) {
      keep_unproven(interval, pair);
      if (!pair.walls.empty()) left.push_back(std::move(pair));
    }
    return split(low, high, left);
  }

  /// Searches for an overlap of these pairs, as near to `low` as possible.
  ContactLimit end_at(double low, const std::vector<PlatesOfPair>& suspects) {
    std::vector<WallPair> pairs;
    for (const PlatesOfPair& s : suspects) pairs.insert(pairs.end(), s.walls.begin(), s.walls.end());
    ContactLimit end{sign_ * low, true, pairs.front()};
    double free = low, hit = low;
    for (double ahead = options_.precision; free <= low * (1 + contact_near); ahead *= 2) {
      hit = low + ahead;
      if (!overlapping(hit, pairs).empty()) break;
      free = hit;
    }
    std::vector<WallPair> found = overlapping(hit, pairs);
    if (found.empty()) return end;
    while (hit - free > options_.precision) {
      const double middle = (free + hit) / 2;
      std::vector<WallPair> earlier = overlapping(middle, found);
      (earlier.empty() ? free : hit) = middle;
      if (!earlier.empty()) found = std::move(earlier);
    }
    end.walls = found.front();
    end.contact = sign_ * hit;
    return end;
  }

  std::vector<WallPair> overlapping(double angle, const std::vector<WallPair>& pairs) {
    const State state = exact_.at(sign_ * angle);
    ++out_.states;
    const auto box = [&](int wall) { return placed(plates_.walls[wall], state[plates_.walls[wall].body]); };
    std::vector<WallPair> found;
    for (const WallPair& pair : pairs)
      if (overlap(box(pair.first), box(pair.second), rounding * plates_.edge())) found.push_back(pair);
    return found;
  }

  LinkagePlates& plates_;
  const ExactMotion& exact_;
  const CertifiedOptions& options_;
  double sign_;
  ContactRange& out_;
  int states_ = 0;
  double gap_ = 0;  ///< cell edges, largest joint separation of a state
  double off_ = 0;  ///< rad, largest misfit of axes and turns of a state
  NearPairs near_;
};

}  // namespace

void CertifiedOptions::validate() const {
  if (!(limit > 0) || !(limit <= pi / 2))
    throw InvalidInput("the limit of the fold angle must lie in (0, 90] deg");
  if (!(precision >= 1e-12)) throw InvalidInput("the precision of the fold angle must be at least 1e-12 rad");
  if (!(growth_mm >= 0)) throw InvalidInput("the growth of walls must be at least 0 mm");
  if (!(max_states > 0)) throw InvalidInput("the number of states must be above 0");
}

ContactRange certified_range(const Linkage& structure, const ExactMotion& exact,
                             const std::vector<TurnLaw>& turns, const CertifiedOptions& options) {
  options.validate();
  ContactRange out;
  out.growth_mm = options.growth_mm;
  if (!exact) {
    out.why_not = exact.why;
    return out;
  }
  LinkagePlates plates(structure, turns, options.growth_mm);
  out.touching_at_rest = plates.at_rest.touching_at_rest();
  if (const int loose = plates.unconnected_body(); loose >= 0) {
    out.why_not = "no hinges join the body at " + structure.vertex_name(loose) + " to the others";
    return out;
  }
  if (const auto& overlap = plates.at_rest.overlap_at_rest()) {
    out.negative = out.positive = {0, true, *overlap, 0};
    return out;
  }
  out.negative = CertifiedSide(plates, exact, options, -1, out).run();
  out.positive = CertifiedSide(plates, exact, options, 1, out).run();
  if (!out) out.negative = out.positive = {};
  return out;
}

}  // namespace kinetix::model
