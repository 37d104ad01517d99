#include "model/tolerance/print_runs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "model/base/decompositions.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/newton.hpp"
#include "model/tolerance/print_equilibria.hpp"
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

constexpr int block = 64;  // prints whose states are kept at once

}  // namespace

int visit_prints(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
                 const State& state, const HingeScatter& scatter, int count, const AsMadeOptions& options,
                 const std::function<void(const State&, const State&, const Matrix4Xd&)>& visit) {
  const auto stops = [&] { return options.stop && options.stop(); };
  PrintEquilibria equilibria({printed, elasticity, drive, options.planar, options.contact}, state, count,
                             options);
  PrintErrors errors(scatter, equilibria.hinges(), options.seed);
  int failed = 0;
  for (int done = 0; done < count && !stops(); done += block) {
    std::vector<Matrix4Xd> own(std::min(block, count - done));
    for (Matrix4Xd& of_print : own) of_print = errors.next();
    const std::vector<PrintEquilibria::Print> prints = equilibria.of(own);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (prints[k].state) visit(equilibria.design(), *prints[k].state, own[k]);
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
