#pragma once

#include <functional>
#include <vector>

#include "model/tolerance/observed_points.hpp"

namespace kinetix::model {

/// Standard deviations of what is printed from what was designed, from hinge to hinge, all by themselves.
struct HingeScatter {
  double t = 0;       ///< fraction of the wall
  double alpha = 0;   ///< rad
  double beta = 0;    ///< rad
  double offset = 0;  ///< cell edges
  /// By hinge, where not all are alike; else empty. Then the numbers above are not used. Their own `each` are empty.
  std::vector<HingeScatter> each = {};

  Eigen::Vector4d values() const { return {t, alpha, beta, offset}; }
  /// A column a hinge. @pre each is empty or has as many
  Eigen::Matrix4Xd by_hinge(Eigen::Index hinges) const;
};

/// One hinge's parameter among what makes prints differ.
struct ScatterSource {
  int hinge = 0;
  int parameter = 0;  ///< 0 to 3: t, alpha, beta, offset
  double share = 0;   ///< of the variance, [0, 1]
};

/// Of the normal distribution: 95 of 100 are below.
inline constexpr double quantile_95 = 1.6448536269514722;

/// How far from its goal a structure ends up that is printed with errors, over many prints.
struct AsMade {
  double designed_mm = 0;              ///< rms over the points of the design itself
  double rms_mm = 0;                   ///< root of the mean of its square over prints
  double p95_mm = 0;                   ///< what 95 of 100 prints keep
  std::vector<ScatterSource> sources;  ///< of all hinges and parameters that scatter, largest first
};

struct AsMadeOptions {
  bool aligned =
      true;          ///< deviations count after the best rigid motion of the whole, as of a shape in the hand
  int probes = 150;  ///< beyond so many points, so many random mixtures of them stand for all; >= 2
  bool planar = false;   ///< prints move in the plane z = 0 only
  bool contact = false;  ///< walls of prints that are brought to their equilibria press on each other
  unsigned seed = 1;     ///< of the mixtures
  int threads = 1;  ///< that bring prints to their equilibria; 0 = all cores. Their number changes no result
  std::function<bool()> stop =
      {};  ///< asked before each print that is brought to its equilibrium, from any thread;
           ///< where it says so, no more are
};

/// To first order about an equilibrium under its drive: a print with other hinges settles nearby, by the adjoint.
/// The square of the rms over points is taken for a gamma distribution of the same mean and variance, whose quantile
/// comes by the cube root (Wilson and Hilferty 1931). With more points than probes, mean and variance come from
/// random mixtures of the points (Hutchinson 1990): to about 10 % of what errors add.
///
/// @param tangent linearised at state and factorised without a shift, as for sensitivity()
/// @pre at least one point; one normal and one body each or more
AsMade as_made(const ElasticSystem& system, const State& state, double theta, const TangentStiffness& tangent,
               const std::vector<ObservedPoint>& points, const HingeScatter& scatter,
               const AsMadeOptions& options = {});

}  // namespace kinetix::model
