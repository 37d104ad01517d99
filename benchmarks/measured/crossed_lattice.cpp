#include "benchmarks/measured/crossed_lattice.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "model/hinge/clearance_energy.hpp"

namespace kinetix::bench {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;
using Matrix66 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double stiffness = 1000;      // N/mm: of a pin beyond its clearance
constexpr double longest_step = 0.3;    // mm, rad: of Newton's method
constexpr double enough = 1e-9;         // of the stiffness, N: of the forces that are left
constexpr double held = 1e12;           // N/mm: added to the stiffness of held crosses
constexpr double turn_weight = 500;     // mm^2: makes steps of turns comparable with steps of places
constexpr double first_damping = 1e-3;  // of the stiffness
constexpr double least_damping = 1e-9;  // of the stiffness: keeps the tangent regular within the play
constexpr int most_steps = 4000;        // of Newton's method, far more than the pulls of the benchmarks take
constexpr int most_tries = 40;          // of a step with more damping
constexpr int panels = 2;  // of crosses, one cross per cell each; tips join the crosses of one panel

/// Pin between two crosses, with its place on both.
struct Pin {
  int first, second;
  Vector2d on_first, on_second;
};

Vector2d turned(const Vector2d& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(),
          std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

/// Energy of crosses on pins under a force. Unknowns: x, y, turn of each cross.
class Crosses {
 public:
  explicit Crosses(const CrossedLattice& lattice) : lattice_(lattice) {
    const int n = lattice.side;
    const double psi = std::acos(lattice.spacing_mm / (2 * lattice.arm_mm));
    q_ = force_ = VectorXd::Zero(3 * panels * n * n);
    const Vector2d along_x(lattice.arm_mm, 0), along_y(0, lattice.arm_mm), centre(0, 0);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        pins_.push_back({cross(i, j, 0), cross(i, j, 1), centre, centre});
        for (int panel = 0; panel < panels; ++panel) {
          const int sense = (i + j + panel) % 2 == 0 ? 1 : -1;
          q_.segment<3>(3 * cross(i, j, panel)) << i * lattice.spacing_mm, j * lattice.spacing_mm,
              sense * psi;
          if (i + 1 < n) pins_.push_back({cross(i, j, panel), cross(i + 1, j, panel), along_x, -along_x});
          if (j + 1 < n) pins_.push_back({cross(i, j, panel), cross(i, j + 1, panel), along_y, -along_y});
        }
      }
  }

  PulledLattice pulled(int i, int j, const Vector2d& force) {
    const VectorXd start = q_;
    for (int panel = 0; panel < panels; ++panel) force_.segment<2>(3 * cross(i, j, panel)) = force / panels;
    PulledLattice out{.converged = settle()};
    for (int a = 0; a < lattice_.side; ++a)
      for (int b = 0; b < lattice_.side; ++b) {
        Vector2d moved = Vector2d::Zero();
        for (int panel = 0; panel < panels; ++panel)
          moved += (q_ - start).segment<2>(3 * cross(a, b, panel)) / panels;
        out.moved_mm.push_back(moved);
      }
    return out;
  }

 private:
  int cross(int i, int j, int panel) const { return panels * (lattice_.side * i + j) + panel; }

  /// Both crosses of the first cell are held.
  static constexpr int held_unknowns = 3 * panels;

  Vector2d gap(const Pin& pin, const VectorXd& q) const {
    return q.segment<2>(3 * pin.first) + turned(pin.on_first, q[3 * pin.first + 2]) -
           q.segment<2>(3 * pin.second) - turned(pin.on_second, q[3 * pin.second + 2]);
  }

  double energy(const VectorXd& q) const {
    double sum = -force_.dot(q);
    for (const Pin& pin : pins_) {
      const double distance = gap(pin, q).norm();
      sum += stiffness * (model::clearance_response(distance, lattice_.play_mm).energy +
                          model::loose_stiffness * distance * distance / 2);
    }
    return sum;
  }

  /// Adds the derivatives of a pin's energy.
  void add(const Pin& pin, VectorXd& gradient, Triplets& tangent) const {
    const Vector2d a = turned(pin.on_first, q_[3 * pin.first + 2]),
                   b = turned(pin.on_second, q_[3 * pin.second + 2]), g = gap(pin, q_);
    const double distance = g.norm();
    const auto response = model::clearance_response(distance, lattice_.play_mm);
    Vector2d force = model::loose_stiffness * g;
    Matrix2d K = model::loose_stiffness * Matrix2d::Identity();
    if (response.force > 0) {  // then the distance is not 0
      const Vector2d along = g / distance;
      const Matrix2d projection = along * along.transpose();
      force += response.force * along;
      K += response.stiffness * projection + response.force / distance * (Matrix2d::Identity() - projection);
    }
    Matrix26 J;
    J << 1, 0, -a.y(), -1, 0, b.y(),  //
        0, 1, a.x(), 0, -1, -b.x();
    const Vector6 forces = stiffness * J.transpose() * force;
    Matrix66 H = stiffness * J.transpose() * K * J;
    H(2, 2) -= stiffness * force.dot(a);
    H(5, 5) += stiffness * force.dot(b);
    const auto unknown = [&](int k) { return k < 3 ? 3 * pin.first + k : 3 * pin.second + k - 3; };
    for (int r = 0; r < 6; ++r) {
      gradient[unknown(r)] += forces[r];
      for (int c = 0; c < 6; ++c) tangent.emplace_back(unknown(r), unknown(c), H(r, c));
    }
  }

  /// Tries a damped Newton step. @return whether it lowers the energy; otherwise the damping grows
  bool step(const VectorXd& gradient, const Triplets& tangent, double before) {
    const Eigen::Index unknowns = q_.size();
    Triplets damped = tangent;
    for (int k = 0; k < unknowns; ++k)
      damped.emplace_back(k, k, k < held_unknowns ? held : damping_ * (k % 3 == 2 ? turn_weight : 1));
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(damped.begin(), damped.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    if (factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 0) {
      VectorXd by = -factors.solve(gradient);
      by *= std::min(1.0, longest_step / by.cwiseAbs().maxCoeff());
      if (energy(q_ + by) < before) {
        q_ += by;
        damping_ = std::max(damping_ / 3, least_damping * stiffness);
        return true;
      }
    }
    damping_ *= 4;
    return false;
  }

  bool settle() {
    damping_ = first_damping * stiffness;
    for (int k = 0; k < most_steps; ++k) {
      VectorXd gradient = -force_;
      Triplets tangent;
      for (const Pin& pin : pins_) add(pin, gradient, tangent);
      gradient.head(held_unknowns).setZero();
      if (gradient.norm() < enough * stiffness) return true;
      const double before = energy(q_);
      int tries = 0;
      while (tries < most_tries && !step(gradient, tangent, before)) ++tries;
      if (tries == most_tries) return gradient.norm() < 1e3 * enough * stiffness;
    }
    return false;
  }

  CrossedLattice lattice_;
  std::vector<Pin> pins_;
  VectorXd q_, force_;
  double damping_ = 0;  // N/mm
};

}  // namespace

PulledLattice pull(const CrossedLattice& lattice, int i, int j, const Vector2d& force) {
  return Crosses(lattice).pulled(i, j, force);
}

}  // namespace kinetix::bench
