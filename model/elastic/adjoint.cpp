#include "model/elastic/adjoint.hpp"

#include <Eigen/LU>

namespace kinetix::model {
namespace {

using Eigen::VectorXd;

/// One column per hinge: derivatives by axial, shear, along, turn, reach, rock and twist of its Stiffness.
using StiffnessGradients = Eigen::Matrix<double, 7, Eigen::Dynamic>;
constexpr int turn_row = 3, reach_row = 4, rock_row = 5, twist_row = 6;  // of those seven

Eigen::Matrix<double, 7, 1> stacked(const HingeGradient& rate) {
  Eigen::Matrix<double, 7, 1> out;
  out << rate.ratios.axial, rate.ratios.shear, rate.ratios.along, rate.turn, rate.reach, rate.rock,
      rate.twist;
  return out;
}

/// Body that is held about one axis and free about two: its small turns about both do not commute.
struct HalfHeld {
  int body = -1;
  std::array<int, 2> free = {-1, -1};  ///< of the turns 0, 1, 2
};

/// Returns the only half-held body; none: body = -1.
HalfHeld half_held(const DofMap& dofs) {
  for (std::size_t b = 0; b < dofs.unknown.size(); ++b) {
    const auto& turns = dofs.unknown[b];
    for (int k = 0; k < 3; ++k)
      if (turns[k] < 0 && turns[(k + 1) % 3] >= 0 && turns[(k + 2) % 3] >= 0)
        return {static_cast<int>(b), {(k + 1) % 3, (k + 2) % 3}};
  }
  return {};
}

class Adjoint {
 public:
  /// @param contacts those of the state
  Adjoint(const ElasticSystem& system, const State& state, double theta, const TangentStiffness& tangent,
          const std::vector<Contact>& contacts)
      : system_(system), state_(state), theta_(theta), tangent_(tangent), contacts_(contacts) {}

  /// Solves for lambda. @param load, energy derivatives of f, in the system's units
  void solve(const VectorXd& by_state, double load, double energy) {
    energy_ = energy;
    if (system_.holds_coordinate())
      solve_driven(by_state, load);
    else if (!system_.drive().is_external())
      solve_springs(by_state, load);
    else
      solve_plates(by_state, load);
  }

  double theta_rate() const { return by_theta_; }

  StiffnessGradients add_hinges(Eigen::Matrix4Xd& out) const {
    StiffnessGradients derivatives(7, system_.hinges().size());
    const double edge_mm = system_.structure().size.edge_mm;
    for (std::size_t h = 0; h < system_.hinges().size(); ++h) {
      const RestHinge& hinge = system_.hinges()[h];
      const auto [by_energy, along] =
          hinge_gradients(hinge, system_.stiffness().of(h), state_[hinge.lower], state_[hinge.upper], edge_mm,
                          pair(hinge.lower, hinge.upper));
      out.col(h) += energy_ * by_energy.design - along.design;
      derivatives.col(h) = energy_ * stacked(by_energy) - stacked(along);
    }
    return derivatives;
  }

  /// Returns the derivatives of the forces on a hinge's two bodies by its design: one column per coordinate
  /// of the bodies.
  Eigen::Matrix<double, 4, 12> forces_by_design(int h) const {
    const RestHinge& hinge = system_.hinges()[h];
    const double edge_mm = system_.structure().size.edge_mm;
    Eigen::Matrix<double, 4, 12> out;
    for (int k = 0; k < 12; ++k)
      out.col(k) = hinge_gradients(hinge, system_.stiffness().of(h), state_[hinge.lower], state_[hinge.upper],
                                   edge_mm, Vector12::Unit(k))
                       .along.design;
    return out;
  }

