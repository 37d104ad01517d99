#include "sim/actuator.hpp"

#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "model/base/algorithms.hpp"
#include "model/closure/closure.hpp"
#include "sim/joints/elastic_hinges.hpp"
#include "sim/joints/external_pulls.hpp"
#include "sim/joints/joints.hpp"

namespace kinetix::sim {
namespace {

using Bodies = std::vector<std::unique_ptr<btRigidBody>>;

class Plates final : public Actuator {
 public:
  Plates(const model::Linkage& structure, const model::LinkageDrive& drive, const Bodies& bodies,
         double error_reduction)
      : axis_(drive.axis), press_(drive.press) {
    for (int side = 0; side < 2; ++side) {
      const std::vector<int>& row = drive.gripped[side];
      rows_[side] = structure.bodies[row.front()].position[coordinate()];
      for (const int b : row) {
        // A rotor of a block in space may have to spin or slide; its other rigid motions are free of forces.
        const bool is_key = b == row[row.size() / 2] && !structure.bodies[b].spin;
        const Pin pin = is_key ? Pin::keyed : Pin::sliding;
        add(side, pin, *bodies[b], error_reduction);
        if (side == 0 && pin == Pin::keyed) keep_from_spinning(*bodies[b]);
      }
    }
  }

  std::vector<btGeneric6DofSpring2Constraint*> joints() const override {
    std::vector<btGeneric6DofSpring2Constraint*> joints;
    for (const Joint& joint : joints_) joints.push_back(joint.get());
    for (const Joint& key : keys_) joints.push_back(key.get());
    return joints;
  }

  void move_to(double theta) override {
    const double middle = 0.5 * (rows_[0] + rows_[1]);
    for (int side = 0; side < 2; ++side) {
      btVector3 place(0, 0, 0);
      place[coordinate()] = middle + (rows_[side] - middle) * std::cos(theta);
      plates_[side].setWorldTransform(btTransform(btMatrix3x3::getIdentity(), place));
    }
  }

  double gap() const override {
    double largest = 0;
    for (const Joint& joint : joints_) {
      const btVector3 plate = joint->getRigidBodyA().getWorldTransform().getOrigin();
      const btVector3 body = joint->getRigidBodyB().getWorldTransform().getOrigin();
      const double off = body[coordinate()] - plate[coordinate()];
      largest = larger(largest, press_ ? -inward(side_of(*joint)) * off : std::abs(off));
    }
    return largest;
  }

 private:
  int coordinate() const { return axis_ == model::Axis::x ? 0 : 1; }

  /// Returns the inward sign along the axis.
  static double inward(int side) { return side == 0 ? 1 : -1; }
  int side_of(btGeneric6DofSpring2Constraint& joint) const {
    return &joint.getRigidBodyA() == &plates_[0] ? 0 : 1;
  }

  void add(int side, Pin pin, btRigidBody& body, double error_reduction) {
    btRigidBody& plate = plates_[side];
    if (!press_) return joints_.push_back(slot(axis_, pin, plate, body, error_reduction));
    joints_.push_back(pusher(inward(side) * edge_direction(axis_), plate, body, error_reduction));
    if (pin == Pin::keyed) keys_.push_back(height_lock(plate, body, error_reduction));
  }

  void keep_from_spinning(btRigidBody& body) const {
    btVector3 free = body.getAngularFactor();
    free[coordinate()] = 0;
    body.setAngularFactor(free);
  }

  model::Axis axis_;
  bool press_;
  std::array<double, 2> rows_{};  ///< cell edges
  std::array<btRigidBody, 2> plates_{btRigidBody(0, nullptr, nullptr), btRigidBody(0, nullptr, nullptr)};
  std::vector<Joint> joints_;  ///< joint of each body with its plate
  std::vector<Joint> keys_;    ///< joints to the plane z = 0, for plates that press
};

class DrivenHinge final : public Actuator {
 public:
  DrivenHinge(const model::RestHinge& hinge, int sense, const Bodies& bodies, double error_reduction)
      : sense_(sense),
        joint_(turn_lock(hinge, *bodies[hinge.lower], *bodies[hinge.upper], error_reduction)) {}

  std::vector<btGeneric6DofSpring2Constraint*> joints() const override { return {joint_.get()}; }

