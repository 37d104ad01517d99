#include "app/print/sheet/lock.hpp"

#include <fmt/format.h>

#include "app/files/process_section.hpp"
#include "app/print/sheet/fold_motion.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector3d;

constexpr double post_widths[] = {3, 2.5, 2, 1.5};  // ratio to the wall's thickness, tried in this order
constexpr double leg_widths[] = {1.5, 1};  // of eyes, ratio to the wall's thickness, tried in this order
constexpr double hole_width_mm = 1.5;  // mm, of eyes: for a zip tie of 2.5 x 1 mm on its edge, with clearance
constexpr double hole_height_mm = 3;   // mm, of eyes: for the same zip tie
constexpr double bar_height = 2;       // of a clip, ratio to the wall's thickness
constexpr double end_width = 2;  // of a clip beyond its holes, ratio to the wall's thickness; beside them 1
constexpr double foot_share = 0.25;  // least height of a foot, ratio to the wall's thickness
constexpr double level_share =
    0.5;  // largest difference in height of two posts, ratio to the wall's thickness
constexpr double parallel_cos = 0.9986;  // of 3 degrees, the largest angle between two posts of a clip
constexpr double same_side_cos = 0.5;    // of the largest angle between two eyes
constexpr double steepest_strap = 0.5;   // sine of the largest angle between a strap and the top of a body
constexpr double tolerance_mm = 0.01;    // mm: of the distance between a clip and walls
constexpr double least_step_mm = 1e-6;   // mm: shortenings that differ by less are equal
constexpr double least_shortening = 10;  // ratio to the clearance, of which the play of a clip is 2
constexpr double part_of_theta = 1e-4;   // step of difference quotients, ratio to theta
constexpr std::size_t most_bodies =
    1000;  // in larger sheets only bodies with fewer hinges than most are compared

/// Limits of a search for a lock.
struct LockEffort {
  int lines;  ///< of clips and straps in the fold, each a fraction of a millisecond
  int paths;  ///< ways of posts and eyes to the fold
};
constexpr LockEffort requested_effort{5000, 24};  // seconds in the largest sheets
constexpr LockEffort default_effort{500, 4};      // a small share of a search

constexpr const char* assumed_material =
    "pa12";  // of walls, unless they are printed in one with living hinges

/// Two bodies, by how much their distance shrinks from flat to the fold.
struct BodyPair {
  int first = 0, second = 0;
  double shortening_mm = 0;
};

/// Posts of a pair at the fold: where the clip or strap pulls at them.
struct Span {
  Vector3d first, second;  ///< mm
  Vector3d along, up;      ///< unit vectors, normal to each other
  double length_mm() const { return (second - first).norm(); }
};

/// Returns a box as an immovable piece. @param half along, across and up, mm
PartPiece box_piece(const Vector3d& center, const Span& span, const Vector3d& half) {
  const Vector3d across = span.up.cross(span.along);
  PieceEnd end;
  end.points.resize(3, 8);
  int k = 0;
  for (const double x : {-half.x(), half.x()})
    for (const double y : {-half.y(), half.y()})
      for (const double z : {-half.z(), half.z()})
        end.points.col(k++) = center + x * span.along + y * across + z * span.up;
  end.center = center;
  end.radius = half.norm();
  return {-1, {std::move(end)}};
}

