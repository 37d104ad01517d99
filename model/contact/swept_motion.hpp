#pragma once

#include "model/linkage/exact_motion.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A hinge on the path from one body to another.
struct ChainStep {
  int hinge = 0;
  int sense = 1;  ///< 1 from the lower body to the upper one, -1 in reverse
};
using HingeChain = std::vector<ChainStep>;

/// Returns the chain in the opposite direction.
HingeChain reversed(HingeChain chain);

/// Paths through a linkage with the fewest hinges.
class HingeChains {
 public:
  explicit HingeChains(const Linkage& linkage);

  /// Finds the chains from one body to each of the others. The search ends at the last of them.
  /// @return chains in the order of `to`; empty if no hinges lead to a body
  const std::vector<HingeChain>& find(int from, const std::vector<int>& to);

  /// Every other body that hinges lead to, each after its parent.
  struct Link {
    int body = 0, parent = 0;
    ChainStep step;
  };
  std::vector<Link> tree(int root);

 private:
  struct Neighbour {
    int to = 0;
    ChainStep step;
  };
  void start(int from);
  bool is_met(int body) const { return round_of_[body] == round_; }
  HingeChain chain_to(int body, int from) const;

  std::vector<std::vector<Neighbour>> neighbours_;  ///< neighbours of each body
  std::vector<Link> found_;                         ///< in the order of the search
  std::vector<int> link_of_;                        ///< index in found_ of each body; -1 of the first
  std::vector<int> round_of_;                       ///< round in which each body was last reached
  int round_ = 0;
  std::vector<HingeChain> chains_;
};

/// Turns of the hinges of a linkage along its closed form: the part of a proof that is common to all states.
struct LinkageMotion {
  /// @param structure kept by reference   @param turns one per hinge
  LinkageMotion(const Linkage& structure, const std::vector<TurnLaw>& turns);

  double edge() const { return structure.size.edge_mm; }
  /// Returns a body that no chain of hinges joins to the others, or -1.
  int unconnected_body() const;
  /// Returns a bound of the deviation of a body from the position given by its hinges, relative to another body, mm.
  /// @param hinges number of hinges between them   @param gap cell edges, @param off rad: see LawDeviation
  double margin_mm(std::size_t hinges, double gap, double off) const;

  const Linkage& structure;
  std::vector<TurnLaw> laws;  ///< distinct laws
  std::vector<int> law_of;    ///< index in `laws`, per hinge
  std::vector<int> senses;    ///< hinge_sense of each hinge
  double longest_arm = 0;     ///< longest arm of a hinge, cell edges
  HingeChains chains;
  int middle = 0;                        ///< body
  std::vector<HingeChains::Link> links;  ///< from the middle body outwards
};

/// Motion of a body over an interval of theta, relative to another body: its twist in the middle, with bounds of its
/// deviation. With w and v the twist of the body, its point r moves by r' = v + w x r. The bounded quantity is the
/// second derivative r'', so that r stays within change(r) half_width^2 / 2 of its straight path.
///
/// Along hinges from body to body (n of them, axes a, rates of turning s):
///   w_n = w_(n-1) + s a,   w_n' = w_(n-1)' + s' a + s w_(n-1) x a,   r'' = w' x l + w x (w x l) + (anchor)''
/// with l from the hinge to the point. Each sum of absolute values is a bound: A of |w'|, W = |w(middle)| + h A of |w|,
/// and u of |w x a|, for which |(w x a)'| <= A + W |w x a| gives u <= (|w x a|(middle) + h A) / (1 - h W).
class SweptMotion {
 public:
  /// Starts at rest. @param half_width of the interval, rad
  explicit SweptMotion(double half_width) : h_(half_width) {}

  /// Adds a first turn about a fixed axis, at a constant rate.
  /// @param point on the axis, mm   @param spin axis times rate, rad per rad
  void turn_about(const Eigen::Vector3d& point, const Eigen::Vector3d& spin);
  /// Sets a constant twist: r' = v + omega x r. @param v velocity of the body's point at the origin, mm per rad
  void screw(const Eigen::Vector3d& omega, const Eigen::Vector3d& v);
  /// Adds a hinge between the present body and the next one.
  /// @param point, axis position (mm) and unit axis of the hinge in the middle of the interval   @param rate signed
  /// rate there   @param bounds of the rate
  void pass(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double rate, const RateBounds& bounds);

