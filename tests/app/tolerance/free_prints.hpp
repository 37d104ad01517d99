#pragma once

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"
#include "model/material/manufactured_hinge.hpp"

/// Prints with errors, computed independently of model/tolerance and model/elastic. They use separate random numbers.
/// The energy of hinges.md section 1 is a sum of squares in mm and rad. The Gauss-Newton method minimises it with
/// difference quotients.
namespace kinetix::testing {

/// Standard deviations per hinge.
struct FreeErrors {
  double place_mm = 0, tilt = 0;  ///< `place_mm`: along the wall; `tilt`: of beta, rad
};

/// Returns a sheet whose hinges have random errors in position and tilt.
inline model::Lattice with_errors(model::Lattice sheet, const FreeErrors& sd, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0, 1);
  for (int h = 0; h < sheet.hinges(); ++h) {
    const model::HingedWall wall = sheet.wall(h);
    const double length_mm = (sheet.rest_position(wall.upper) - sheet.rest_position(wall.lower)).norm();
    sheet.hinge(h).t += sd.place_mm / length_mm * normal(random);
    sheet.hinge(h).beta += sd.tilt * normal(random);
  }
  return sheet;
}

/// Energy of blocks with individual rest turns, and of springs in the same hinges.
class FreeSheet {
 public:
  /// @param k of every hinge, in the hinge's frame
  /// @param rests per hinge, rad
  FreeSheet(model::Linkage linkage, const model::HingeStiffness& k, double reach_mm,
            std::vector<double> rests)
      : linkage_(std::move(linkage)),
        root_(std::sqrt(k.axial), std::sqrt(k.shear), std::sqrt(k.along)),
        rock_(std::sqrt(k.rock.value_or(k.axial * reach_mm * reach_mm))),
        twist_(std::sqrt(k.twist.value_or(k.shear * reach_mm * reach_mm))),
        turn_(std::sqrt(k.turn)),
        rests_(std::move(rests)) {}

  /// Adds springs that turn the hinges, too.
  /// @param k N mm/rad
  /// @param rests per hinge, rad
  void add_springs(double k, std::vector<double> rests) {
    spring_ = std::sqrt(k);
    spring_rests_ = std::move(rests);
  }

  /// Fixes the positions of these bodies along the normal of the plates.
  /// @param axis 0 or 1
  void grip(const model::GrippedRows& rows, int axis) {
    axis_ = axis;
    is_gripped_.assign(linkage_.bodies.size(), false);
    for (const auto& row : rows)
      for (const int body : row) is_gripped_[static_cast<std::size_t>(body)] = true;
  }

  static double turn_of(const model::RestHinge& hinge, const model::Pose& lower, const model::Pose& upper) {
    const Eigen::Quaterniond q(Eigen::Matrix3d(lower.R.transpose() * upper.R));
    const double sign = q.w() < 0 ? -1 : 1;
    return 2 * std::atan2(sign * q.vec().dot(hinge.axis), sign * q.w());
  }

  std::vector<double> turns(const model::State& state) const {
    std::vector<double> out;
    for (const model::RestHinge& hinge : linkage_.hinges)
      out.push_back(turn_of(hinge, state[hinge.lower], state[hinge.upper]));
    return out;
  }

  /// Finds the nearest state of minimum energy.
  /// @param planar allows rotation about z and translation across z alone
  /// @return whether it converged
  bool settle(model::State& state, bool planar) const {
    for (int round = 0; round < 200; ++round) {
      const double step = improve(state, planar);
      if (!std::isfinite(step)) return false;
      if (step < 1e-7) return true;
    }
    return false;
  }

 private:
  using Residuals = Eigen::Matrix<double, 8, 1>;
  using Twist = Eigen::Matrix<double, 6, 1>;

  static model::Pose moved(const model::Pose& pose, const Twist& by) {
    const Eigen::Vector3d turn = by.head<3>();
    const double angle = turn.norm();
    model::Pose out = pose;
    out.p += by.tail<3>();
    if (angle > 0) out.R = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * pose.R;
    return out;
  }