/// Returns the clip, from the bed up: a bar with two square holes. @param apart_mm distance of their middles
/// @param hole, beside, beyond half width of the holes, and widths of the bar beside and beyond them, mm
model::Polyhedron clip_solid(double apart_mm, double hole, double beside, double beyond, double height_mm) {
  model::Polyhedron clip;
  using Ring = std::array<int, 4>;
  std::array<std::array<Ring, 2>, 2> holes, outlines;  // of both halves, below and above
  std::array<std::array<int, 2>, 2> middle;            // below and above, on both sides
  const double wide = hole + beside;
  for (int above = 0; above < 2; ++above) {
    const double z = above * height_mm;
    for (int side = 0; side < 2; ++side)
      middle[above][side] = clip.add_point({0, side == 0 ? -wide : wide, z});
    for (int half = 0; half < 2; ++half) {
      const double turn = half == 0 ? 1 : -1, at = turn * apart_mm / 2,
                   end = turn * (apart_mm / 2 + hole + beyond);
      const auto add = [&](double x, double y) { return clip.add_point({x, turn * y, z}); };
      holes[half][above] = {add(at - turn * hole, -hole), add(at + turn * hole, -hole),
                            add(at + turn * hole, hole), add(at - turn * hole, hole)};
      outlines[half][above] = {middle[above][half], add(end, -wide), add(end, wide), middle[above][1 - half]};
    }
  }
  for (int half = 0; half < 2; ++half) {
    const auto& [hole_below, hole_above] = holes[half];
    const auto& [below, above] = outlines[half];
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      clip.add_face({above[k], above[next], hole_above[next], hole_above[k]});
      clip.add_face({below[next], below[k], hole_below[k], hole_below[next]});
      clip.add_face({hole_below[next], hole_below[k], hole_above[k], hole_above[next]});
      if (k < 3) clip.add_face({below[k], below[next], above[next], above[k]});
    }
  }
  return clip;
}

/// Returns the height of each body's highest point above its origin, mm.
std::vector<double> highest_points(const MovingParts& parts) {
  std::vector<double> out;
  for (const PieceEnd& body : parts.whole) out.push_back(body.points.row(2).maxCoeff());
  return out;
}

class LockMaker {
 public:
  LockMaker(PrintSheet& sheet, LockKind kind)
      : sheet_(sheet),
        parts_(sheet),
        highest_(highest_points(parts_)),
        is_clip_(kind == LockKind::clip),
        wall_(std::max(sheet.linkage.size.thickness_mm, sheet.process.min_wall_mm)),
        clearance_(sheet.process.clearance_mm),
        foot_(std::max(foot_share * wall_, clearance_)) {}

  /// Adds the lock to the first pair of bodies that has room for it. @return whether there is one
  bool add(const LockEffort& most) {
    int lines = 0, paths = 0;
    for (const BodyPair& pair : pairs()) {
      if (!is_possible(pair)) continue;
      for (const double half : half_widths()) {
        if (lines++ >= most.lines || paths >= most.paths) return false;
        if (!is_line_free(pair, half) || !make(pair, half)) continue;
        ++paths;
        if (!has_required_clearance(path_clearance(sheet_, ClearanceSearch::verdict_of_posts))) continue;
        finish(pair);
        return true;
      }
    }
    return false;
  }

 private:
  const model::State& fold() const { return sheet_.path.back(); }

  /// Returns half widths of posts or eyes in the order in which they are tried, mm.
  std::vector<double> half_widths() const {
    std::vector<double> half;
    if (is_clip_)
      for (const double width : post_widths) half.push_back(width * wall_ / 2);
    else
      for (const double leg : leg_widths) half.push_back(leg * wall_ + hole_width_mm / 2);
    return half;
  }

