#include "model/tolerance/print_runs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/newton.hpp"
#include "model/tolerance/print_errors.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix4Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d mean_place(const ObservedPoint& point, const State& state) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : point.bodies) sum += state[body].p;
  return sum / static_cast<double>(point.bodies.size());
}

/// Rms distance of a print's points from the goal, after the best small rigid motion of what errors moved. mm
class Distance {
 public:
  Distance(const std::vector<ObservedPoint>& points, bool aligned)
      : points_(points), count_(ObservedPoints(points, false).count()), aligned_(aligned) {
    MatrixXd rigid(points.size(), 6);
    for (std::size_t k = 0; k < points.size(); ++k)
      rigid.row(static_cast<Eigen::Index>(k)) << points[k].normal.transpose(),
          points[k].place.cross(points[k].normal).transpose();
    motions_ = column_space(rigid);
  }

  double operator()(const State& design, const State& print) const {
    return rms(
        [&](const ObservedPoint& p) { return p.normal.dot(mean_place(p, print) - mean_place(p, design)); });
  }
  /// Of a print that differs from the design by a small change of its coordinates (DesignSensitivities::change).
  double operator()(const VectorXd& change, double edge_mm) const {
    return rms([&](const ObservedPoint& p) {
      double sum = 0;
      for (const int body : p.bodies) sum += edge_mm * p.normal.dot(change.segment<3>(6 * body + 3));
      return sum / static_cast<double>(p.bodies.size());
    });
  }

 private:
  /// @param shift of a point along its normal, mm
  template <class Shift>
  double rms(const Shift& shift) const {
    VectorXd designed(static_cast<Eigen::Index>(points_.size())),
        moved(static_cast<Eigen::Index>(points_.size()));
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      designed[row] = points_[k].miss_mm;
      moved[row] = shift(points_[k]);
    }
    if (aligned_) {
      const VectorXd shares = motions_.transpose() * moved;
      moved -= motions_ * shares;
    }
    return (designed + moved).norm() / std::sqrt(count_);
  }

  const std::vector<ObservedPoint>& points_;
  double count_;
  MatrixXd motions_;  // orthonormal, of small rigid motions
  bool aligned_;
};

/// How prints differ from the design to first order.
class FirstOrder {
 public:
  FirstOrder(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
             const State& state, bool planar)
      : state_(state), system_(printed({}), elasticity, drive, planar, false), tangent_(system_.dofs()) {
    system_.place(drive.theta(), state_);
    if (settle(system_, drive.theta(), state_, tangent_))
      by_hinges_.emplace(system_, state_, drive.theta(), tangent_);
  }

  bool is_known() const { return by_hinges_.has_value(); }
  double edge_mm() const { return system_.structure().size.edge_mm; }
  /// Of all coordinates; zero where it is not known.
  VectorXd change(const Matrix4Xd& errors) const {
    return is_known() ? by_hinges_->change(errors) : VectorXd(VectorXd::Zero(system_.dofs().coordinates()));
  }

 private:
  State state_;
  ElasticSystem system_;
  TangentStiffness tangent_;
  std::optional<DesignSensitivities> by_hinges_;
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
  PrintErrors errors(scatter, static_cast<Eigen::Index>(system.structure().hinges.size()), options.seed);
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
  const FirstOrder first_order(printed, elasticity, drive, state, options.planar);
  std::vector<double> distances;
  double first_order_squares = 0;
  PrintRuns out;
  out.failed = visit_prints(printed, elasticity, drive, state, scatter, count, options,
                            [&](const State& design, const State& print, const Matrix4Xd& errors) {
                              distances.push_back(distance(design, print));
                              const double first =
                                  distance(first_order.change(errors), first_order.edge_mm());
                              first_order_squares += first * first;
                            });
  std::sort(distances.begin(), distances.end());
  out.prints = static_cast<int>(distances.size());
  out.rms_mm = out.p95_mm = out.first_order_rms_mm = std::nan("");
  if (distances.empty()) return out;
  double squares = 0;
  for (const double d : distances) squares += d * d;
  out.rms_mm = std::sqrt(squares / out.prints);
  if (first_order.is_known()) out.first_order_rms_mm = std::sqrt(first_order_squares / out.prints);
  out.p95_mm = distances[out.kept() - 1];
  return out;
}

}  // namespace kinetix::model