  const Eigen::Vector3d& omega() const { return omega_; }
  /// Returns the velocity of a point of the body at r in the middle of the interval, mm per rad.
  Eigen::Vector3d speed(const Eigen::Vector3d& r) const { return v_ + omega_.cross(r); }
  /// Returns a bound of the second derivative of that point, and of all points within `reach` of it, mm per rad^2.
  double change(const Eigen::Vector3d& r, double reach) const;
  /// Returns a bound of the second derivative along a unit direction n. A body that turns only about one axis a has n
  /// . r'' = (n x a) . (s' l + s^2 a x l), which vanishes along the axis.
  double change_along(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double reach) const;
  /// Returns a bound of the displacement of these points from the middle of the interval, mm.
  double travel(const Eigen::Vector3d& r, double reach) const;

 private:
  double h_;                                         ///< rad
  Eigen::Vector3d omega_ = Eigen::Vector3d::Zero();  ///< rad per rad
  Eigen::Vector3d v_ = Eigen::Vector3d::Zero();  ///< velocity of the body's point at the origin, mm per rad
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();  ///< position of the last hinge, mm
  double max_omega_ = 0;                              ///< W, rad per rad
  double omega_change_ = 0;                           ///< A, rad per rad^2
  double anchor_change_ = 0;                          ///< bound for the last hinge, mm per rad^2
  int turns_ = 0;                                     ///< number of hinges passed, or 1 for a screw
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();    ///< unit vector, axis of the last hinge
};

/// Points that move with one body over an interval of theta, in an observer's frame.
struct SweptPoints {
  const Eigen::Matrix3Xd* points = nullptr;  ///< relative to the body's rest position, mm
  Pose pose = {};                            ///< pose of the body in the middle of the interval
  const SweptMotion* motion = nullptr;       ///< motion of the body; null: at rest
  /// Center of a sphere around the points in the middle of the interval, mm
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;  ///< radius of that sphere, mm
};

/// A convex part: the hull of points of one body, or of two bodies for a block between them.
using SweptHull = std::vector<SweptPoints>;

/// Computes a lower bound of the gap of two parts along a unit direction n, over the whole interval, mm. The observer
/// carries n. A negative value proves no gap. With r' and r'' as in SweptMotion, and tau from -h to h,
///   gap(tau) >= min over b of (n . (r + tau r') - tau^2/2 |n . r''|) - max over a of (n . (r + tau r') + tau^2/2 |n . r''|),
/// which is concave in tau, so its minimum is at an end.
/// @param half_width h, rad; 0: only in the middle
double min_gap(const SweptHull& a, const SweptHull& b, const Eigen::Vector3d& n, double half_width);

/// Returns a bound of the displacement of any point of a part from the middle of the interval, mm.
double travel(const SweptHull& part);

/// Deviation of a state from its hinges and their laws.
struct LawDeviation {
  double gap = 0;  ///< largest joint separation, cell edges
  double off = 0;  ///< largest misfit of axes and turns, rad
  int hinge = -1;  ///< hinge that deviates from its law by more than rounding; -1: none
};

/// An interval of theta to one side of flat: the state in its middle, and bounds over the interval.
class ThetaInterval {
 public:
  /// @param linkage kept by reference   @param sign of theta, 1 or -1   @param low, high without sign, rad
  ThetaInterval(const LinkageMotion& linkage, const ExactMotion& exact, double sign, double low, double high);

  double theta() const { return theta_; }            ///< theta in the middle, rad
  double half_width() const { return half_width_; }  ///< rad, rounded up
  const State& state() const { return state_; }

  /// Returns the pose of a body in another body's frame, in the middle.
  Pose relative(int from, int body) const;
  /// Returns the motion of a body over the interval in another body's frame. @param chain from the other body to it
  SweptMotion motion(int from, const HingeChain& chain) const;
  /// Returns the motions of all bodies, while the middle body turns about its first axis.
  std::vector<SweptMotion> motions() const;
  /// Returns the deviation of the state in the middle.
  LawDeviation deviation() const;

 private:
  void pass(const ChainStep& step, const Pose& frame, SweptMotion& motion) const;

  const LinkageMotion& linkage_;
  double half_width_, theta_;
  State state_;
  std::vector<double> rates_;       ///< rate of each law in the middle, rad per rad
  std::vector<RateBounds> bounds_;  ///< bounds of each law over the interval
};

}  // namespace kinetix::model
