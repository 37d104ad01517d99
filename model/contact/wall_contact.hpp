#pragma once

#include <utility>

#include "model/base/box.hpp"
#include "model/base/geometry.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A plate of a linkage with the wall's height and thickness. Its end at the hinge is cut along the hinge
/// axis, and is slanted if alpha is not 90 deg, as in prints. Contact ranges, equilibria and the simulation
/// share this shape.
struct HalfWall {
  int body = 0;
  int hinge = 0;
  OrientedBox box;  ///< relative to the body's position, mm
};

/// Returns the half walls in the order of Linkage::plates.
std::vector<HalfWall> half_walls(const Linkage& structure);

/// Returns the plate of a half wall in a state, mm.
OrientedBox placed(const HalfWall& wall, const Pose& pose);

/// Pairs of points closer than a distance. The points are divided into stripes of that width along the longest side
/// of their bounding box, and sorted along the second longest. The cost is O(n log n) if few points share a stretch
/// of a stripe. Buffers are reused between calls.
class NearPairs {
 public:
  /// @param points all finite   @param distance > 0, in the unit of the points
  /// @return (lower index, higher index), each pair once, in an order that depends only on the points
  const std::vector<std::pair<int, int>>& find(const Eigen::Matrix3Xd& points, double distance);

 private:
  struct Entry {
    double stripe;
    double along;
    int index;
    bool operator<(const Entry& other) const;
  };

  void pair_up(std::size_t first, std::size_t& partner, double stripe, const Eigen::Matrix3Xd& points,
               double distance);

  std::vector<Entry> entries_;
  std::vector<std::pair<int, int>> pairs_;
};

/// Two half walls of different bodies, as indices into half_walls().
struct WallPair {
  int first = -1, second = -1;
  auto operator<=>(const WallPair&) const = default;
};

/// Collision check between walls of a structure. It excludes plates of one body, and plates that touch in the flat
/// state, as built. It also excludes the two halves of one wall: their square ends overlap as soon as the hinge
/// turns, and the hinge's shape decides there.
class WallContact {
 public:
  explicit WallContact(const Linkage& structure);

  /// Returns the pairs that overlap or touch in the flat state and are not examined again.
  const std::vector<WallPair>& touching_at_rest() const { return touching_at_rest_; }
  /// Returns the first of them that overlaps, if any: such a structure cannot be built.
  const std::optional<WallPair>& overlap_at_rest() const { return overlap_at_rest_; }

  /// Returns the pairs that overlap by more than a billionth of the cell edge. @pre one finite pose per body
  const std::vector<WallPair>& overlapping(const State& state);
  /// Returns the `candidates` that overlap by more than a billionth of the cell edge.
  std::vector<WallPair> overlapping(const State& state, const std::vector<WallPair>& candidates) const;

 private:
  void collect(const State& state, double depth);
  bool can_touch(const WallPair& pair) const;

  std::vector<HalfWall> walls_;
  std::vector<WallPair> touching_at_rest_;
  std::optional<WallPair> overlap_at_rest_;
  double reach_ = 0;  ///< no two plates with centers this far apart overlap, mm
  double depth_ = 0;  ///< mm
  std::vector<OrientedBox> boxes_;
  Eigen::Matrix3Xd centers_;
  NearPairs near_;
  std::vector<WallPair> found_;
};

/// Returns the theta, rad, at which basic planar cells close. The wall tips of opposite walls then meet: tan(theta) =
/// 1 - thickness / edge.
double closing_theta(const CellSize& size);
/// Margin of searches below closing_theta(), rad: walls touch at closing_theta().
inline constexpr double closing_margin = 0.1 * radians_per_degree;

/// Writes the state at fold parameter theta (rad); leaves the flat state unchanged at 0.
using FoldFunction = std::function<void(double theta, State& state)>;

struct ThetaRangeOptions {
  double limit = pi / 2;                 ///< rad, (0, pi/2]; end of the search
  double step = 1 * radians_per_degree;  ///< rad, >= 1e-6
  double precision = 1e-9;               ///< rad, >= 1e-14

  /// @throws InvalidInput
  void validate() const;
};

/// End of the free motion to one side of flat.
struct ContactLimit {
  double theta = 0;  ///< rad: no walls meet between flat and theta
  /// Walls meet beyond theta, or no proof excludes it; false: search or motion ends here
  bool touches = false;
  WallPair walls;  ///< first walls that meet
  /// Theta at which they do overlap, rad, so that they meet between `theta` and this. Empty if they do not touch.
  /// Also empty if a proof finds no overlap within a hundredth of theta.
  std::optional<double> contact = {};
};

/// Range of the fold to both sides of flat before walls collide: by samples of its motion, see theta_range(), or by
/// proof, see certified_range().
struct ContactRange {
  ContactLimit negative, positive;
  std::vector<WallPair> touching_at_rest;  ///< as built, including overlaps: they are not examined
  int states = 0;                          ///< number of states that a proof computed
  std::string why_not = {};                ///< one sentence, if nothing is proven: theta is 0 on both sides
  double growth_mm = 0;                    ///< growth of every wall on all sides relative to the design

  explicit operator bool() const { return why_not.empty(); }
  /// Returns true if walls overlap as built, flat. There is no range then, and both limits name them.
  bool overlaps_as_built() const { return positive.contact == 0.0; }
  const ContactLimit& to(double theta) const { return theta < 0 ? negative : positive; }
  /// Returns true if no walls meet between flat and theta, rad.
  bool covers(double theta) const {
    return *this && !overlaps_as_built() && negative.theta <= theta && theta <= positive.theta;
  }
};

/// Computes the fold to both sides of flat before walls collide. It steps from flat and bisects the step with the
/// first overlap. Plates that meet and part again within one step are missed. With the default step, the ends of a
/// wall move by at most a hundredth of the edge relative to their neighbours. In basic planar cells the end is
/// closing_theta().
/// @throws InvalidInput for options out of range
ContactRange theta_range(const Linkage& structure, const FoldFunction& fold,
                         const ThetaRangeOptions& options = {});

/// Computes the range along a closed form. @throws InvalidInput if there is none
ContactRange theta_range(const Linkage& structure, const ExactMotion& exact,
                         const ThetaRangeOptions& options = {});

}  // namespace kinetix::model
