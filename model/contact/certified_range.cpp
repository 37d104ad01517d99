#include "model/contact/certified_range.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/contact/swept_boxes.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double widest_interval =
    0.1;  // rad, of an interval that is looked at as a whole: a sixteenth of a right angle
constexpr double rounding =
    1e-9;  // cell edges: of poses of thousands of bodies is below it, as in WallContact
constexpr double wander =
    1;  // cell edges, by which bodies may move in such an interval: keeps neighbours few
constexpr double lawful =
    1e-6;  // rad, by which a state may turn a hinge otherwise: files have angles to 1e-9
constexpr double contact_near = 0.01;  // of theta: how far beyond the end an overlap is looked for

/// Plates of two bodies that are not yet proven apart, and the hinges from the first body to the second.
struct Suspects {
  int first = 0, second = 0;
  HingeChain chain;
  std::vector<WallPair> walls;
};

/// All that stays the same from state to state.
class Parts {
 public:
  Parts(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm)
      : structure(structure), walls(half_walls(structure)), chains(structure) {
    touching = WallContact(structure).touching_at_rest();
    plates_of.resize(structure.bodies.size());
    reach.resize(structure.bodies.size());
    for (int k = 0; k < static_cast<int>(walls.size()); ++k) {
      HalfWall& wall = walls[k];
      wall.box.half.array() += growth_mm;
      plates_of[wall.body].push_back(k);
      reach[wall.body] = std::max(reach[wall.body], wall.box.center.norm() + wall.box.half.norm());
    }
    std::map<std::pair<double, double>, int> known;
    for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
      const auto [at, is_new] = known.try_emplace({turns[h].p, turns[h].q}, static_cast<int>(laws.size()));
      if (is_new) laws.push_back(turns[h]);
      law_of.push_back(at->second);
      senses.push_back(hinge_sense(structure, h));
      const RestHinge& hinge = structure.hinges[h];
      longest_arm = std::max({longest_arm, hinge.lower_arm.norm(), hinge.upper_arm.norm()});
    }
    links = chains.tree(middle_body());
  }

  double edge() const { return structure.size.edge_mm; }

  bool can_touch(const WallPair& pair) const {
    return walls[pair.first].hinge != walls[pair.second].hinge &&
           !std::binary_search(touching.begin(), touching.end(), pair);
  }

  int middle_body() const {
    Vector3d middle = Vector3d::Zero();
    for (const LinkageBody& body : structure.bodies) middle += body.position;
    middle /= static_cast<double>(structure.bodies.size());
    const auto nearer = [&](const LinkageBody& a, const LinkageBody& b) {
      return (a.position - middle).squaredNorm() < (b.position - middle).squaredNorm();
    };
    return static_cast<int>(std::min_element(structure.bodies.begin(), structure.bodies.end(), nearer) -
                            structure.bodies.begin());
  }

  const Linkage& structure;
  std::vector<TurnLaw> laws;    ///< each once
  std::vector<int> law_of;      ///< each hinge
  std::vector<HalfWall> walls;  ///< grown
  std::vector<WallPair> touching;
  std::vector<std::vector<int>> plates_of;  ///< each body
  std::vector<double> reach;                ///< of each body's plates from its vertex, mm
  std::vector<int> senses;                  ///< of each hinge
  double longest_arm = 0;                   ///< cell edges
  HingeChains chains;
  std::vector<HingeChains::Link> links;  ///< from the middle body outwards
};

/// Interval of theta to one side of flat, and the state in its middle.
class Interval {
 public:
  Interval(const Parts& parts, const ExactMotion& exact, double sign, double low, double high)
      : parts_(parts),
        half_width(std::nextafter((high - low) / 2, high)),
        theta(sign * (low + high) / 2),
        state(exact.at(theta)) {
    for (const TurnLaw& law : parts.laws) {
      rates_.push_back(law.rate(theta));
      bounds_.push_back(bounds_of(law, theta - half_width, theta + half_width));
    }
  }