  /// Returns the derivatives of the forces of a hinge's spring by its design, one column per coordinate.
  Eigen::Matrix<double, 4, 12> spring_forces_by_design(int h) const {
    const RestHinge& hinge = system_.hinges()[h];
    const Element turn = RelativeTurn(hinge, state_[hinge.lower], state_[hinge.upper]).element();
    const double off = turn.energy - system_.spring_rest(h, theta_);
    Eigen::Matrix<double, 4, 12> out;
    for (int k = 0; k < 12; ++k) {
      const TurnGradients derivatives =
          turn_gradients(hinge, state_[hinge.lower], state_[hinge.upper], Vector12::Unit(k));
      out.col(k) = system_.k_spring() * (turn.gradient[k] * derivatives.turn + off * derivatives.along);
    }
    return out;
  }

  /// Returns the change of the state because of `force` (by all coordinates), the force of a change of all
  /// hinges.
  VectorXd change(VectorXd force, const Eigen::Matrix4Xd& changes) const {
    const DofMap& dofs = system_.dofs();
    const int h = system_.driven_hinge();
    if (h < 0) return dofs.extend(-solve_by_rate(dofs.restrict(force), Side::plain));
    // The turn of the driven hinge stays: a . x + (its change by the hinge's parameters) = 0.
    const RestHinge& hinge = system_.hinges()[h];
    const auto rates = [&](const Vector12& twists) {
      return turn_gradients(hinge, state_[hinge.lower], state_[hinge.upper], twists);
    };
    const double held = -system_.load(state_, theta_), own = rates(Vector12::Zero()).turn.dot(changes.col(h));
    for (int k = 0; k < 12; ++k)
      force[6 * (k < 6 ? hinge.lower : hinge.upper) + k % 6] +=
          held * rates(Vector12::Unit(k)).along.dot(changes.col(h));
    const VectorXd a = dofs.restrict(system_.driven_gradient(state_)), driven = tangent_.solve(a),
                   free = -tangent_.solve(dofs.restrict(force));
    return dofs.extend(free - (a.dot(free) + own) / a.dot(driven) * driven);
  }

  Vector12 twists_of(int h) const {
    const RestHinge& hinge = system_.hinges()[h];
    return pair(hinge.lower, hinge.upper);
  }

  void add_drive(Eigen::Matrix4Xd& out) const {
    if (system_.drive().only_pulls()) return add_cord(out);
    const int driven = system_.driven_hinge();
    if (driven < 0) return;
    const TurnGradients derivatives = rates_of_turn(driven);
    out.col(driven) -= force_ * derivatives.along + turn_ * derivatives.turn;
  }

  /// Adds the derivatives by the hinges of the springs. @return derivative of f by the springs' relative
  /// stiffness
  double add_springs(Eigen::Matrix4Xd& out) const {
    double sum = 0;
    const double k = system_.k_spring();
    for (const int h : system_.drive().springs) {
      const RestHinge& hinge = system_.hinges()[h];
      const int sense = system_.structure().bodies[hinge.lower].sense;
      const Element turn = RelativeTurn(hinge, state_[hinge.lower], state_[hinge.upper]).element();
      const double off = turn.energy - system_.spring_rest(h, theta_);
      const double along = turn.gradient.dot(pair(hinge.lower, hinge.upper));
      const TurnGradients derivatives = rates_of_turn(h);
      out.col(h) +=
          k * ((energy_ * off - along + load_ * sense) * derivatives.turn - off * derivatives.along);
      sum += (0.5 * energy_ * off - along + load_ * sense) * off;
    }
    return sum;
  }

