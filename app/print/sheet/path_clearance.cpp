#include "app/print/sheet/path_clearance.hpp"

#include <set>

#include "app/print/sheet/part_distances.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/contact/swept_motion.hpp"
#include "model/contact/wall_contact.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector3d;
using model::HingeChain;
using model::SweptHull;

constexpr double polygon_mm = 0.01;  // mm: distance of polygons from their circles
constexpr double first_rad = 2e-3;   // rad: 0.1 degrees, the precision of messages
constexpr double slack_mm = 0.005;   // mm: between two checked states, parts come nearer by at most this
constexpr double looked_mm = 1;      // mm: nearer parts are searched if no others are near
constexpr double wander = 1;         // cell edges that bodies may move in an interval: keeps neighbours few

constexpr int few = 4096;  // tasks: fewer are done before other threads have started

/// Runs tasks on all cores if there are enough of them.
void run_all(int count, const std::function<void(int)>& run) {
  model::run_in_parallel(count, count < few ? 1 : 0, run);
}

/// Pair of parts over an interval of the path.
struct Task {
  double low = 0, high = 0;
  PartPair pair;
};

/// Result of a task.
struct PairResult {
  std::vector<PiecePair> open;         // not proven
  std::optional<LeastDistance> least;  // of those that were measured
  bool is_uncertain = false;           // the path's margin exceeds the spare distance: halving does not help
};

/// Check of one pair of parts over an interval of the path.
class PairSearch {
 public:
  PairSearch(const MovingParts& parts, const MotionInterval& interval, const PartPair& pair,
             ClearanceSearch search)
      : parts_(parts), interval_(interval), pair_(pair), is_verdict_(is_verdict(search)) {
    for (std::size_t k = 1; k < pair.bodies.size(); ++k) {
      seen_.push_back(interval.seen(pair.bodies.front(), pair.bodies[k], pair.chains[k - 1]));
      margin_ = std::max(margin_, seen_.back().margin_mm);
    }
  }

  /// Compares all their pieces. @param goal_mm distance to prove   @param needed_mm distance to keep in any case
  PairResult compare(double goal_mm, double needed_mm) {
    needed_ = needed_mm + margin_;
    goal_ = std::max(goal_mm, needed_);
    if (!pair_.open.empty()) {
      for (const PiecePair& open : pair_.open) compare(open);
      return std::move(out_);
    }
    if (are_apart()) return std::move(out_);
    for (const int a : parts_.pieces_of[pair_.first])
      for (const int b : parts_.pieces_of[pair_.second]) compare({a, b});
    return std::move(out_);
  }

 private:
  /// Piece as the first body sees it, and a sphere around it.
  struct SeenPiece {
    SweptHull hull;
    Vector3d center = Vector3d::Zero();
    double radius = 0, travel = 0;  // mm
  };

  const SeenBody* seen(int body) const {
    for (std::size_t k = 1; k < pair_.bodies.size(); ++k)
      if (pair_.bodies[k] == body) return &seen_[k - 1];
    return nullptr;
  }

  SeenPiece see(const std::vector<const PieceEnd*>& ends) const {
    SeenPiece out;
    for (const PieceEnd* end : ends) {
      const SeenBody* there = seen(end->body);
      const model::Pose pose = there ? there->pose : model::Pose{};
      out.hull.push_back(
          {&end->points, pose, there ? &there->motion : nullptr, pose.R * end->center + pose.p, end->radius});
      out.center += out.hull.back().center / static_cast<double>(ends.size());
    }
    for (const model::SweptPoints& end : out.hull)
      out.radius = std::max(out.radius, (end.center - out.center).norm() + end.radius);
    out.travel = travel(out.hull);
    return out;
  }

  /// Returns a piece as the first body sees it. It is computed once.
  const SeenPiece& see(int piece) {
    const auto known =
        std::find_if(pieces_.begin(), pieces_.end(), [&](const auto& p) { return p.first == piece; });
    if (known != pieces_.end()) return *known->second;
    std::vector<const PieceEnd*> ends;
    for (const PieceEnd& end : parts_.pieces[piece].ends) ends.push_back(&end);
    return *pieces_.emplace_back(piece, std::make_unique<SeenPiece>(see(ends))).second;
  }

  static bool are_apart(const SeenPiece& a, const SeenPiece& b, double goal) {
    return (a.center - b.center).norm() - a.radius - b.radius - a.travel - b.travel >= goal;
  }

