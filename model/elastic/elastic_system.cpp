#include "model/elastic/elastic_system.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/elastic/screw.hpp"
#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

const Structure& validated(const Structure& structure) {
  validate_hinges(structure);
  return structure;
}

/// Bodies that turn about upright axes only keep them parallel: there is no mismatch to reach for.
Stiffness acting(const Elasticity& elasticity, const Structure& structure, bool planar) {
  Stiffness stiffness = relative(elasticity, structure.size.edge_mm);
  if (planar && all_vertical(structure)) stiffness.reach = 0;
  return stiffness;
}

void refuse_overlap(const Structure& structure, const ContactModel& walls) {
  const auto& pair = walls.overlap_at_rest();
  if (!pair) return;
  const auto wall = [&](int plate) { return to_string(structure.hinges[ContactModel::hinge(plate)].wall); };
  throw InvalidInput("walls " + wall(pair->first) + " and " + wall(pair->second) +
                     " overlap in the flat state; make walls thinner, lower or less tilted, or put hinges "
                     "further from the ends of their walls");
}

}  // namespace

ElasticSystem::ElasticSystem(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
                             bool planar, bool contact)
    : structure_(validated(structure)),
      stiffness_(acting(elasticity, structure, planar)),
      drive_(drive),
      contact_(contact),
      freedoms_(make_freedoms(structure, drive, planar)),
      walls_(structure, planar) {
  if (contact) refuse_overlap(structure, walls_);
  hinges_.reserve(structure.hinges.size());
  for (const Hinge& hinge : structure.hinges) hinges_.push_back(rest_hinge(hinge));
  if (drive.kind == Drive::Kind::plates)
    gripped_ = gripped_bodies(structure, drive.axis, drive.grip);
  else
    driven_ = *structure.hinge_at(drive.wall);
}

ElasticSystem::ElasticSystem(const Structure& structure, const Elasticity& elasticity, bool planar,
                             bool contact)
    : structure_(structure),
      stiffness_(acting(elasticity, structure, planar)),
      contact_(contact),
      freedoms_(make_freedoms(structure, planar)),
      walls_(structure, planar) {
  for (const Hinge& hinge : structure.hinges) hinges_.push_back(rest_hinge(hinge));
}

std::vector<Contact> ElasticSystem::contacts(const State& state) const {
  return contact_ ? walls_.find(state) : std::vector<Contact>{};
}

bool ElasticSystem::passed_through(const State& before, const State& after) const {
  return contact_ && walls_.passed_through(before, after);
}

void ElasticSystem::place(double theta, State& state) const {
  if (gripped_[0].empty()) return;
  const int axis = drive_.axis == Axis::x ? 0 : 1;
  const double L = structure_.size.edge_mm;
  const int low = row(0), high = row(1);
  for (const int side : {0, 1}) {
    const double half = (side == 0 ? -0.5 : 0.5) * (high - low) * std::cos(theta);
    for (const int body : gripped_[side]) state[body].p[axis] = L * ((low + high) / 2.0 + half);
  }
}

State ElasticSystem::stepped(const State& state, const Eigen::VectorXd& twists) const {
  State out = screwed(structure_, state, twists);
  for (std::size_t b = 0; b < state.size(); ++b)
    for (int k = 0; k < 3; ++k)
      if (freedoms_.unknown[b][3 + k] < 0)
        out[b].p[k] = state[b].p[k] + structure_.size.edge_mm * twists[6 * b + 3 + k];
  return out;
}

