#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/base/angle.hpp"
#include "model/contact/near_pairs.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/linkage/half_wall.hpp"

namespace kinetix::model {

/// Two half walls of different bodies, as indices into half_walls().
struct WallPair {
  int first = -1, second = -1;
  auto operator<=>(const WallPair&) const = default;
};

/// Finds walls of a structure that run into each other. Not counted: plates of one body, the two halves of
/// one wall (their square ends overlap as soon as the hinge turns; the hinge's own shape decides there), and
/// plates that touch in the flat state, which is how the structure is built.
class WallContact {
 public:
  explicit WallContact(const Linkage& structure);

  /// Pairs that overlap or touch in the flat state and are not looked at again.
  const std::vector<WallPair>& touching_at_rest() const { return touching_at_rest_; }
  /// The first of them that overlaps: nothing that could be built.
  const std::optional<WallPair>& overlap_at_rest() const { return overlap_at_rest_; }

  /// Pairs that overlap by more than a billionth of the cell edge. @pre one finite pose per body
  const std::vector<WallPair>& overlapping(const State& state);
  /// Those of `candidates` that do.
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

/// Theta, rad, at which basic planar cells close: the wall tips of opposite walls meet at
/// tan(theta) = 1 - thickness / edge.
double closing_theta(const CellSize& size);
/// How far below it searches keep theta, rad: at it walls touch.
inline constexpr double closing_margin = 0.1 * radians_per_degree;

/// Writes the state at fold parameter theta (rad); keeps the flat state at 0.
using FoldFunction = std::function<void(double theta, State& state)>;

struct ThetaRangeOptions {
  double limit = pi / 2;                 ///< rad, (0, pi/2]; where to stop looking
  double step = 1 * radians_per_degree;  ///< rad, >= 1e-6
  double precision = 1e-9;               ///< rad, >= 1e-14

  /// @throws InvalidInput
  void validate() const;
};

/// Where the free motion to one side of flat ends.
struct ContactLimit {
  double theta = 0;  ///< rad: no walls meet from flat to here
  bool touches =
      false;       ///< beyond, as seen or for all that is proven; false: the search or the motion ends here
  WallPair walls;  ///< the first that do
  /// rad: there they do overlap, so that they meet between theta and this. None where they do not touch, and where a proof
  /// has not seen them overlap within a hundredth of theta.
  std::optional<double> contact = {};
};

/// How far a structure folds to both sides of flat before walls collide: by samples of its motion, see theta_range(), or by
/// proof, see certified_range().
struct ContactRange {
  ContactLimit negative, positive;
  std::vector<WallPair> touching_at_rest;  ///< as built, overlapping ones among them: they are not looked at
  int states = 0;                          ///< that a proof computed
  std::string why_not = {};  ///< in a sentence, where nothing is proven: theta is 0 on both sides
  double growth_mm = 0;      ///< by which every wall was larger on all its sides than designed

  explicit operator bool() const { return why_not.empty(); }
  /// Walls that overlap as built, flat: there is no range then, and both limits name them.
  bool overlaps_as_built() const { return positive.contact == 0.0; }
  const ContactLimit& to(double theta) const { return theta < 0 ? negative : positive; }
  /// Whether no walls meet on the way to theta, rad.
  bool covers(double theta) const {
    return *this && !overlaps_as_built() && negative.theta <= theta && theta <= positive.theta;
  }
};

/// How far a structure folds to both sides of flat before walls collide: steps from flat and bisects the step
/// in which the first overlap appears. Plates that meet and part again within one step are missed; with the
/// default step the ends of a wall move by at most a hundredth of the edge against their neighbours in it.
/// In basic planar cells the end is closing_theta().
/// @throws InvalidInput for options out of range
ContactRange theta_range(const Linkage& structure, const FoldFunction& fold,
                         const ThetaRangeOptions& options = {});

/// Along a closed form.
/// @throws InvalidInput where there is none
ContactRange theta_range(const Linkage& structure, const ExactMotion& exact,
                         const ThetaRangeOptions& options = {});

}  // namespace kinetix::model