  /// Checks whether the spheres around the two parts are apart.
  bool are_apart() {
    const auto whole = [&](int part) {
      return part < parts_.bodies ? see(std::vector{&parts_.whole[part]})
                                  : see(parts_.pieces_of[part].front());
    };
    return are_apart(whole(pair_.first), whole(pair_.second), goal_);
  }

  void compare(PiecePair pair) {
    const SeenPiece &a = see(pair.first), &b = see(pair.second);
    if (are_apart(a, b, goal_)) return;
    const auto is_proven = [&] {
      return pair.normal != Vector3d::Zero() &&
             min_gap(a.hull, b.hull, pair.normal, interval_.half_width) >= goal_;
    };
    if (is_proven()) return;
    if (is_verdict_ && pair.normal == Vector3d::Zero() && a.center != b.center) {
      pair.normal = (b.center - a.center).normalized();
      if (is_proven()) return;
    }
    const PieceDistance found =
        piece_distance(placed(parts_.pieces[pair.first], a.hull), placed(parts_.pieces[pair.second], b.hull));
    note(found);
    pair.normal = found.normal;
    const double moved = a.travel + b.travel;
    if (is_proven() || found.mm - moved >= goal_) return;
    if (moved > slack_mm / 2 || found.mm - moved >= needed_)
      out_.open.push_back(pair);
    else
      out_.is_uncertain = true;
  }

  static PlacedPiece placed(const PartPiece& piece, const SweptHull& hull) {
    PlacedPiece out{piece, {}};
    for (const model::SweptPoints& end : hull) out.poses.push_back(&end.pose);
    return out;
  }

  void note(const PieceDistance& found) {
    if (out_.least && out_.least->mm <= found.mm) return;
    const model::Pose& eye = interval_.state[pair_.bodies.front()];
    out_.least = {found.mm,         pair_.first, pair_.second, interval_.theta, eye.R * found.place + eye.p,
                  pair_.required_mm};
  }

  const MovingParts& parts_;
  const MotionInterval& interval_;
  const PartPair& pair_;
  const bool is_verdict_;
  std::vector<SeenBody> seen_;
  std::vector<std::pair<int, std::unique_ptr<SeenPiece>>> pieces_;
  double margin_ = 0, goal_ = 0, needed_ = 0;
  PairResult out_;
};

double needed_mm(double required_mm) { return required_mm > 0 ? required_mm - polygon_mm : 0; }

/// Search from flat to the fold, in intervals. They are halved for the pairs that are not proven apart.
class PathSearch {
 public:
  PathSearch(const PrintSheet& sheet, const Distances& distances, ClearanceSearch search, PathClearance& all)
      : distances_(distances),
        search_(search),
        parts_(distances.parts),
        chains_(sheet.linkage),
        edge_(sheet.linkage.size.edge_mm),
        all_(all) {
    for (const PieceEnd& body : parts_.whole) reach_.push_back(body.center.norm() + body.radius);
    for (const PartPiece& piece : parts_.pieces)
      for (const PieceEnd& end : piece.ends)
        reach_[end.body] = std::max(reach_[end.body], end.center.norm() + end.radius);
    motion_ = fold_motion(sheet, reach_);
  }

  /// Returns where parts first come too near, to within first_rad; empty: nowhere.
  std::optional<LeastDistance> run() {
    double width = motion_->end();
    for (double low = 0; low < motion_->end() && !hit_;) {
      const double high = std::min(low + width, motion_->next(low));
      const std::shared_ptr<const MotionInterval> whole = motion_->over(low, high);
      std::optional<std::vector<Task>> tasks = near_pairs(*whole, low, high);
      if (!tasks) {
        width = (high - low) / 2;
        continue;
      }
      split({{low, high}}, {whole}, std::move(*tasks));
      low = high;
    }
    return hit_;
  }

 private:
  using Stretch = std::pair<double, double>;

  /// Returns the distance to prove for a pair. It then has no less spare distance than the least known, and is no
  /// nearer than the nearest.
  double goal_mm(const PartPair& pair) const {
    const LeastDistance& known = pair.is_hinged ? all_.in_hinges : all_.elsewhere;
    const double excess = known.first < 0 ? looked_mm : known.excess_mm();
    if (hit_ || !(excess > 0) || is_verdict(search_)) return min_mm(pair);
    const double nearest = all_.nearest.first < 0 ? looked_mm : all_.nearest.mm;
    return std::max(needed_mm(pair.required_mm) + excess, nearest) - slack_mm;
  }

  static double min_mm(const PartPair& pair) { return needed_mm(pair.required_mm) - slack_mm; }

  struct Ball {
    Vector3d center = Vector3d::Zero();
    double radius = 0;
  };