  /// Adds the derivatives by the hinges in contact. @return derivative of f by the relative stiffness of
  /// contact
  double add_contacts(Eigen::Matrix4Xd& out) const {
    const ContactModel& walls = system_.walls();
    const double k = system_.stiffness().contact;
    double sum = 0;
    for (const Contact& c : contacts_) {
      const Vector12 lambda = pair(walls.body(c.plate), walls.body(c.other));
      ContactModel::ByTwoHinges by_design = -walls.derivatives(c, k, state_).transpose() * lambda;
      sum -= walls.stiffness_rate(c, state_).dot(lambda);
      if (energy_ != 0) {
        const double unit = energy_ * walls.energy({c}, 1);
        by_design += 2 * k * unit / c.depth * walls.depth_gradient(c, state_);
        sum += unit;
      }
      const int own = ContactModel::hinge(c.plate), other = ContactModel::hinge(c.other);
      out.col(own).head<3>() += by_design.head<3>();
      out.col(other).head<3>() += by_design.tail<3>();
    }
    return sum;
  }

 private:
  TurnGradients rates_of_turn(int h) const {
    const RestHinge& hinge = system_.hinges()[h];
    return turn_gradients(hinge, state_[hinge.lower], state_[hinge.upper], pair(hinge.lower, hinge.upper));
  }

  /// Adds the derivatives of the tendon constraint, flat length times cos(theta) minus length, by t and
  /// offset of the hinges on the tendon.
  void add_cord(Eigen::Matrix4Xd& out) const {
    const Linkage& s = system_.structure();
    const std::vector<int>& through = system_.drive().through;
    const CordGradients now = cord_gradients(s, through, state_, lambda_),
                        flat = cord_gradients(s, through, rest_state(s), VectorXd::Zero(lambda_.size()));
    const PointGradients held = std::cos(theta_) * flat.length - now.length;
    for (std::size_t k = 0; k < through.size(); ++k) {
      const Eigen::Vector2d by = force_ * now.along.col(k) - turn_ * held.col(k);
      out(0, through[k]) += by[0];
      out(3, through[k]) += by[1];
    }
  }

  Vector12 pair(int a, int b) const {
    Vector12 out;
    out << lambda_.segment<6>(6 * a), lambda_.segment<6>(6 * b);
    return out;
  }

  Eigen::Vector3d moment_on(int body) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const auto add = [&](int a, int b, const auto& element) {
      if (a == body) sum += element().gradient.template segment<3>(0);
      if (b == body) sum += element().gradient.template segment<3>(6);
    };
    const double edge_mm = system_.structure().size.edge_mm;
    for (std::size_t k = 0; k < system_.hinges().size(); ++k) {
      const RestHinge& h = system_.hinges()[k];
      add(h.lower, h.upper, [&] {
        return hinge_element(h, system_.stiffness().of(k), state_[h.lower], state_[h.upper], edge_mm);
      });
    }
    const ContactModel& walls = system_.walls();
    for (const Contact& c : contacts_)
      add(walls.body(c.plate), walls.body(c.other),
          [&] { return walls.element(c, system_.stiffness().contact, state_); });
    return sum;
  }

  enum class Side { transposed, plain };

  /// Solves with the derivative of the gradient, or with its transpose. That derivative is the Hessian,
  /// except for a half-held body with a moment about its held axis. There, half the cross product of the
  /// moment is added, which is antisymmetric.
  VectorXd solve_by_rate(const VectorXd& rhs, Side side) const {
    const VectorXd plain = tangent_.solve(rhs);
    const HalfHeld held = half_held(system_.dofs());
    if (held.body < 0) return plain;
    const auto [i, j] = held.free;
    const double k = (side == Side::transposed ? 0.5 : -0.5) * cross_matrix(moment_on(held.body))(i, j);
    const auto& unknown = system_.dofs().unknown[held.body];
    const Eigen::Vector2i at(unknown[i], unknown[j]);
    const VectorXd first = tangent_.solve(VectorXd::Unit(rhs.size(), at[0])),
                   second = tangent_.solve(VectorXd::Unit(rhs.size(), at[1]));
    Eigen::Matrix2d m;
    m << 1 - k * second[at[0]], k * first[at[0]], -k * second[at[1]], 1 + k * first[at[1]];
    const Eigen::Vector2d both = m.inverse() * Eigen::Vector2d(plain[at[0]], plain[at[1]]);
    return plain + k * (both[0] * second - both[1] * first);
  }