  void move_to(double theta) override {
    angle_ = model::turn_at_theta(sense_, theta);
    set_turn(*joint_, angle_);
  }

  double gap() const override { return std::abs(std::remainder(turn(*joint_) - angle_, 2 * pi)); }

 private:
  int sense_;
  Joint joint_;
  double angle_ = 0;
};

/// Over the stiffness of a hinge point: many times stiffer, but rounding must not drown the hinges' forces.
constexpr double held_stiffness = 1e4;

class DrivenSpring final : public Actuator {
 public:
  DrivenSpring(const model::Linkage& structure, int hinge, const Bodies& bodies, ElasticHinges& elastic)
      : structure_(structure), hinge_(hinge), bodies_(bodies), elastic_(elastic) {
    move_to(0);
  }

  std::vector<btGeneric6DofSpring2Constraint*> joints() const override { return {}; }

  void move_to(double theta) override {
    angle_ = model::turn_at_theta(structure_.bodies[structure_.hinges[hinge_].lower].sense, theta);
    elastic_.drive_to(hinge_, angle_, held_stiffness);
  }

  double gap() const override {
    model::State turns(bodies_.size());
    for (const int b : {structure_.hinges[hinge_].lower, structure_.hinges[hinge_].upper})
      turns[b].R = eigen(bodies_[b]->getWorldTransform().getBasis());
    return std::abs(drive_residual(model::HingeTurn{hinge_, angle_}, structure_, turns));
  }

 private:
  const model::Linkage& structure_;
  int hinge_;
  const Bodies& bodies_;
  ElasticHinges& elastic_;
  double angle_ = 0;
};

/// Springs of shape memory. They have no target position, so there is no gap.
class HeatedSprings final : public Actuator {
 public:
  HeatedSprings(const model::Linkage& structure, const model::LinkageDrive& drive, double weight,
                ElasticHinges& elastic)
      : structure_(structure), hinges_(drive.springs), weight_(weight), elastic_(elastic) {
    move_to(0);
  }

  std::vector<btGeneric6DofSpring2Constraint*> joints() const override { return {}; }

  void move_to(double theta) override {
    std::vector<double> angles;
    for (const int h : hinges_)
      angles.push_back(model::turn_at_theta(structure_.bodies[structure_.hinges[h].lower].sense, theta));
    elastic_.add_springs(hinges_, angles, weight_);
  }

  double gap() const override { return 0; }

 private:
  const model::Linkage& structure_;
  const std::vector<int> hinges_;
  const double weight_;
  ElasticHinges& elastic_;
};

class PulledCord final : public Actuator {
 public:
  PulledCord(const model::Linkage& structure, double rest_mm, const Bodies& bodies, Cord& cord)
      : edge_mm_(structure.size.edge_mm),
        rest_(rest_mm / structure.size.edge_mm),
        bodies_(bodies),
        cord_(cord) {}

  std::vector<btGeneric6DofSpring2Constraint*> joints() const override { return {}; }
  void move_to(double theta) override { cord_.shorten_to(rest_ * std::cos(theta)); }

  /// Returns the excess length; a slack tendon has no gap.
  double gap() const override {
    model::State state(bodies_.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      state[b] = pose_of(bodies_[b]->getWorldTransform(), edge_mm_);
    return larger(0, cord_.excess(state));
  }

 private:
  const double edge_mm_, rest_;  ///< rest length of the tendon: cell edges
  const Bodies& bodies_;
  Cord& cord_;
};

}  // namespace

std::unique_ptr<Actuator> make_actuator(const model::Linkage& structure, const model::LinkageDrive& drive,
                                        const Bodies& bodies, double error_reduction, ElasticHinges* elastic,
                                        double spring_weight, Cord* cord) {
  if (drive.has_plates()) return std::make_unique<Plates>(structure, drive, bodies, error_reduction);
  if (cord) return std::make_unique<PulledCord>(structure, drive.rest_mm, bodies, *cord);
  if (!drive.is_external()) return std::make_unique<HeatedSprings>(structure, drive, spring_weight, *elastic);
  if (elastic) return std::make_unique<DrivenSpring>(structure, drive.hinge, bodies, *elastic);
  return std::make_unique<DrivenHinge>(structure.hinges[drive.hinge], drive.sense, bodies, error_reduction);
}

}  // namespace kinetix::sim