  /// Returns a ball around all that a part may take up over an interval.
  Ball ball(int part, const MotionInterval& whole, const std::vector<model::SweptMotion>& motions) const {
    Ball out;
    std::vector<const PieceEnd*> ends;
    if (part < parts_.bodies)
      ends = {&parts_.whole[part]};
    else
      for (const PieceEnd& end : parts_.pieces[parts_.pieces_of[part].front()].ends) ends.push_back(&end);
    const auto center = [&](const PieceEnd& end) -> Vector3d {
      return whole.state[end.body].R * end.center + whole.state[end.body].p;
    };
    for (const PieceEnd* end : ends) out.center += center(*end) / static_cast<double>(ends.size());
    for (const PieceEnd* end : ends)
      out.radius = std::max(out.radius, (center(*end) - out.center).norm() + end->radius +
                                            motions[end->body].travel(center(*end), end->radius));
    return out;
  }

  /// Returns the pairs of parts that may come too near. Empty if parts move too far to find neighbours.
  std::optional<std::vector<Task>> near_pairs(const MotionInterval& whole, double low, double high) {
    const std::vector<model::SweptMotion> motions = whole.motions();
    const double margin = whole.margin_mm();
    std::vector<int> parts;
    std::vector<Ball> balls;
    double most = 0, still = 0;
    for (int p = 0; p < static_cast<int>(parts_.pieces_of.size()); ++p) {
      if (parts_.pieces_of[p].empty()) continue;
      parts.push_back(p);
      balls.push_back(ball(p, whole, motions));
      most = std::max(most, balls.back().radius + margin);
    }
    for (const PartPiece& piece : parts_.pieces)
      for (const PieceEnd& end : piece.ends) still = std::max(still, end.center.norm() + end.radius);
    if (!(most <= still + wander * edge_ + margin) && whole.half_width > first_rad / 2) return std::nullopt;
    Eigen::Matrix3Xd centers(3, balls.size());
    for (std::size_t k = 0; k < balls.size(); ++k) centers.col(k) = balls[k].center;
    const double goal =
        std::max({goal_mm({.is_hinged = true}), goal_mm({}), 0.0}) + distances_.rules.max_required();
    std::map<int, std::vector<PartPair>> by_body;
    for (const auto& [a, b] : near_.find(centers, 2 * most + goal)) {
      if ((centers.col(a) - centers.col(b)).norm() - balls[a].radius - balls[b].radius > goal + 2 * margin)
        continue;
      if (auto pair = distances_.rules.pair(parts[a], parts[b])) {
        for (const int part : {parts[a], parts[b]})
          for (const int body : distances_.rules.bodies_of(part))
            if (std::find(pair->bodies.begin(), pair->bodies.end(), body) == pair->bodies.end())
              pair->bodies.push_back(body);
        by_body[pair->bodies.front()].push_back(std::move(*pair));
      }
    }
    std::vector<Task> out;
    for (auto& [body, pairs] : by_body) {
      find_chains(body, pairs);
      for (PartPair& pair : pairs) out.push_back({low, high, std::move(pair)});
    }
    return out;
  }

  void find_chains(int body, std::vector<PartPair>& pairs) {
    std::set<int> missing;
    for (const PartPair& pair : pairs)
      for (std::size_t k = 1; k < pair.bodies.size(); ++k)
        if (!known_chains_.contains({body, pair.bodies[k]})) missing.insert(pair.bodies[k]);
    const std::vector<int> to(missing.begin(), missing.end());
    if (!to.empty()) {
      const std::vector<HingeChain>& found = chains_.find(body, to);
      for (std::size_t k = 0; k < to.size(); ++k) known_chains_[{body, to[k]}] = found[k];
    }
    for (PartPair& pair : pairs)
      for (std::size_t k = 1; k < pair.bodies.size(); ++k)
        pair.chains.push_back(known_chains_.at({body, pair.bodies[k]}));
  }