  /// Body `second` as `first` sees it.
  SweptMotion motion(int first, const HingeChain& chain) const {
    const Pose& frame = state[first];
    SweptMotion motion(half_width);
    for (const ChainStep& step : chain) pass(step, frame, motion);
    return motion;
  }

  /// A hinge, in the frame of a pose.
  void pass(const ChainStep& step, const Pose& frame, SweptMotion& motion) const {
    const RestHinge& hinge = parts_.structure.hinges[step.hinge];
    const Pose& lower = state[hinge.lower];
    const int law = parts_.law_of[step.hinge];
    const Vector3d point = lower.p + lower.R * hinge.lower_arm * parts_.edge();
    motion.pass(frame.R.transpose() * (point - frame.p), frame.R.transpose() * (lower.R * hinge.axis),
                step.sense * parts_.senses[step.hinge] * rates_[law], bounds_[law]);
  }

  Pose relative(int first, int second) const {
    const Eigen::Matrix3d back = state[first].R.transpose();
    return {back * state[second].R, back * (state[second].p - state[first].p)};
  }

 private:
  const Parts& parts_;
  std::vector<double> rates_;       ///< of each law in the middle, rad per rad
  std::vector<TurnBounds> bounds_;  ///< of each law over the interval

 public:
  double half_width;  ///< rad, rounded up
  double theta;       ///< rad, of its middle
  State state;
};

/// Two bodies within an interval, each as the other sees it.
class BodyPair {
 public:
  BodyPair(const Parts& parts, const Interval& interval, const Suspects& pair, double margin_mm)
      : parts_(parts),
        interval_(interval),
        pair_(pair),
        margin_mm_(margin_mm),
        second_(interval.relative(pair.first, pair.second)),
        there_(interval.motion(pair.first, pair.chain)) {}

  bool is_apart() const {
    const double reach = parts_.reach[pair_.first] + parts_.reach[pair_.second];
    return second_.p.norm() - reach - there_.way(second_.p, parts_.reach[pair_.second]) > margin_mm_;
  }

  bool is_apart(const WallPair& walls) {
    const bool in_order = parts_.walls[walls.first].body == pair_.first;
    const OrientedBox& own = parts_.walls[in_order ? walls.first : walls.second].box;
    const HalfWall& other = parts_.walls[in_order ? walls.second : walls.first];
    const Vector3d center = second_.p + second_.R * other.box.center;
    const double radius = other.box.half.norm();
    if ((center - own.center).norm() - own.half.norm() - radius - there_.way(center, radius) > margin_mm_)
      return true;
    const OrientedBox moving = placed(other, second_);
    const SweptBoxes forth{own, moving, there_, interval_.half_width, margin_mm_};
    return stay_apart_by_faces(forth) || is_apart_from_there(own, other.box) || stay_apart_by_edges(forth);
  }

 private:
  bool is_apart_from_there(const OrientedBox& own, const OrientedBox& other) {
    if (!back_) back_ = interval_.motion(pair_.second, reversed(pair_.chain));
    const Pose first = interval_.relative(pair_.second, pair_.first);
    const OrientedBox moving{first.p + first.R * own.center, first.R * own.axes, own.half};
    return stay_apart_by_faces({other, moving, *back_, interval_.half_width, margin_mm_});
  }

  const Parts& parts_;
  const Interval& interval_;
  const Suspects& pair_;
  double margin_mm_;
  Pose second_;                      ///< as the first one sees it
  SweptMotion there_;                ///< of the second one, likewise
  std::optional<SweptMotion> back_;  ///< of the first one, as the second one sees it
};

/// The search to one side of flat.
class CertifiedSide {
 public:
  CertifiedSide(Parts& parts, const ExactMotion& exact, const CertifiedOptions& options, double sign,
                CertifiedRange& out)
      : parts_(parts), exact_(exact), options_(options), sign_(sign), out_(out) {}

