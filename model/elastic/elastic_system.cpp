#include "model/elastic/elastic_system.hpp"

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

/// Returns the stiffness without tilt terms if bodies stay parallel because they turn about vertical axes
/// only.
Stiffness acting(const Elasticity& elasticity, const Linkage& structure, bool planar) {
  Stiffness stiffness = relative(elasticity, structure.size.edge_mm);
  stiffness.check_count(structure.hinges.size());
  if (!planar || !all_vertical(structure)) return stiffness;
  stiffness.drop_tilt();
  for (Stiffness& hinge : stiffness.each) hinge.drop_tilt();
  return stiffness;
}

void refuse_overlap(const Linkage& structure, const ContactModel& walls) {
  const auto& pair = walls.overlap_at_rest();
  if (!pair) return;
  const auto wall = [&](int plate) { return structure.wall_name(ContactModel::hinge(plate)); };
  throw InvalidInput("walls " + wall(pair->first) + " and " + wall(pair->second) +
                     " overlap in the flat state. Make walls thinner, lower or less tilted, or move hinges "
                     "away from the ends of their walls");
}

void add(Eigen::VectorXd& sum, int a, int b, const Vector12& gradient) {
  sum.segment<6>(6 * a) += gradient.head<6>();
  sum.segment<6>(6 * b) += gradient.tail<6>();
}

}  // namespace

ElasticSystem::ElasticSystem(Linkage structure, const Elasticity& elasticity, LinkageDrive drive, bool planar,
                             bool contact, const std::shared_ptr<const ConvexBodies>& bodies)
    : structure_(std::move(structure)),
      stiffness_(acting(elasticity, structure_, planar)),
      drive_(std::move(drive)),
      contact_(contact && !bodies),
      dofs_(make_dof_map(structure_, drive_, planar)),
      walls_(structure_, planar),
      k_spring_(drive_.k_spring / energy_unit(elasticity, structure_.size.edge_mm)),
      cord_rest_(drive_.rest_mm / structure_.size.edge_mm) {
  if (contact_) refuse_overlap(structure_, walls_);
  if (contact && bodies) pieces_.emplace(*bodies, structure_.size.edge_mm);
}

std::vector<Contact> ElasticSystem::contacts(const State& state) const {
  return contact_ ? walls_.find(state) : std::vector<Contact>{};
}

std::vector<PieceTouch> ElasticSystem::touches(const State& state) const {
  return pieces_ ? pieces_->find(state) : std::vector<PieceTouch>{};
}

int ElasticSystem::touching(const State& state) const {
  return static_cast<int>(contacts(state).size() + touches(state).size());
}

std::string ElasticSystem::describe_touching(const State& state) const {
  if (const std::vector<Contact> found = contacts(state); !found.empty())
    return "walls " + structure_.wall_name(ContactModel::hinge(found.front().plate)) + " and " +
           structure_.wall_name(ContactModel::hinge(found.front().other)) + " touch";
  if (const std::vector<PieceTouch> found = touches(state); !found.empty())
    return "bodies " + structure_.vertex_name(pieces_->body(found.front().piece)) + " and " +
           structure_.vertex_name(pieces_->body(found.front().other)) + " touch";
  return {};
}

bool ElasticSystem::passed_through(const State& before, const State& after) const {
  if (pieces_) return pieces_->passed_through(before, after);
  return contact_ && (walls_.passed_through(before, after) || walls_.sweep_through(before, after));
}

bool ElasticSystem::newly_cross(const State& before, const State& after) const {
  return contact_ && walls_.newly_cross(before, after);
}

void ElasticSystem::place(double theta, State& state) const {
  if (drive_.gripped[0].empty()) return;
  const double L = structure_.size.edge_mm;
  const double low = row(0), high = row(1);
  for (const int side : {0, 1}) {
    const double half = (side == 0 ? -0.5 : 0.5) * (high - low) * std::cos(theta);
    for (const int body : drive_.gripped[side]) state[body].p[axis()] = L * ((low + high) / 2.0 + half);
  }
}

State ElasticSystem::retract(const State& state, const Eigen::VectorXd& twists) const {
  State out = model::retract(structure_, state, twists);
  for (std::size_t b = 0; b < state.size(); ++b)
    for (int k = 0; k < 3; ++k)
      if (dofs_.unknown[b][3 + k] < 0)
        out[b].p[k] = state[b].p[k] + structure_.size.edge_mm * twists[6 * b + 3 + k];
  return out;
}