  /// Checks tasks level by level, each with the results before. The answer is the same for any number of threads.
  void split(std::vector<Stretch> stretches, std::vector<std::shared_ptr<const MotionInterval>> intervals,
             std::vector<Task> tasks) {
    while (!tasks.empty()) {
      std::vector<PairResult> outcomes(tasks.size());
      run_all(static_cast<int>(tasks.size()), [&](int k) {
        const Task& task = tasks[k];
        const auto at = std::lower_bound(stretches.begin(), stretches.end(), Stretch{task.low, task.high});
        outcomes[k] = PairSearch(parts_, *intervals[at - stretches.begin()], task.pair, search_)
                          .compare(goal_mm(task.pair), min_mm(task.pair));
      });
      for (std::size_t k = 0; k < tasks.size(); ++k) note(tasks[k], outcomes[k]);
      if (hit_ && search_ != ClearanceSearch::least) return;
      tasks = halved(std::move(tasks), outcomes);
      stretches.clear();
      for (const Task& task : tasks) stretches.emplace_back(task.low, task.high);
      std::sort(stretches.begin(), stretches.end());
      stretches.erase(std::unique(stretches.begin(), stretches.end()), stretches.end());
      intervals.assign(stretches.size(), nullptr);
      run_all(static_cast<int>(stretches.size()),
              [&](int k) { intervals[k] = motion_->over(stretches[k].first, stretches[k].second); });
    }
  }

  void note(const Task& task, const PairResult& outcome) {
    if (!outcome.least) return;
    const double middle = (task.low + task.high) / 2;
    LeastDistance& known = task.pair.is_hinged ? all_.in_hinges : all_.elsewhere;
    update_least(*outcome.least, known);
    update_nearest(*outcome.least, all_.nearest);
    if (!(outcome.least->excess_mm() < 0) && !outcome.is_uncertain) return;
    if (hit_ && !(middle < hit_at_)) return;
    hit_ = outcome.least;
    hit_at_ = middle;
  }

  /// Halves the tasks that are not proven, up to where parts come too near. There it stops at first_rad.
  std::vector<Task> halved(std::vector<Task> tasks, std::vector<PairResult>& outcomes) const {
    std::vector<Task> out;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      if (outcomes[k].open.empty()) continue;
      Task& task = tasks[k];
      task.pair.open = std::move(outcomes[k].open);
      const double middle = (task.low + task.high) / 2;
      if (hit_ && (task.low >= hit_at_ ||
                   std::abs(motion_->theta(middle) - motion_->theta(task.low)) < first_rad / 2))
        continue;
      Task right{middle, task.high, task.pair};
      out.push_back({task.low, middle, std::move(task.pair)});
      if (!hit_ || middle < hit_at_) out.push_back(std::move(right));
    }
    return out;
  }

  const Distances& distances_;
  const ClearanceSearch search_;
  const MovingParts& parts_;
  std::vector<double> reach_;  // of all parts of each body from its rest position, mm
  std::unique_ptr<PrintMotion> motion_;
  model::HingeChains chains_;
  std::map<std::pair<int, int>, HingeChain> known_chains_;
  model::NearPairs near_;
  const double edge_;
  PathClearance& all_;
  std::optional<LeastDistance> hit_;
  double hit_at_ = 0;
};

}  // namespace

double LeastDistance::excess_mm() const { return mm - needed_mm(required_mm); }

PathClearance path_clearance(const PrintSheet& sheet, ClearanceSearch search) {
  const Distances distances(sheet, search);
  PathClearance all = distances.measured(sheet.thetas.front(), sheet.path.front());
  if (!has_required_clearance(all)) {
    all.first_violation = all.least();
    return all;
  }
  if (sheet.path.size() < 2) return all;
  const PathClearance fold = distances.measured(sheet.thetas.back(), sheet.path.back());
  update_least(fold.in_hinges, all.in_hinges);
  update_least(fold.elsewhere, all.elsewhere);
  update_nearest(fold.nearest, all.nearest);
  if (search != ClearanceSearch::least && !has_required_clearance(all)) return all;
  std::optional<LeastDistance> bore;
  for (std::size_t k = 0; k < sheet.path.size(); ++k) {
    distances.compare_bores(sheet.thetas[k], sheet.path[k], all);
    if (!bore && !has_required_clearance(all) && all.least().theta == sheet.thetas[k]) bore = all.least();
  }
  all.first_violation = PathSearch(sheet, distances, search, all).run();
  if (has_required_clearance(all) || all.least().excess_mm() >= 0) return all;
  for (const LeastDistance& other : {bore.value_or(all.least()), all.least()})
    if (!all.first_violation || std::abs(other.theta) < std::abs(all.first_violation->theta))
      all.first_violation = other;
  return all;
}

bool has_required_clearance(const PathClearance& clearance) {
  return !clearance.first_violation && clearance.least().excess_mm() >= 0;
}

std::string part_name(const PrintSheet& sheet, int part) {
  const int bodies = static_cast<int>(sheet.bodies.size());
  return part < bodies ? sheet.linkage.vertex_name(part)
                       : "soft part of " + sheet.linkage.wall_name(part - bodies);
}

}  // namespace kinetix::app