  CertifiedLimit run() {
    double free = 0;
    double width = widest_interval;
    while (free < options_.limit && out_.why_not.empty()) {
      const double next = std::min(free + width, options_.limit);
      const Interval interval = at(free, next);
      if (!is_lawful(interval)) return {sign_ * free, true, {}};
      const auto suspects = near_pairs(interval);
      if (!suspects) {
        width /= 2;
        continue;
      }
      if (auto end = split(free, next, *suspects)) return *end;
      free = next;
    }
    return {sign_ * free, free < options_.limit, {}};
  }

 private:
  Interval at(double low, double high) {
    ++states_;
    ++out_.states;
    return {parts_, exact_, sign_, low, high};
  }

  /// Whether the state turns its hinges as the laws say; measures what it leaves open.
  bool is_lawful(const Interval& interval) {
    if (!is_finite(interval.state)) {
      out_.why_not = "the exact motion ends in states that are no numbers";
      return false;
    }
    const HingeGaps gaps = hinge_gaps(parts_.structure, interval.state);
    double off = gaps.axis_max;
    for (std::size_t h = 0; h < parts_.structure.hinges.size(); ++h) {
      const RestHinge& hinge = parts_.structure.hinges[h];
      const Eigen::AngleAxisd turn(parts_.senses[h] * parts_.laws[parts_.law_of[h]].turn(interval.theta),
                                   hinge.axis);
      const Eigen::Matrix3d upper = interval.state[hinge.lower].R * turn.toRotationMatrix();
      off = std::max(off, (upper - interval.state[hinge.upper].R).norm());
      if (off <= lawful) continue;
      out_.why_not = "the hinge on wall " + parts_.structure.wall_name(static_cast<int>(h)) +
                     " does not turn as its family has it";
      return false;
    }
    gap_ = std::max(gap_, gaps.max);
    off_ = std::max(off_, off);
    return true;
  }

  double margin(const HingeChain& chain) const {
    const double steps = static_cast<double>(chain.size()) + 1;
    return parts_.edge() * (rounding + steps * (gap_ + off_ * 2 * steps * parts_.longest_arm));
  }

  /// How far each body's plates may get from where they are, mm.
  std::vector<double> ways(const Interval& interval) const {
    const int root = parts_.links.empty() ? 0 : parts_.links.front().parent;
    std::vector<SweptMotion> motions(parts_.structure.bodies.size(), SweptMotion(interval.half_width));
    const Pose& pose = interval.state[root];
    motions[root].turn_about(pose.p, pose.R * parts_.structure.bodies[root].first_turn());
    std::vector<double> out(motions.size());
    out[root] = motions[root].way(pose.p, parts_.reach[root]);
    for (const HingeChains::Link& link : parts_.links) {
      motions[link.body] = motions[link.parent];
      interval.pass(link.step, {}, motions[link.body]);
      out[link.body] = motions[link.body].way(interval.state[link.body].p, parts_.reach[link.body]);
    }
    return out;
  }

  /// Those that may meet within the interval; nothing where bodies move too far in it to tell neighbours.
  std::optional<std::vector<Suspects>> near_pairs(const Interval& interval) {
    const std::vector<double> way = ways(interval);
    const double most = *std::max_element(way.begin(), way.end());
    if (!(most <= wander * parts_.edge()) && interval.half_width > options_.precision) return std::nullopt;
    Eigen::Matrix3Xd places(3, interval.state.size());
    double far = 0;
    for (std::size_t b = 0; b < interval.state.size(); ++b) {
      places.col(b) = interval.state[b].p;
      far = std::max(far, 2 * (parts_.reach[b] + way[b]));
    }
    std::vector<std::vector<int>> partners(interval.state.size());
    for (const auto& [a, b] : near_.find(places, far + rounding * parts_.edge()))
      if ((places.col(a) - places.col(b)).norm() <= parts_.reach[a] + parts_.reach[b] + way[a] + way[b])
        partners[a].push_back(b);
    std::vector<Suspects> all;
    for (int a = 0; a < static_cast<int>(partners.size()); ++a) add_suspects(interval, a, partners[a], all);
    return all;
  }

