#include "model/tolerance/print_runs.hpp"

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix4Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d mean_place(const ObservedPoint& point, const State& state) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : point.bodies) sum += state[body].p;
  return sum / static_cast<double>(point.bodies.size());
}

/// Rms distance of a print's points from the goal, mm, after the best small rigid motion of the shifts by
/// errors.
class Distance {
 public:
  Distance(const std::vector<ObservedPoint>& points, bool aligned)
      : points_(points), observed_(points, aligned), designed_(observed_.deviations()) {}

  double operator()(const State& design, const State& print) const {
    return rms(
        [&](const ObservedPoint& p) { return p.normal.dot(mean_place(p, print) - mean_place(p, design)); });
  }
  /// Returns the distance of a print that differs from the design by a small change of coordinates, as from
  /// DesignSensitivities::change.
  double operator()(const VectorXd& change, double edge_mm) const {
    return rms([&](const ObservedPoint& p) {
      double sum = 0;
      for (const int body : p.bodies) sum += edge_mm * p.normal.dot(change.segment<3>(6 * body + 3));
      return sum / static_cast<double>(p.bodies.size());
    });
  }

 private:
  /// Returns the rms distance. @param shift of a point along its normal, mm
  template <class Shift>
  double rms(const Shift& shift) const {
    VectorXd moved(observed_.size());
    for (Eigen::Index k = 0; k < moved.size(); ++k) moved[k] = shift(points_[k]);
    return (designed_ + observed_.without_rigid_motion(moved)).norm() / std::sqrt(observed_.count());
  }

  const std::vector<ObservedPoint>& points_;
  ObservedPoints observed_;
  VectorXd designed_;
};

/// Compares the distances in equilibrium and to first order. Both have the same errors, so their ratio is
/// more accurate than either. @pre rms_mm
void compare(const std::vector<std::pair<double, double>>& squares, PrintRuns& out) {
  const auto count = static_cast<double>(squares.size());
  double first = 0, apart = 0;
  for (const auto& [settled, to_first_order] : squares) first += to_first_order / count;
  out.first_order_rms_mm = std::sqrt(first);
  const double ratio = out.rms_mm / out.first_order_rms_mm;
  for (const auto& [settled, to_first_order] : squares)
    apart += std::pow(settled - ratio * ratio * to_first_order, 2);
  // Standard error of the squared ratio, divided by 2: a square has twice the relative error.
  out.ratio_error = std::sqrt(apart / (count * std::max(count - 1, 1.0))) / (2 * ratio * first);
}

constexpr int block = 64;  // prints whose states are kept at once

}  // namespace

int visit_prints(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
                 const State& state, const HingeScatter& scatter, int count, const ToleranceOptions& options,
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

PrintRuns print_runs(const PrintedLinkage& printed, const SettledDesign& design,
                     const std::vector<ObservedPoint>& points, const HingeScatter& scatter, int count,
                     const ToleranceOptions& options) {
  const Distance distance(points, options.aligned);
  const double edge_mm = design.system().structure().size.edge_mm;
  std::vector<double> distances;
  std::vector<std::pair<double, double>> squares_of_both;  // in equilibrium, to first order
  PrintRuns out;
  out.failed =
      visit_prints(printed, design.elasticity(), design.drive(), design.state(), scatter, count, options,
                   [&](const State& rest, const State& print, const Matrix4Xd& errors) {
                     distances.push_back(distance(rest, print));
                     if (!design.is_stable()) return;
                     const double first = distance(design.change(errors), edge_mm);
                     squares_of_both.emplace_back(distances.back() * distances.back(), first * first);
                   });
  std::sort(distances.begin(), distances.end());
  out.prints = static_cast<int>(distances.size());
  out.rms_mm = out.p95_mm = out.first_order_rms_mm = out.ratio_error = std::nan("");
  if (distances.empty()) return out;
  double squares = 0;
  for (const double d : distances) squares += d * d;
  out.rms_mm = std::sqrt(squares / out.prints);
  if (design.is_stable()) compare(squares_of_both, out);
  out.p95_mm = distances[out.kept() - 1];
  return out;
}

namespace {

/// Returns the theta at which the path of a print ends, rad; NaN if it does not reach the end of the drive.
double pressed_theta(const Linkage& print, const Elasticity& elasticity, const LinkageDrive& drive,
                     const EquilibriumPathOptions& options) {
  const EquilibriumPath path = trace_equilibrium({print, drive, {}}, elasticity, options);
  return path.stop == EquilibriumPath::Stop::reached ? mean_theta(print, path.state) : std::nan("");
}

/// Final theta of a print that is driven to either side, times the sign of the requested side, rad.
struct Ends {
  double there = NAN, back = NAN;
};

}  // namespace

std::optional<FlatStarts> flat_starts(const PrintedLinkage& printed, const Elasticity& elasticity,
                                      const LinkageDrive& drive, const HingeScatter& scatter, int count,
                                      const ToleranceOptions& options, EquilibriumPathOptions path) {
  const auto stops = [&] { return options.stop && options.stop(); };
  path.planar = options.planar;
  const double theta = drive.theta();
  PrintErrors errors(scatter, static_cast<Eigen::Index>(printed({}).hinges.size()), options.seed);
  std::vector<Eigen::Matrix4Xd> all(static_cast<std::size_t>(count));
  for (Eigen::Matrix4Xd& of_print : all) of_print = errors.next();
  std::vector<Ends> ends(all.size());
  run_in_parallel(count, options.threads, [&](int k) {
    if (stops()) return;
    try {
      const Linkage print = printed(all[k]);
      const double sign = std::copysign(1.0, theta);
      ends[k].there = sign * pressed_theta(print, elasticity, drive, path);
      ends[k].back = sign * pressed_theta(print, elasticity, drive.to(-theta), path);
    } catch (const InvalidInput&) {  // walls that overlap as printed
    }
  });
  if (stops()) return std::nullopt;
  FlatStarts out;
  for (const Ends& end : ends) {
    const bool has_ends = std::isfinite(end.there) && std::isfinite(end.back);
    out.prints += has_ends;
    out.failed += !has_ends;
    out.other_side += has_ends && end.there < 0 && end.back < 0;
    out.either_side += has_ends && (end.there < 0) != (end.back < 0);
  }
  return out;
}

}  // namespace kinetix::model