  /// Returns pairs whose distance shrinks by more than the clearances, those that shrink most first.
  std::vector<BodyPair> pairs() const {
    std::size_t most_arms = 0;
    for (const model::BodySolid& body : sheet_.bodies) most_arms = std::max(most_arms, body.arms.size());
    std::vector<int> bodies;
    for (int b = 0; b < static_cast<int>(sheet_.bodies.size()); ++b)
      if (const std::size_t arms = sheet_.bodies[b].arms.size();
          arms > 0 && (arms < most_arms || sheet_.bodies.size() <= most_bodies))
        bodies.push_back(b);
    std::vector<BodyPair> out;
    const model::State& flat = sheet_.path.front();
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        const int a = bodies[i], b = bodies[j];
        const double shorter = (flat[b].p - flat[a].p).norm() - (fold()[b].p - fold()[a].p).norm();
        if (shorter > least_shortening * clearance_)
          out.push_back({a, b, std::round(shorter / least_step_mm) * least_step_mm});
      }
    std::stable_sort(out.begin(), out.end(),
                     [](const BodyPair& a, const BodyPair& b) { return a.shortening_mm > b.shortening_mm; });
    return out;
  }

  /// Returns the height of the middle of clip or strap above a body's origin, mm.
  double middle_mm(int body) const {
    const double above_foot = is_clip_ ? bar_height * wall_ / 2 : (wall_ + hole_height_mm) / 2;
    return highest_[body] + foot_ + above_foot;
  }

  /// Returns the span between the middles of clip or strap in a state.
  Span span(const BodyPair& pair, const model::State& state) const {
    const model::Pose &a = state[pair.first], &b = state[pair.second];
    Span out;
    out.first = a.R * Vector3d(0, 0, middle_mm(pair.first)) + a.p;
    out.second = b.R * Vector3d(0, 0, middle_mm(pair.second)) + b.p;
    out.along = (out.second - out.first).normalized();
    const Vector3d up = a.R.col(2) + b.R.col(2);
    out.up = (up - up.dot(out.along) * out.along).normalized();
    return out;
  }

  /// Checks whether posts of a pair are parallel and as high, or eyes on one side, and far enough apart.
  bool is_possible(const BodyPair& pair) const {
    const Span at = span(pair, fold());
    const Vector3d first = fold()[pair.first].R.col(2), second = fold()[pair.second].R.col(2);
    const double lean = std::max(std::abs(at.along.dot(first)), std::abs(at.along.dot(second)));
    const double half = half_widths().back(), length = at.length_mm();
    if (!is_clip_)
      return first.dot(second) >= same_side_cos && lean <= steepest_strap &&
             length >= 2 * half + hole_width_mm;
    const double longest = std::max(sheet_.process.bed_mm[0], sheet_.process.bed_mm[1]);
    return first.dot(second) >= parallel_cos && lean * length <= level_share * wall_ &&
           length >= 2 * (half + clearance_ + wall_) &&
           length + 2 * (half + clearance_ + end_width * wall_) <= longest;
  }

  /// Checks whether clip or strap keep clear of all other bodies in the fold. @param half of the posts' width, mm
  bool is_line_free(const BodyPair& pair, double half) const {
    const Span at = span(pair, fold());
    const double beyond = is_clip_ ? half + clearance_ + end_width * wall_ : half + hole_width_mm,
                 beside = is_clip_ ? half + clearance_ + wall_ : half + hole_width_mm,
                 height = is_clip_ ? bar_height * wall_ : hole_height_mm;
    const PartPiece bar =
        box_piece((at.first + at.second) / 2, at, {at.length_mm() / 2 + beyond, beside, height / 2});
    const model::Pose still;
    const PlacedPiece placed_bar{bar, {&still}};
    return std::all_of(parts_.pieces.begin(), parts_.pieces.end(), [&](const PartPiece& piece) {
      if (piece.part == pair.first || piece.part == pair.second) return true;
      PlacedPiece other{piece, {}};
      for (const PieceEnd& end : piece.ends) other.poses.push_back(&fold()[end.body]);
      double reach = bar.ends.front().radius;  // of both pieces from their centers
      for (const PieceEnd& end : piece.ends)
        reach += (fold()[end.body].R * end.center + fold()[end.body].p - other.center()).norm() + end.radius;
      if ((other.center() - bar.ends.front().center).norm() >= reach + clearance_) return true;
      return piece_distance(placed_bar, other).mm >= clearance_ - tolerance_mm;
    });
  }

  /// Returns the post of a body. One of its sides faces the other post in the fold.
  model::Post post(int body, const Vector3d& along, double half_mm) const {
    const Vector3d seen = fold()[body].R.transpose() * along;
    model::Post out;
    out.angle = std::atan2(seen.y(), seen.x());
    out.half_mm = half_mm;
    out.foot_mm = foot_;
    if (is_clip_) {
      out.height_mm = (bar_height + 2 * level_share) * wall_;
      return out;
    }
    out.hole_mm = hole_width_mm;
    out.hole_from_mm = wall_ / 2;
    out.hole_to_mm = out.hole_from_mm + hole_height_mm;
    out.height_mm = out.ridge_mm() + half_mm - hole_width_mm / 2;
    return out;
  }

  /// Makes the sheet with posts. @return whether the junctions have room for them
  bool make(const BodyPair& pair, double half_mm) {
    const Vector3d along = span(pair, fold()).along;
    sheet_.posts = {{pair.first, post(pair.first, along, half_mm)},
                    {pair.second, post(pair.second, along, half_mm)}};
    try {
      make_solids(sheet_);
    } catch (const InvalidInput&) {
      return false;
    }
    return std::all_of(sheet_.posts.begin(), sheet_.posts.end(), [&](const auto& post) {
      const double base_mm = sheet_.bodies[post.first].post->base_mm;
      return std::abs(base_mm - highest_[post.first] - foot_) <
             tolerance_mm;  // not if walls rise from their vertex
    });
  }

  double hole_half_mm(const BodyPair& pair) const { return sheet_.posts.at(pair.first).half_mm + clearance_; }

  const model::Material& material() const {
    return *model::find_material(sheet_.is_one_material() ? sheet_.process.film : assumed_material);
  }

  /// Returns the energy of all soft hinges that turn from flat to a state, N mm.
  double energy(const model::State& state) const {
    double sum = 0;
    for (int h = 0; h < static_cast<int>(sheet_.hinges.size()); ++h) {
      if (is_pin(sheet_.hinges[h].made.kind)) continue;
      const double turn = hinge_turn(sheet_.linkage, state, h);
      sum += stiffness(sheet_.hinges[h].made).turn * turn * turn / 2;
    }
    return sum;
  }

  /// Estimates the force of the hinges on the lock, N, if no equilibrium is known: the derivative of their energy by the distance of the posts.
  double force_N(const BodyPair& pair) const {
    if (!sheet_.has_soft()) return 0;
    const double theta = sheet_.thetas.back();
    const bool is_exact = static_cast<bool>(sheet_.motion);
    const model::State before =
        is_exact ? sheet_.motion(theta * (1 - part_of_theta)) : sheet_.path[sheet_.path.size() - 2];
    const model::State after = is_exact ? sheet_.motion(theta * (1 + part_of_theta)) : fold();
    const double nearer = span(pair, before).length_mm() - span(pair, after).length_mm();
    return std::max(0.0, (energy(after) - energy(before)) / nearer);
  }

  /// Returns the force at which a section reaches the strain of its material, N. Sections are a post or the leg of an
  /// eye, in bending and shear, and a clip at its holes, in bending and tension.
  double strength_N(const BodyPair& pair) const {
    const double stress = material().E_mpa * material().strain_max;  // MPa
    const model::Post& post = sheet_.posts.at(pair.first);
    const double wide = 2 * post.half_mm, leg = is_clip_ ? wide : post.half_mm - post.hole_mm / 2;
    const double lever =
        is_clip_ ? (bar_height / 2 + level_share) * wall_ : post.hole_from_mm + hole_height_mm / 2;
    const double bending = stress * leg * wide * wide / 6 / lever,
                 shear = stress / std::sqrt(3.0) * leg * wide / 1.5;
    if (!is_clip_) return std::min(bending, shear);
    const double height = bar_height * wall_, deep = end_width * wall_;
    const double end = stress * height * deep * deep / hole_half_mm(pair),  // a beam held at both ends
        tension = stress * 2 * wall_ * height;
    return std::min({bending, shear, end, tension});
  }

  void finish(const BodyPair& pair) {
    const auto held = find_held_fold(sheet_, {pair.first, pair.second}, [&](const model::State& state) {
      return span(pair, state).length_mm();
    });
    const double folded = held ? held->length_mm : span(pair, fold()).length_mm();
    sheet_.lock =
        Lock{.kind = to_string(is_clip_ ? LockKind::clip : LockKind::strap),
             .bodies = {sheet_.linkage.vertex_name(pair.first), sheet_.linkage.vertex_name(pair.second)},
             .flat_mm = span(pair, sheet_.path.front()).length_mm(),
             .folded_mm = folded,
             .force_N = held ? held->force_N : force_N(pair),
             .strength_N = strength_N(pair),
             .material = material().name};
    if (is_clip_)
      sheet_.clip = clip_solid(folded - 2 * clearance_, hole_half_mm(pair), wall_, end_width * wall_,
                               bar_height * wall_);
    if (sheet_.has_soft() && !held)
      sheet_.warnings.push_back(fmt::format(
          "whether the {} holds the fold is not known: no stable state was found there, and its force is "
          "estimated from the turns of hinges alone",
          sheet_.lock->kind));
    if (sheet_.lock->force_N > sheet_.lock->strength_N)
      sheet_.warnings.push_back(
          fmt::format("the hinges pull at the {} with {:.3g} N, more than its estimated strength of {:.3g} "
                      "N: it may break",
                      sheet_.lock->kind, sheet_.lock->force_N, sheet_.lock->strength_N));
  }

  PrintSheet& sheet_;
  const MovingParts parts_;            // without posts
  const std::vector<double> highest_;  // of each body, above its origin, mm
  const bool is_clip_;
  const double wall_;       // mm: unit of all widths
  const double clearance_;  // mm, per side
  const double foot_;       // mm: height of posts' feet above their bodies
};

