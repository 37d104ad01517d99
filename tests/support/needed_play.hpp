#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/closure/closure.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/linkage.hpp"

/// Clearance that rigid pins need, by geometry alone: no energy, no stiffness, no code of the elastic model.
namespace kinetix::testing {

/// Least gap of a linkage's hinges while one of them is turned. It is the least, over all states, of the largest
/// distance of the points at +-reach on all axes, across the axis or along it. Lawson's method: each round minimises
/// the sum of squares weighted by w, then multiplies each weight by its distance. A weighted mean can only be below the
/// largest distance, so each round brackets the least one (of the valley that it is in).
class LeastGap {
 public:
  struct Bracket {
    double lower = 0, upper = 0;  ///< mm
  };

  /// @param reach cell edges
  LeastGap(const model::Linkage& linkage, double reach, int turned_hinge)
      : linkage_(linkage),
        reach_(reach),
        turned_(turned_hinge),
        state_(model::rest_state(linkage)),
        weights_(Eigen::VectorXd::Constant(count(), 1.0 / static_cast<double>(count()))) {}

  /// Brackets the least gap at a turn, starting from the state of the last call. @param turn of the hinge, rad
  Bracket at(double turn) {
    turn_ = turn;
    Bracket best;
    best.upper = INFINITY;
    for (int round = 0; round < rounds && !(best.upper <= (1 + enough) * best.lower); ++round) {
      settle();
      const Eigen::VectorXd d = distances(gaps(state_));
      best.lower = std::max(best.lower, std::sqrt(weights_.dot(d.cwiseAbs2())) * linkage_.size.edge_mm);
      best.upper = std::min(best.upper, d.maxCoeff() * linkage_.size.edge_mm);
      weights_ = weights_.cwiseProduct(d / d.maxCoeff()).cwiseMax(min_weight);
      weights_ /= weights_.sum();
    }
    return best;
  }

 private:
  static constexpr int rounds = 2000;         // of Lawson's method, which converges by a constant factor
  static constexpr double enough = 1e-3;      // of the bracket: far below what a pin can be printed to
  static constexpr double min_weight = 1e-9;  // keeps the least squares regular
  static constexpr double hold = 1e3;         // weight of the turn and of the first body's place
  static constexpr double difference = 1e-6;  // rad, cell edges: of the Jacobian's columns

  /// Returns the number of distances: across and along, of two points per hinge.
  Eigen::Index count() const { return 4 * static_cast<Eigen::Index>(linkage_.hinges.size()); }

  /// Returns the part of each point's gap across the axis (3 numbers) and along it, cell edges.
  Eigen::VectorXd gaps(const model::State& state) const {
    Eigen::VectorXd out(2 * count());
    Eigen::Index row = 0;
    for (const model::RestHinge& h : linkage_.hinges) {
      const model::Pose &lower = state[h.lower], &upper = state[h.upper];
      const Eigen::Vector3d axis = (lower.R * h.axis + upper.R * h.axis).normalized();
      for (const double side : {-reach_, reach_}) {
        const Eigen::Vector3d gap = (lower.p - upper.p) / linkage_.size.edge_mm +
                                    lower.R * (h.lower_arm + side * h.axis) -
                                    upper.R * (h.upper_arm + side * h.axis);
        out.segment<3>(row) = gap - gap.dot(axis) * axis;
        out[row + 3] = gap.dot(axis);
        row += 4;
      }
    }
    return out;
  }

  static Eigen::VectorXd distances(const Eigen::VectorXd& gaps) {
    Eigen::VectorXd out(gaps.size() / 2);
    for (Eigen::Index k = 0; 4 * k < gaps.size(); ++k) {
      out[2 * k] = gaps.segment<3>(4 * k).norm();
      out[2 * k + 1] = std::abs(gaps[4 * k + 3]);
    }
    return out;
  }

  Eigen::VectorXd residual(const model::State& state) const {
    const Eigen::VectorXd g = gaps(state);
    Eigen::VectorXd out(g.size() + 1);
    for (Eigen::Index k = 0; 4 * k < g.size(); ++k) {
      out.segment<3>(4 * k) = std::sqrt(weights_[2 * k]) * g.segment<3>(4 * k);
      out[4 * k + 3] = std::sqrt(weights_[2 * k + 1]) * g[4 * k + 3];
    }
    out[g.size()] = hold * (hinge_turn(linkage_, state, turned_) - turn_);
    return out;
  }

  /// Runs Gauss-Newton steps; the first body stays.
  void settle() {
    const Eigen::Index unknowns = 6 * (static_cast<Eigen::Index>(state_.size()) - 1);
    for (int step = 0; step < 50; ++step) {
      const Eigen::VectorXd r = residual(state_);
      Eigen::MatrixXd J(r.size(), unknowns);
      for (Eigen::Index k = 0; k < unknowns; ++k)
        J.col(k) = (residual(moved(difference * Eigen::VectorXd::Unit(unknowns, k))) -
                    residual(moved(-difference * Eigen::VectorXd::Unit(unknowns, k)))) /
                   (2 * difference);
      Eigen::VectorXd by = -J.completeOrthogonalDecomposition().solve(r);
      by *= std::min(1.0, 0.1 / by.norm());
      state_ = moved(by);
      if (by.norm() < 1e-9) return;
    }
  }

  model::State moved(const Eigen::VectorXd& twists) const {
    model::State out = state_;
    for (std::size_t b = 1; b < out.size(); ++b) {
      const Eigen::Vector3d turn = twists.segment<3>(6 * (b - 1));
      if (turn.norm() > 0)
        out[b].R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * out[b].R;
      out[b].p += linkage_.size.edge_mm * twists.segment<3>(6 * (b - 1) + 3);
    }
    return out;
  }

  const model::Linkage& linkage_;
  const double reach_;
  const int turned_;
  double turn_ = 0;
  model::State state_;
  Eigen::VectorXd weights_;
};

/// Returns the clearance that rigid pins need for a hinge to turn from flat to a given angle. Every such motion passes
/// all angles between, so it needs at least the largest of their least gaps. The states of these gaps follow each other
/// without a jump. They are a motion that needs no more.
/// @param turns rad, in the order of the motion; flat comes before them
inline LeastGap::Bracket needed_play(const model::Linkage& linkage, double reach, int turned_hinge,
                                     const std::vector<double>& turns) {
  LeastGap least(linkage, reach, turned_hinge);
  LeastGap::Bracket most;
  for (const double turn : turns) {
    const LeastGap::Bracket here = least.at(turn);
    most.lower = std::max(most.lower, here.lower);
    most.upper = std::max(most.upper, here.upper);
  }
  return most;
}

}  // namespace kinetix::testing