double ElasticSystem::length(const State& state, const Eigen::VectorXd& twists) const {
  const auto turn = [&](int body) -> Eigen::Vector3d { return twists.segment<3>(6 * body); };
  double longest = 0;
  for (const RestHinge& h : structure_.hinges) {
    const Eigen::Vector3d lower = turn(h.lower).cross(state[h.lower].R * h.lower_arm),
                          upper = turn(h.upper).cross(state[h.upper].R * h.upper_arm),
                          shift = twists.segment<3>(6 * h.upper + 3) - twists.segment<3>(6 * h.lower + 3);
    const double change = (shift + upper - lower).norm();
    if (!std::isfinite(change)) return change;
    longest = std::max({longest, change, turn(h.lower).norm(), turn(h.upper).norm()});
  }
  return longest;
}

Eigen::VectorXd ElasticSystem::place_rate(double theta) const {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(dofs_.coordinates());
  if (drive_.gripped[0].empty()) return rate;
  const int coordinate = 3 + axis();
  const double apart = row(1) - row(0);
  for (const int side : {0, 1})
    for (const int body : drive_.gripped[side])
      rate[6 * body + coordinate] = (side == 0 ? 0.5 : -0.5) * apart * std::sin(theta);
  return rate;
}

double ElasticSystem::drive_miss(const State& state, double theta) const {
  if (is_cord())
    return cord_rest_ * std::cos(theta) -
           cord_length(structure_, drive_.through, state) / structure_.size.edge_mm;
  if (drive_.hinge < 0) return 0;
  return std::remainder(driven_turn(state).energy - turn_at(theta), 2 * pi);
}

Element ElasticSystem::driven_turn(const State& state) const {
  const RestHinge& hinge = structure_.hinges[drive_.hinge];
  return RelativeTurn(hinge, state[hinge.lower], state[hinge.upper]).element();
}

RelativeTurn ElasticSystem::turn_of(int hinge, const State& state) const {
  const RestHinge& h = structure_.hinges[hinge];
  return {h, state[h.lower], state[h.upper]};
}

double ElasticSystem::spring_rest(int hinge, double theta) const {
  return turn_at_theta(sense_of(hinge), theta);
}

double ElasticSystem::spring_energy(const State& state, double theta) const {
  double sum = 0;
  for (const int h : drive_.springs) {
    const double off = turn_of(h, state).angle() - spring_rest(h, theta);
    sum += 0.5 * k_spring_ * off * off;
  }
  return sum;
}

double ElasticSystem::stored_energy(const State& state, double theta) const {
  return elastic_energy(state) + spring_energy(state, theta);
}

Eigen::VectorXd ElasticSystem::spring_gradient(const State& state) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(dofs_.coordinates());
  for (const int h : drive_.springs)
    add(all, structure_.hinges[h].lower, structure_.hinges[h].upper,
        sense_of(h) * k_spring_ * turn_of(h, state).element().gradient);
  return all;
}

Eigen::VectorXd ElasticSystem::driven_gradient(const State& state) const {
  if (is_cord()) return -cord_gradient(structure_, drive_.through, state);
  const RestHinge& hinge = structure_.hinges[drive_.hinge];
  Eigen::VectorXd all = Eigen::VectorXd::Zero(dofs_.coordinates());
  add(all, hinge.lower, hinge.upper, driven_turn(state).gradient);
  return all;
}

double ElasticSystem::elastic_energy(const State& state) const {
  double sum = 0;
  for (std::size_t k = 0; k < structure_.hinges.size(); ++k) {
    const RestHinge& h = structure_.hinges[k];
    sum += hinge_energy(h, stiffness_.of(k), state[h.lower], state[h.upper], structure_.size.edge_mm).total();
  }
  sum += walls_.energy(contacts(state), stiffness_.contact);
  return pieces_ ? sum + pieces_->energy(touches(state), stiffness_.contact) : sum;
}

double ElasticSystem::energy(const State& state, double theta) const {
  const double miss = drive_miss(state, theta);
  return stored_energy(state, theta) + multiplier_ * miss + 0.5 * grip * miss * miss;
}

template <class Visit>
void ElasticSystem::visit_contacts(const State& state, const Visit& visit) const {
  for (const Contact& c : contacts(state))
    visit(walls_.body(c.plate), walls_.body(c.other), walls_.element(c, stiffness_.contact, state));
  for (const PieceTouch& t : touches(state))
    visit(pieces_->body(t.piece), pieces_->body(t.other), pieces_->element(t, stiffness_.contact, state));
}

