#include "model/tolerance/print_tolerance.hpp"

#include <random>

#include "model/base/decompositions.hpp"

namespace kinetix::model {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

ObservedPoints::ObservedPoints(const std::vector<ObservedPoint>& points, bool aligned) : points_(points) {
  for (const ObservedPoint& p : points) count_ += 1.0 / p.directions;
  if (!aligned) return;
  MatrixXd rigid(size(), 6);
  Vector3d middle = Vector3d::Zero();
  for (const ObservedPoint& p : points) middle += p.place / static_cast<double>(points.size());
  for (Eigen::Index k = 0; k < size(); ++k)
    rigid.row(k) << points[k].normal.transpose(),
        (points[k].place - middle).cross(points[k].normal).transpose();
  rigid.rightCols<3>() /= std::max(rigid.rightCols<3>().norm(), 1e-300);
  rigid_ = column_space(rigid);
}

VectorXd ObservedPoints::deviations() const {
  VectorXd out(size());
  for (Eigen::Index k = 0; k < size(); ++k) out[k] = points_[k].miss_mm;
  return out;
}

double ObservedPoints::rms_mm() const { return deviations().norm() / std::sqrt(count_); }

VectorXd ObservedPoints::by_state(const VectorXd& mixture, std::size_t bodies, double edge_mm) const {
  const VectorXd weights = without_rigid_motion(mixture);
  VectorXd out = VectorXd::Zero(6 * static_cast<Eigen::Index>(bodies));
  for (Eigen::Index k = 0; k < size(); ++k)
    for (const int body : points_[k].bodies)
      out.segment<3>(6 * body + 3) +=
          weights[k] * edge_mm / static_cast<double>(points_[k].bodies.size()) * points_[k].normal;
  return out;
}

VectorXd ObservedPoints::without_rigid_motion(const VectorXd& deviations) const {
  if (rigid_.cols() == 0) return deviations;
  return deviations - rigid_ * (rigid_.transpose() * deviations);
}

namespace {

/// Returns the unit vectors of all points, or random mixtures of the points with entries +-1.
std::vector<VectorXd> mixtures(Eigen::Index points, const ToleranceOptions& options) {
  std::vector<VectorXd> out;
  if (points <= options.probes) {
    for (Eigen::Index k = 0; k < points; ++k) out.push_back(VectorXd::Unit(points, k));
    return out;
  }
  std::mt19937 random(options.seed);
  for (int k = 0; k < options.probes; ++k) {
    VectorXd z(points);
    for (double& entry : z) entry = random() % 2 == 0 ? 1 : -1;
    out.push_back(std::move(z));
  }
  return out;
}

/// Traces of the covariance C of all points' deviations, and of its square: mm^2 and mm^4.
struct Moments {
  double trace = 0, trace_of_square = 0;
};

/// Returns the traces exactly. @param rows one per point, C = rows rows^T
Moments moments_of_points(const MatrixXd& rows) {
  return {rows.squaredNorm(), (rows * rows.transpose()).squaredNorm()};
}

/// Estimates the traces. @param rows one per random mixture z: z C z has the trace as its mean, (z C z')^2
/// that of the square
Moments moments_of_mixtures(const MatrixXd& rows) {
  const MatrixXd products = rows * rows.transpose();
  const auto count = static_cast<double>(rows.rows());
  return {products.trace() / count,
          (products.squaredNorm() - products.diagonal().squaredNorm()) / (count * (count - 1))};
}

/// Returns the 95 % quantile of a gamma distribution.
double quantile(double mean, double variance) {
  if (!(variance > 0)) return mean;
  const double ninth = variance / (9 * mean * mean);
  return mean * std::pow(std::max(0.0, 1 - ninth + quantile_95 * std::sqrt(ninth)), 3);
}

std::vector<ScatterSource> sources_of(const VectorXd& variances) {
  std::vector<ScatterSource> out;
  const double sum = variances.sum();
  for (Eigen::Index k = 0; k < variances.size(); ++k)
    if (variances[k] > 0)
      out.push_back({static_cast<int>(k / 4), static_cast<int>(k % 4), variances[k] / sum});
  std::stable_sort(out.begin(), out.end(),
                   [](const ScatterSource& a, const ScatterSource& b) { return a.share > b.share; });
  return out;
}

}  // namespace

Eigen::Matrix4Xd HingeScatter::by_hinge(Eigen::Index hinges) const {
  Eigen::Matrix4Xd out = values().replicate(1, hinges);
  for (std::size_t h = 0; h < each.size(); ++h) out.col(static_cast<Eigen::Index>(h)) = each[h].values();
  return out;
}

ToleranceResult analyse_print_tolerance(const ElasticSystem& system, const State& state, double theta,
                                        const TangentStiffness& tangent,
                                        const std::vector<ObservedPoint>& observed,
                                        const HingeScatter& scatter, const ToleranceOptions& options) {
  const ObservedPoints points(observed, options.aligned);
  const Eigen::Index hinges = static_cast<Eigen::Index>(system.hinges().size());
  const double edge_mm = system.structure().size.edge_mm;
  const Eigen::Matrix4Xd spread = scatter.by_hinge(hinges);
  const DesignSensitivities by_design(system, state, theta, tangent);
  // Returns the derivatives of a mixture of deviations by every hinge's parameters, per standard deviation.
  const auto row = [&](const VectorXd& mixture) -> VectorXd {
    const Eigen::Matrix4Xd by = by_design.of(points.by_state(mixture, state.size(), edge_mm)).hinges;
    return by.cwiseProduct(spread).reshaped();
  };
  const std::vector<VectorXd> mixed = mixtures(points.size(), options);
  MatrixXd rows(static_cast<Eigen::Index>(mixed.size()), 4 * hinges);
  for (std::size_t k = 0; k < mixed.size(); ++k) rows.row(static_cast<Eigen::Index>(k)) = row(mixed[k]);
  const bool is_each = points.size() <= options.probes;
  const Moments moments = is_each ? moments_of_points(rows) : moments_of_mixtures(rows);

  const VectorXd deviations = points.deviations();
  const double along_deviations = deviations.isZero(0) ? 0 : row(deviations).squaredNorm();
  const double count = points.count();
  const double mean = (deviations.squaredNorm() + moments.trace) / count,
               variance = (2 * moments.trace_of_square + 4 * along_deviations) / (count * count);
  ToleranceResult out;
  out.designed_mm = std::sqrt(deviations.squaredNorm() / count);
  out.rms_mm = std::sqrt(mean);
  out.p95_mm = std::sqrt(quantile(mean, variance));
  out.sources = sources_of(rows.colwise().squaredNorm().transpose());
  return out;
}

}  // namespace kinetix::model