double ElasticSystem::length(const State& state, const Eigen::VectorXd& twists) const {
  const auto turn = [&](int body) -> Eigen::Vector3d { return twists.segment<3>(6 * body); };
  double longest = 0;
  for (const RestHinge& h : hinges_) {
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
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(freedoms_.coordinates());
  if (gripped_[0].empty()) return rate;
  const int coordinate = drive_.axis == Axis::x ? 3 : 4;
  const int apart = row(1) - row(0);
  for (const int side : {0, 1})
    for (const int body : gripped_[side])
      rate[6 * body + coordinate] = (side == 0 ? 0.5 : -0.5) * apart * std::sin(theta);
  return rate;
}

double ElasticSystem::drive_miss(const State& state, double theta) const {
  if (driven_ < 0) return 0;
  return std::remainder(driven_turn(state).energy - turn_at(theta), 2 * pi);
}

Element ElasticSystem::driven_turn(const State& state) const {
  const RestHinge& hinge = hinges_[driven_];
  return RelativeTurn(hinge, state[hinge.lower], state[hinge.upper]).element();
}

double ElasticSystem::elastic_energy(const State& state) const {
  double sum = 0;
  for (const RestHinge& h : hinges_)
    sum += hinge_energy(h, stiffness_, state[h.lower], state[h.upper], structure_.size.edge_mm).total();
  return sum + walls_.energy(contacts(state), stiffness_.contact);
}

double ElasticSystem::energy(const State& state, double theta) const {
  const double miss = drive_miss(state, theta);
  return elastic_energy(state) + multiplier_ * miss + 0.5 * grip * miss * miss;
}

template <class Visit>
void ElasticSystem::visit_loads(const State& state, double theta, const Visit& visit) const {
  for (const Contact& c : contacts(state))
    visit(walls_.body(c.plate), walls_.body(c.other), walls_.element(c, stiffness_.contact, state));
  if (driven_ < 0) return;
  Element turn = driven_turn(state);
  const double miss = drive_miss(state, theta), force = multiplier_ + grip * miss;
  turn.hessian = force * turn.hessian + grip * turn.gradient * turn.gradient.transpose();
  turn.gradient *= force;
  visit(hinges_[driven_].lower, hinges_[driven_].upper, turn);
}

Eigen::VectorXd ElasticSystem::gradient(const State& state, double theta) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(freedoms_.coordinates());
  const auto add = [&](int a, int b, const Vector12& g) {
    sum.segment<6>(6 * a) += g.head<6>();
    sum.segment<6>(6 * b) += g.tail<6>();
  };
  for (const RestHinge& h : hinges_)
    add(h.lower, h.upper,
        hinge_gradient(h, stiffness_, state[h.lower], state[h.upper], structure_.size.edge_mm));
  visit_loads(state, theta, [&](int a, int b, const Element& e) { add(a, b, e.gradient); });
  return sum;
}

Eigen::VectorXd ElasticSystem::linearise(const State& state, double theta, Tangent& tangent) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(freedoms_.coordinates());
  tangent.clear();
  const auto add = [&](int a, int b, const Element& e) {
    sum.segment<6>(6 * a) += e.gradient.head<6>();
    sum.segment<6>(6 * b) += e.gradient.tail<6>();
    tangent.add(a, b, e);
  };
  for (const RestHinge& h : hinges_)
    add(h.lower, h.upper,
        hinge_element(h, stiffness_, state[h.lower], state[h.upper], structure_.size.edge_mm));
  visit_loads(state, theta, add);
  return sum;
}

bool ElasticSystem::update_multiplier(const State& state, double theta, double tolerance) {
  const double miss = drive_miss(state, theta);
  if (!(std::abs(miss) > tolerance)) return false;
  multiplier_ += grip * miss;
  return true;
}

double ElasticSystem::load(const State& state, double theta) const {
  if (driven_ >= 0) return -(multiplier_ + grip * drive_miss(state, theta));
  const Eigen::VectorXd g = gradient(state, theta);
  const int coordinate = drive_.axis == Axis::x ? 3 : 4;
  double force = 0;
  for (const int body : gripped_[1]) force -= g[6 * body + coordinate];
  return force;
}

double ElasticSystem::drive_coordinate(double theta) const {
  return driven_ >= 0 ? turn_at(theta) : 1 - std::cos(theta);
}

double ElasticSystem::travel() const {
  return driven_ >= 0 ? 1 : structure_.size.edge_mm * (row(1) - row(0));
}

double ElasticSystem::drive_rate(double theta) const {
  return driven_ >= 0 ? turn_at(1) : std::sin(theta);
}

}  // namespace kinetix
