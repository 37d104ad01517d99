#include "model/tolerance/print_runs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "model/base/decompositions.hpp"
#include "model/elastic/newton.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix4Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Errors of print after print, normal by Box and Muller: the standard's distributions differ between libraries.
class Errors {
 public:
  Errors(const HingeScatter& scatter, Eigen::Index hinges, unsigned seed)
      : sd_(scatter.by_hinge(hinges)), random_(seed) {}

  Matrix4Xd next() {
    Matrix4Xd errors(4, sd_.cols());
    for (double& entry : errors.reshaped()) entry = normal();
    return sd_.cwiseProduct(errors);
  }

 private:
  double even() {
    return (static_cast<double>(random_()) + 1) / (static_cast<double>(std::mt19937::max()) + 2);
  }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(even()));
    return radius * std::cos(2 * std::numbers::pi * even());
  }

  const Matrix4Xd sd_;
  std::mt19937 random_;
};

Vector3d mean_place(const ObservedPoint& point, const State& state) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : point.bodies) sum += state[body].p;
  return sum / static_cast<double>(point.bodies.size());
}

/// Rms distance of a print's points from the goal, after the best small rigid motion of what errors moved. mm
class Distance {
 public:
  Distance(const std::vector<ObservedPoint>& points, bool aligned) : points_(points), aligned_(aligned) {
    MatrixXd rigid(points.size(), 6);
    for (std::size_t k = 0; k < points.size(); ++k)
      rigid.row(static_cast<Eigen::Index>(k)) << points[k].normal.transpose(),
          points[k].place.cross(points[k].normal).transpose();
    motions_ = column_space(rigid);
  }

  double operator()(const State& design, const State& print) const {
    VectorXd designed(static_cast<Eigen::Index>(points_.size())),
        moved(static_cast<Eigen::Index>(points_.size()));
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      designed[row] = points_[k].miss_mm;
      moved[row] = points_[k].normal.dot(mean_place(points_[k], print) - mean_place(points_[k], design));
    }
    if (aligned_) {
      const VectorXd shares = motions_.transpose() * moved;
      moved -= motions_ * shares;
    }
    return (designed + moved).norm() / std::sqrt(static_cast<double>(points_.size()));
  }

 private:
  const std::vector<ObservedPoint>& points_;
  MatrixXd motions_;  // orthonormal, of small rigid motions
  bool aligned_;
};

/// Finds equilibria of prints, each by the factor of the one before first: prints differ little, so most of them
/// come to rest without one of their own.
class Rest {
 public:
  Rest(Linkage design, const Elasticity& elasticity, const LinkageDrive& drive, bool planar)
      : elasticity_(elasticity),
        drive_(drive),
        planar_(planar),
        design_(std::move(design), elasticity, drive, planar, false),
        tangent_(design_.dofs()) {}

  /// @return whether a stable equilibrium was found from the state given
  bool of_design(State& state) { return settle(design_, state); }
  bool of_print(Linkage print, State& state) {
    ElasticSystem system(std::move(print), elasticity_, drive_, planar_, false);
    system.set_multiplier(design_.multiplier());
    return settle(system, state);
  }

 private:
  bool settle(ElasticSystem& system, State& state) {
    const double theta = drive_.theta();
    system.place(theta, state);
    const NewtonResult result = minimise(system, theta, {}, state, tangent_, tangent_.is_factorised());
    return result.converged && result.stable;
  }

  const Elasticity& elasticity_;
  const LinkageDrive& drive_;
  const bool planar_;
  ElasticSystem design_;
  TangentStiffness
      tangent_;  ///< of the bodies of any print: what is held and which hinges there are is the same
};

}  // namespace

int visit_prints(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
                 const State& state, const HingeScatter& scatter, int count, const AsMadeOptions& options,
                 const std::function<void(const State&, const State&, const Matrix4Xd&)>& visit) {
  State design = state;
  Linkage exact = printed({});
  Errors errors(scatter, static_cast<Eigen::Index>(exact.hinges.size()), options.seed);
  Rest rest(std::move(exact), elasticity, drive, options.planar);
  rest.of_design(design);
  int failed = 0;
  for (int k = 0; k < count && !(options.stop && options.stop()); ++k) {
    State print = design;
    const Matrix4Xd own = errors.next();
    if (rest.of_print(printed(own), print))
      visit(design, print, own);
    else
      ++failed;
  }
  return failed;
}

PrintRuns print_runs(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
                     const State& state, const std::vector<ObservedPoint>& points,
                     const HingeScatter& scatter, int count, const AsMadeOptions& options) {
  const Distance distance(points, options.aligned);
  std::vector<double> distances;
  PrintRuns out;
  out.failed = visit_prints(printed, elasticity, drive, state, scatter, count, options,
                            [&](const State& design, const State& print, const Matrix4Xd&) {
                              distances.push_back(distance(design, print));
                            });
  std::sort(distances.begin(), distances.end());
  out.prints = static_cast<int>(distances.size());
  out.rms_mm = out.p95_mm = std::nan("");
  if (distances.empty()) return out;
  double squares = 0;
  for (const double d : distances) squares += d * d;
  out.rms_mm = std::sqrt(squares / out.prints);
  out.p95_mm = distances[static_cast<std::size_t>(0.95 * (out.prints - 1))];
  return out;
}

}  // namespace kinetix::model