void remove_lock(PrintSheet& sheet) {
  sheet.posts.clear();
  sheet.lock.reset();
  sheet.clip = {};
  make_solids(sheet);
}

/// @throws InvalidInput for a sheet that has no fold, or that a process without posts makes
void check_lockable(const PrintSheet& sheet, LockKind kind) {
  if (sheet.process.cuts_sheets())
    throw InvalidInput(
        fmt::format("lock: {} has parts above the walls, and {} cuts flat sheets. Give lock: none",
                    to_string(kind), sheet.process.name));
  if (sheet.path.size() < 2)
    throw InvalidInput(
        fmt::format("lock: {} needs a fold, and only the flat sheet is known. Give design.fold_angle_deg, or "
                    "remove the lock",
                    to_string(kind)));
}

}  // namespace

void add_lock(PrintSheet& sheet, LockKind kind) {
  check_lockable(sheet, kind);
  if (LockMaker(sheet, kind).add(requested_effort)) return;
  remove_lock(sheet);
  throw InvalidInput(kind == LockKind::clip
                         ? "lock: clip does not fit: no two bodies that meet in the fold have room for posts "
                           "and a clip. Give larger cells, lock: strap or lock: none"
                         : "lock: strap does not fit: no two bodies that meet in the fold have room for eyes "
                           "and a straight strap. Give larger cells or lock: none");
}

bool add_default_lock(PrintSheet& sheet) {
  if (sheet.process.cuts_sheets() || sheet.path.size() < 2) return false;
  const std::vector<std::string> warnings = sheet.warnings;
  for (const LockKind kind : {LockKind::clip, LockKind::strap}) {
    if (LockMaker(sheet, kind).add(default_effort) && sheet.lock->force_N <= sheet.lock->strength_N)
      return true;
    remove_lock(sheet);
    sheet.warnings = warnings;
  }
  return false;
}

}  // namespace kinetix::app
