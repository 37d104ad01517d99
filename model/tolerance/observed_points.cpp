#include "model/tolerance/observed_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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
  const VectorXd weights = without_motion(mixture);
  VectorXd out = VectorXd::Zero(6 * static_cast<Eigen::Index>(bodies));
  for (Eigen::Index k = 0; k < size(); ++k)
    for (const int body : points_[k].bodies)
      out.segment<3>(6 * body + 3) +=
          weights[k] * edge_mm / static_cast<double>(points_[k].bodies.size()) * points_[k].normal;
  return out;
}

VectorXd ObservedPoints::without_motion(const VectorXd& deviations) const {
  if (rigid_.cols() == 0) return deviations;
  return deviations - rigid_ * (rigid_.transpose() * deviations);
}

}  // namespace kinetix::model