  /// Solves for lambda under plates. The load is minus the sum of the gradient's entries at the last row.
  void solve_plates(VectorXd by_state, double load) {
    const DofMap& dofs = system_.dofs();
    VectorXd pressed = VectorXd::Zero(dofs.coordinates());
    if (load != 0) {
      const int coordinate = system_.drive().axis == Axis::x ? 3 : 4;
      for (const int body : system_.gripped()[1]) pressed[6 * body + coordinate] = load;
      by_state -= tangent_.multiply_all(pressed);
    }
    const VectorXd unknowns = solve_by_rate(dofs.restrict(by_state), Side::transposed);
    const VectorXd moved = system_.place_rate(theta_);
    lambda_ = dofs.extend(unknowns);
    by_theta_ = by_state.dot(moved) - lambda_.dot(tangent_.multiply_all(moved));
    if (energy_ != 0) by_theta_ += energy_ * system_.gradient(state_, theta_).dot(moved);
    lambda_ += pressed;
  }

  /// Solves for lambda under springs. The load is the derivative of the energy by the drive's coordinate, 2
  /// theta.
  void solve_springs(VectorXd by_state, double load) {
    const DofMap& dofs = system_.dofs();
    const VectorXd gradient = system_.spring_gradient(state_);
    by_state += load * gradient;
    lambda_ = dofs.extend(tangent_.solve(dofs.restrict(by_state)));
    load_ = load;
    const double own = load * system_.k_spring() * static_cast<double>(system_.drive().springs.size());
    by_theta_ = system_.drive().coordinate_rate(theta_) *
                (own - lambda_.dot(gradient) + energy_ * system_.load(state_, theta_));
  }

  /// Solves for lambda and the drive's force, with the constraint on the driven coordinate (a hinge's turn, a
  /// tendon).
  void solve_driven(const VectorXd& by_state, double load) {
    const DofMap& dofs = system_.dofs();
    const VectorXd along = dofs.restrict(system_.driven_gradient(state_)),
                   free = tangent_.solve(dofs.restrict(by_state)), driven = tangent_.solve(along);
    force_ = -system_.load(state_, theta_);
    const double share = (free.dot(along) + load) / driven.dot(along);
    lambda_ = dofs.extend(free - share * driven);
    turn_ = share - ElasticSystem::grip * load - energy_ * force_;
    by_theta_ = turn_ * system_.driven_rate(theta_);
  }

  const ElasticSystem& system_;
  const State& state_;
  const double theta_;
  const TangentStiffness& tangent_;
  const std::vector<Contact>& contacts_;
  double energy_ = 0;
  VectorXd lambda_;   ///< by all coordinates
  double turn_ = 0;   ///< the multiplier of the constraint: the driven hinge's turn, or the tendon
  double force_ = 0;  ///< force of the constraint: minus the load
  double load_ = 0;   ///< springs: derivative of f by their load
  double by_theta_ = 0;
};

}  // namespace

struct DesignSensitivities::Table {
  const ElasticSystem& system;
  const State& state;
  const double theta;
  const TangentStiffness& tangent;
  std::vector<Contact> contacts;
  std::vector<Eigen::Matrix<double, 4, 12>> forces;  ///< of each hinge
};

DesignSensitivities::DesignSensitivities(const ElasticSystem& system, const State& state, double theta,
                                         const TangentStiffness& tangent)
    : table_(std::make_unique<Table>(Table{system, state, theta, tangent, system.contacts(state), {}})) {
  const Adjoint adjoint(system, state, theta, tangent, table_->contacts);
  for (int h = 0; h < static_cast<int>(system.hinges().size()); ++h)
    table_->forces.push_back(adjoint.forces_by_design(h));
  for (const int h : system.drive().springs) table_->forces[h] += adjoint.spring_forces_by_design(h);
}