  void add_suspects(const Interval& interval, int body, std::vector<int>& partners,
                    std::vector<Suspects>& all) {
    std::sort(partners.begin(), partners.end());
    const std::vector<HingeChain>& chains = parts_.chains.find(body, partners);
    for (std::size_t k = 0; k < partners.size(); ++k) {
      Suspects pair{body, partners[k], chains[k], {}};
      for (const int p : parts_.plates_of[body])
        for (const int q : parts_.plates_of[partners[k]])
          if (const WallPair walls{std::min(p, q), std::max(p, q)}; parts_.can_touch(walls))
            pair.walls.push_back(walls);
      out_.pairs += static_cast<int>(pair.walls.size());
      keep_unproven(interval, pair);
      if (!pair.walls.empty()) all.push_back(std::move(pair));
    }
  }

  /// Leaves those pairs of plates that are not proven apart over the interval.
  void keep_unproven(const Interval& interval, Suspects& pair) const {
    BodyPair bodies(parts_, interval, pair, margin(pair.chain));
    if (bodies.is_apart()) return pair.walls.clear();
    std::erase_if(pair.walls, [&](const WallPair& walls) { return bodies.is_apart(walls); });
  }

  /// @param suspects what the whole interval leaves unproven
  std::optional<CertifiedLimit> split(double low, double high, const std::vector<Suspects>& suspects) {
    if (suspects.empty()) return std::nullopt;
    if (high - low <= options_.precision || states_ >= options_.most_states) return end_at(low, suspects);
    const double middle = (low + high) / 2;
    if (auto end = look(low, middle, suspects)) return end;
    return look(middle, high, suspects);
  }

  std::optional<CertifiedLimit> look(double low, double high, const std::vector<Suspects>& suspects) {
    const Interval interval = at(low, high);
    std::vector<Suspects> left;
    for (Suspects pair : suspects) {
      keep_unproven(interval, pair);
      if (!pair.walls.empty()) left.push_back(std::move(pair));
    }
    return split(low, high, left);
  }

  /// Looks for an overlap of these, the nearer the better.
  CertifiedLimit end_at(double low, const std::vector<Suspects>& suspects) {
    std::vector<WallPair> pairs;
    for (const Suspects& s : suspects) pairs.insert(pairs.end(), s.walls.begin(), s.walls.end());
    CertifiedLimit end{sign_ * low, true, pairs.front()};
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
    const auto box = [&](int wall) { return placed(parts_.walls[wall], state[parts_.walls[wall].body]); };
    std::vector<WallPair> found;
    for (const WallPair& pair : pairs)
      if (overlap(box(pair.first), box(pair.second), rounding * parts_.edge())) found.push_back(pair);
    return found;
  }

  Parts& parts_;
  const ExactMotion& exact_;
  const CertifiedOptions& options_;
  double sign_;
  CertifiedRange& out_;
  int states_ = 0;
  double gap_ = 0;  ///< cell edges, the largest that a state left open at a hinge
  double off_ = 0;  ///< rad, likewise of axes and turns
  NearPairs near_;
};

}  // namespace

void CertifiedOptions::validate() const {
  if (!(limit > 0) || !(limit <= pi / 2)) throw InvalidInput("the limit of theta must lie in (0, 90] deg");
  if (!(precision >= 1e-12)) throw InvalidInput("the precision of theta must be at least 1e-12 rad");
  if (!(growth_mm >= 0)) throw InvalidInput("the growth of walls must be at least 0 mm");
  if (!(most_states > 0)) throw InvalidInput("the number of states must be above 0");
}

CertifiedRange certified_range(const Linkage& structure, const ExactMotion& exact,
                               const std::vector<TurnLaw>& turns, const CertifiedOptions& options) {
  options.validate();
  CertifiedRange out;
  out.growth_mm = options.growth_mm;
  if (!exact) {
    out.why_not = exact.why;
    return out;
  }
  Parts parts(structure, turns, options.growth_mm);
  out.left_out = static_cast<int>(parts.touching.size());
  out.negative = CertifiedSide(parts, exact, options, -1, out).run();
  out.positive = CertifiedSide(parts, exact, options, 1, out).run();
  if (!out) out.negative = out.positive = {};
  return out;
}

}  // namespace kinetix::model
