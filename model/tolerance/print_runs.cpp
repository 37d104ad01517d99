#include "model/tolerance/print_runs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <random>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
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

// Rad, cell edges: the last step of a print, which errors move by a hundredth at the least.
constexpr double at_rest = 1e-7;
constexpr int block = 64;  // prints whose states are kept at once

NewtonOptions newton_options() {
  NewtonOptions options;
  options.step_tolerance = at_rest;
  return options;
}

/// A structure under its drive, of which prints are made.
struct Scene {
  const PrintedLinkage& printed;
  const Elasticity& elasticity;
  const LinkageDrive& drive;
  bool planar, contact;

  ElasticSystem system(const Matrix4Xd& errors) const {
    return {printed(errors), elasticity, drive, planar, contact};
  }
};

/// Finds equilibria of prints, each from that of the design and by its factor first: where prints differ little, most of
/// them come to rest without one of their own. What a print comes to depends on no other.
class Rest {
 public:
  /// @param design in equilibrium, with the drive's multiplier
  Rest(const Scene& scene, const State& design, double multiplier)
      : scene_(scene), design_(design), system_(scene.system({})) {
    system_.set_multiplier(multiplier);
  }

  /// Nothing where no stable equilibrium is found, and where walls that press on each other overlap as built.
  std::optional<State> of(const Matrix4Xd& errors) {
    restore();
    try {
      return settled(scene_.system(errors));
    } catch (const InvalidInput&) {
      return std::nullopt;
    }
  }

 private:
  std::optional<State> settled(ElasticSystem print) {
    print.set_multiplier(system_.multiplier());
    State state = design_;
    const double theta = scene_.drive.theta();
    print.place(theta, state);
    const NewtonResult found =
        minimise(print, theta, newton_options(), state, *tangent_, tangent_->is_factorised());
    is_of_design_ = false;
    if (!found.converged || !found.stable) return std::nullopt;
    return state;
  }

  void restore() {
    if (is_of_design_) return;
    // Contacts of the print before are left in the pattern of its tangent, which the next must not depend on.
    if (!tangent_ || scene_.contact) tangent_.emplace(system_.dofs());
    system_.linearise(design_, scene_.drive.theta(), *tangent_);
    tangent_->factorise(0);
    is_of_design_ = true;
  }

  const Scene& scene_;
  const State& design_;
  ElasticSystem system_;
  std::optional<TangentStiffness>
      tangent_;  ///< of the bodies of any print: what is held and which hinges there are is the same
  bool is_of_design_ = false;
};

struct Print {
  bool tried = false;
  std::optional<State> state;  ///< that it comes to, if any
};

/// The same of many, on as many threads as there are of `rests`; less once it stops.
std::vector<Print> made(std::deque<Rest>& rests, const std::vector<Matrix4Xd>& errors,
                        const std::function<bool()>& stops) {
  std::vector<Print> out(errors.size());
  const auto workers = static_cast<int>(rests.size());
  run_in_parallel(workers, workers, [&](int w) {
    for (std::size_t k = w; k < errors.size() && !stops(); k += rests.size())
      out[k] = {true, rests[w].of(errors[k])};
  });
  return out;
}

}  // namespace

int visit_prints(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
                 const State& state, const HingeScatter& scatter, int count, const AsMadeOptions& options,
                 const std::function<void(const State&, const State&, const Matrix4Xd&)>& visit) {
  const Scene scene{printed, elasticity, drive, options.planar, options.contact};
  const auto stops = [&] { return options.stop && options.stop(); };
  ElasticSystem system = scene.system({});
  TangentStiffness tangent(system.dofs());
  State design = state;
  system.place(drive.theta(), design);
  minimise(system, drive.theta(), {}, design, tangent);
  std::deque<Rest> rests;
  for (int w = 0; w < std::min(threads_of(options.threads), count); ++w)
    rests.emplace_back(scene, design, system.multiplier());
  Errors errors(scatter, static_cast<Eigen::Index>(system.structure().hinges.size()), options.seed);
  int failed = 0;
  for (int done = 0; done < count && !stops(); done += block) {
    std::vector<Matrix4Xd> own(std::min(block, count - done));
    for (Matrix4Xd& of_print : own) of_print = errors.next();
    const std::vector<Print> prints = made(rests, own, stops);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (prints[k].state) visit(design, *prints[k].state, own[k]);
      failed += prints[k].tried && !prints[k].state;
    }
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
  out.p95_mm = distances[out.kept() - 1];
  return out;
}

}  // namespace kinetix::model