  Residuals residuals(std::size_t h, const model::Pose& lower, const model::Pose& upper) const {
    const model::RestHinge& hinge = linkage_.hinges[h];
    const double edge = linkage_.size.edge_mm;
    const Eigen::Vector3d wall = (hinge.edge - hinge.edge.dot(hinge.axis) * hinge.axis).normalized();
    const Eigen::Vector3d c = ((lower.R + upper.R) * hinge.axis).normalized(),
                          n = c.cross(Eigen::Vector3d((lower.R + upper.R) * wall)).normalized(),
                          a = n.cross(c);
    const Eigen::Vector3d gap =
        upper.p + upper.R * (edge * hinge.upper_arm) - lower.p - lower.R * (edge * hinge.lower_arm);
    const Eigen::Vector3d lean = (upper.R - lower.R) * hinge.axis;
    const double turn = turn_of(hinge, lower, upper);
    Residuals out;
    out << root_[0] * a.dot(gap), root_[1] * n.dot(gap), root_[2] * c.dot(gap), rock_ * a.dot(lean),
        twist_ * n.dot(lean), twist_ * c.dot(lean), turn_ * (turn - rests_[h]),
        spring_ > 0 ? spring_ * (turn - spring_rests_[h]) : 0;
    return out;
  }

  /// Takes one step.
  /// @return the largest entry of the step, mm or rad
  double improve(model::State& state, bool planar) const {
    const int bodies = static_cast<int>(state.size()), held = bodies / 2;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(6 * bodies);
    constexpr double d = 1e-6;
    for (std::size_t h = 0; h < linkage_.hinges.size(); ++h) {
      const int both[] = {linkage_.hinges[h].lower, linkage_.hinges[h].upper};
      const Residuals at = residuals(h, state[both[0]], state[both[1]]);
      Eigen::Matrix<double, 8, 12> J;
      for (int k = 0; k < 12; ++k) {
        const Twist by = d * Twist::Unit(k % 6);
        const auto moved_by = [&](const Twist& t) {
          return k < 6 ? residuals(h, moved(state[both[0]], t), state[both[1]])
                       : residuals(h, state[both[0]], moved(state[both[1]], t));
        };
        J.col(k) = (moved_by(by) - moved_by(-by)) / (2 * d);
      }
      const Eigen::Matrix<double, 12, 12> hessian = J.transpose() * J;
      const Eigen::Matrix<double, 12, 1> slope = J.transpose() * at;
      for (int r = 0; r < 12; ++r) {
        gradient[6 * both[r / 6] + r % 6] += slope[r];
        for (int c = 0; c < 12; ++c)
          entries.emplace_back(6 * both[r / 6] + r % 6, 6 * both[c / 6] + c % 6, hessian(r, c));
      }
    }
    const auto is_held = [&](Eigen::Index k) {
      const Eigen::Index own = k % 6;
      // Between plates a sheet may still translate along them and rotate about their normal.
      if (axis_ >= 0 && own == 3 + axis_) return bool(is_gripped_[static_cast<std::size_t>(k / 6)]);
      if (axis_ >= 0) return k / 6 == held && (own == axis_ || own >= 3);
      return k / 6 == held || (planar && (own < 2 || own == 5));
    };
    std::erase_if(entries, [&](const auto& e) { return is_held(e.row()) || is_held(e.col()); });
    for (Eigen::Index k = 0; k < gradient.size(); ++k) {
      if (!is_held(k)) continue;
      gradient[k] = 0;
      entries.emplace_back(k, k, 1);
    }
    Eigen::SparseMatrix<double> hessian(gradient.size(), gradient.size());
    hessian.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(hessian);
    if (factor.info() != Eigen::Success) return std::nan("");
    const Eigen::VectorXd step = -factor.solve(gradient);
    const double before = energy(state);
    // Steps that would raise the energy are shortened. With stiff hinges, full steps oscillate for ever.
    for (double part = 1; part > 1e-6; part /= 2) {
      model::State next = state;
      for (int b = 0; b < bodies; ++b) next[b] = moved(state[b], part * step.segment<6>(6 * b));
      if (!(energy(next) <= before * (1 + 1e-12))) continue;
      state = std::move(next);
      return part * step.cwiseAbs().maxCoeff();
    }
    return 0;
  }

  double energy(const model::State& state) const {
    double sum = 0;
    for (std::size_t h = 0; h < linkage_.hinges.size(); ++h)
      sum += residuals(h, state[linkage_.hinges[h].lower], state[linkage_.hinges[h].upper]).squaredNorm();
    return sum / 2;
  }

  model::Linkage linkage_;
  Eigen::Vector3d root_;
  double rock_, twist_, turn_, spring_ = 0;
  std::vector<double> rests_, spring_rests_;
  int axis_ = -1;
  std::vector<bool> is_gripped_;
};

}  // namespace kinetix::testing