DesignSensitivities::~DesignSensitivities() = default;

DesignSensitivity DesignSensitivities::of(const VectorXd& by_state) const {
  const Table& t = *table_;
  Adjoint adjoint(t.system, t.state, t.theta, t.tangent, t.contacts);
  adjoint.solve(by_state, 0, 0);
  DesignSensitivity out{Eigen::Matrix4Xd(4, t.forces.size()), adjoint.theta_rate()};
  for (int h = 0; h < static_cast<int>(t.forces.size()); ++h)
    out.hinges.col(h) = -t.forces[h] * adjoint.twists_of(h);
  adjoint.add_contacts(out.hinges);
  adjoint.add_drive(out.hinges);
  return out;
}

VectorXd DesignSensitivities::change(const Eigen::Matrix4Xd& changes) const {
  const Table& t = *table_;
  VectorXd force = VectorXd::Zero(t.system.dofs().coordinates());
  for (int h = 0; h < static_cast<int>(t.forces.size()); ++h) {
    const RestHinge& hinge = t.system.hinges()[h];
    const Vector12 on = t.forces[h].transpose() * changes.col(h);
    force.segment<6>(6 * hinge.lower) += on.head<6>();
    force.segment<6>(6 * hinge.upper) += on.tail<6>();
  }
  return Adjoint(t.system, t.state, t.theta, t.tangent, t.contacts).change(std::move(force), changes);
}

Sensitivity sensitivity(const ElasticSystem& system, const Elasticity& elasticity, const State& state,
                        double theta, const TangentStiffness& tangent, const EquilibriumGradient& gradient) {
  const double L = system.structure().size.edge_mm;
  const double force_unit = elasticity.k_point * L, energy_unit = force_unit * L;
  const double load_unit = system.drive().has_force() ? force_unit : energy_unit;
  const VectorXd none = VectorXd::Zero(system.dofs().coordinates());

  const std::vector<Contact> contacts = system.contacts(state);
  Adjoint adjoint(system, state, theta, tangent, contacts);
  adjoint.solve(gradient.state.size() > 0 ? gradient.state : none, gradient.load * load_unit,
                gradient.energy * energy_unit);

  Sensitivity out;
  out.hinges.setZero(4, system.hinges().size());
  out.stiffness = adjoint.add_hinges(out.hinges);
  const double by_contact = adjoint.add_contacts(out.hinges);
  adjoint.add_drive(out.hinges);
  const double by_spring = adjoint.add_springs(out.hinges);
  out.theta = adjoint.theta_rate();
  double by_unit = -by_contact * system.stiffness().contact - by_spring * system.k_spring();
  double by_turn = 0, by_reach = 0;
  for (Eigen::Index h = 0; h < out.stiffness.cols(); ++h) {
    by_turn += out.stiffness(turn_row, h);
    by_reach += out.stiffness(reach_row, h);
    const Stiffness& k = system.stiffness().of(h);
    by_unit -= out.stiffness(turn_row, h) * k.turn + out.stiffness(rock_row, h) * k.tilt.rock.value_or(0) +
               out.stiffness(twist_row, h) * k.tilt.twist.value_or(0);
  }
  out.k_turn = by_turn / energy_unit;
  out.reach_mm = by_reach / L;
  out.k_contact = by_contact / elasticity.k_point;
  out.k_spring = by_spring / energy_unit;
  if (gradient.load != 0) by_unit += gradient.load * load_unit * system.load(state, theta);
  if (gradient.energy != 0) by_unit += gradient.energy * energy_unit * system.stored_energy(state, theta);
  out.k_point = by_unit / elasticity.k_point;
  out.stiffness.topRows<3>() /= 2 * elasticity.k_point;
  for (const int row : {turn_row, rock_row, twist_row}) out.stiffness.row(row) /= energy_unit;
  out.stiffness.row(reach_row) /= L;
  return out;
}

}  // namespace kinetix::model