template <class Visit>
void ElasticSystem::visit_drive(const State& state, double theta, const Visit& visit) const {
  const auto visit_turn = [&](int hinge, Element turn, double force, double stiffness) {
    turn.hessian = force * turn.hessian + stiffness * turn.gradient * turn.gradient.transpose();
    turn.gradient *= force;
    visit(structure_.hinges[hinge].lower, structure_.hinges[hinge].upper, turn);
  };
  if (drive_.hinge >= 0)
    visit_turn(drive_.hinge, driven_turn(state), multiplier_ + grip * drive_miss(state, theta), grip);
  for (const int h : drive_.springs) {
    const Element turn = turn_of(h, state).element();
    visit_turn(h, turn, k_spring_ * (turn.energy - spring_rest(h, theta)), k_spring_);
  }
}

CordElement ElasticSystem::held_cord(const State& state, double theta) const {
  CordElement cord = cord_element(structure_, drive_.through, state);
  const double force = multiplier_ + grip * drive_miss(state, theta);
  cord.hessian = grip * cord.gradient * cord.gradient.transpose() - force * cord.hessian;
  cord.gradient *= -force;
  return cord;
}

void ElasticSystem::add_to(Eigen::VectorXd& sum, const CordElement& cord) const {
  for (std::size_t k = 0; k < cord.bodies.size(); ++k)
    sum.segment<6>(6 * cord.bodies[k]) += cord.gradient.segment<6>(6 * static_cast<Eigen::Index>(k));
}

Eigen::VectorXd ElasticSystem::elastic_gradient(const State& state) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs_.coordinates());
  for (std::size_t k = 0; k < structure_.hinges.size(); ++k) {
    const RestHinge& h = structure_.hinges[k];
    add(sum, h.lower, h.upper,
        hinge_gradient(h, stiffness_.of(k), state[h.lower], state[h.upper], structure_.size.edge_mm));
  }
  visit_contacts(state, [&](int a, int b, const Element& e) { add(sum, a, b, e.gradient); });
  return sum;
}

Eigen::VectorXd ElasticSystem::gradient(const State& state, double theta) const {
  Eigen::VectorXd sum = elastic_gradient(state);
  visit_drive(state, theta, [&](int a, int b, const Element& e) { add(sum, a, b, e.gradient); });
  if (is_cord())
    sum -= (multiplier_ + grip * drive_miss(state, theta)) * cord_gradient(structure_, drive_.through, state);
  return sum;
}

Eigen::VectorXd ElasticSystem::linearise(const State& state, double theta, TangentStiffness& tangent) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs_.coordinates());
  tangent.clear();
  const auto take = [&](int a, int b, const Element& e) {
    add(sum, a, b, e.gradient);
    tangent.add(a, b, e);
  };
  for (std::size_t k = 0; k < structure_.hinges.size(); ++k) {
    const RestHinge& h = structure_.hinges[k];
    take(h.lower, h.upper,
         hinge_element(h, stiffness_.of(k), state[h.lower], state[h.upper], structure_.size.edge_mm));
  }
  visit_contacts(state, take);
  visit_drive(state, theta, take);
  if (!is_cord()) return sum;
  const CordElement cord = held_cord(state, theta);
  add_to(sum, cord);
  tangent.add(cord.bodies, cord.hessian);
  return sum;
}

bool ElasticSystem::update_multiplier(const State& state, double theta, double tolerance) {
  const double miss = drive_miss(state, theta);
  if (!(std::abs(miss) > tolerance)) return false;
  multiplier_ += grip * miss;
  return true;
}

double ElasticSystem::load(const State& state, double theta) const {
  if (holds_coordinate()) return -(multiplier_ + grip * drive_miss(state, theta));
  if (!drive_.is_external()) return spring_load(state, theta);
  const Eigen::VectorXd g = gradient(state, theta);
  const int coordinate = 3 + axis();
  double force = 0;
  for (const int body : drive_.gripped[1]) force -= g[6 * body + coordinate];
  return force;
}

double ElasticSystem::spring_load(const State& state, double theta) const {
  double sum = 0;
  for (const int h : drive_.springs)
    sum += k_spring_ * sense_of(h) * (turn_of(h, state).angle() - spring_rest(h, theta));
  return sum;
}

double ElasticSystem::driven_rate(double theta) const {
  return is_cord() ? cord_rest_ * std::sin(theta) : turn_at(1);
}

}  // namespace kinetix::model
