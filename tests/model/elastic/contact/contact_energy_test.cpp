#include "model/elastic/contact/contact_energy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <set>

#include "model/closure/closure.hpp"
#include "model/contact/wall_contact.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace testing;

// Contact stiffness over k_point: not 1, so that a missing factor shows.
constexpr double stiffness = 7;

struct Touching {
  Structure structure;
  Linkage linkage;  ///< of the structure, converted once since derivatives need it often
  State state;
  bool planar;
  std::vector<Contact> contacts;
};

/// Panels with thick walls, shaken until some of them press into each other.
std::vector<Touching> touching_panels() {
  std::mt19937 random(1);
  std::vector<Touching> panels;
  for (int trial = 0; trial < 20; ++trial) {
    const bool planar = trial % 2 == 0;
    Structure s = random_panel(2, 2, random, planar);
    s.size.thickness_mm = 4;
    const State state = shaken(s, rest_state(s), 0.35, random, planar);
    std::vector<Contact> contacts = ContactModel(s, planar).find(state);
    const Linkage linkage = s;
    panels.push_back({std::move(s), linkage, state, planar, std::move(contacts)});
  }
  return panels;
}

/// Calls check(panel, contact) for every contact of all panels: there are many, and through every kind of
/// face.
template <class Check>
void for_each_contact(const Check& check) {
  int count = 0;
  std::vector<int> through(5);
  for (const Touching& panel : touching_panels())
    for (const Contact& c : panel.contacts) {
      check(panel, c);
      ++count;
      ++through[static_cast<int>(c.face)];
    }
  EXPECT_GE(count, 40);
  for (int face = 0; face < 5; ++face) EXPECT_GT(through[face], 0) << "face " << face;
}

State moved_pair(const Touching& panel, const ContactModel& walls, const Contact& c, const VectorXd& x) {
  VectorXd twists = VectorXd::Zero(6 * panel.state.size());
  twists.segment<6>(6 * walls.body(c.plate)) = x.head<6>();
  twists.segment<6>(6 * walls.body(c.other)) = x.tail<6>();
  return retract_straight(panel.linkage, panel.state, twists);
}

TEST(ContactEnergy, GradientAndHessianMatchCentralDifferences) {
  for_each_contact([](const Touching& panel, const Contact& c) {
    const ContactModel walls(panel.structure, panel.planar);
    const auto energy = [&](const VectorXd& x) {
      return VectorXd::Constant(1, walls.element(c, stiffness, moved_pair(panel, walls, c, x)).energy);
    };
    const auto gradient = [&](const VectorXd& x) -> VectorXd {
      return numeric_jacobian(energy, x).transpose();
    };
    const Element e = walls.element(c, stiffness, panel.state);
    const VectorXd zero = VectorXd::Zero(12);
    expect_jacobian(energy, zero, e.gradient.transpose());
    expect_jacobian(gradient, zero, e.hessian, 1e-6, 3e-3);
    EXPECT_NEAR(walls.energy({c}, stiffness), e.energy, 1e-14);
  });
}

/// Returns the structure with t, alpha and beta of a contact's two hinges changed by q.
Structure redesigned(Structure s, const Contact& c, const VectorXd& q) {
  for (const int k : {0, 1}) {
    HingeParameters& p = s.hinges[ContactModel::hinge(k == 0 ? c.plate : c.other)].parameters;
    p.t += q[3 * k];
    p.alpha += q[3 * k + 1];
    p.beta += q[3 * k + 2];
  }
  return s;
}

TEST(ContactEnergy, RatesByTheTwoHingesMatchCentralDifferences) {
  for_each_contact([](const Touching& panel, const Contact& c) {
    const ContactModel walls(panel.structure, panel.planar);
    const auto depth_and_gradient = [&](const VectorXd& q) -> VectorXd {
      const ContactModel changed(redesigned(panel.structure, c, q), panel.planar);
      const Element e = changed.element(c, stiffness, panel.state);
      const double depth = c.depth * std::sqrt(e.energy / walls.energy({c}, stiffness));
      return (VectorXd(13) << depth, e.gradient).finished();
    };
    Eigen::Matrix<double, 13, 6> derivatives;
    derivatives << walls.depth_gradient(c, panel.state).transpose(),
        walls.derivatives(c, stiffness, panel.state);
    const double step = std::min(1e-3, c.depth / 10);
    expect_jacobian(depth_and_gradient, VectorXd::Zero(6), derivatives, 1e-7, step);
  });
}

TEST(ContactEnergy, GrowsInProportionToTheStiffness) {
  for_each_contact([](const Touching& panel, const Contact& c) {
    const ContactModel walls(panel.structure, panel.planar);
    const Vector12 gradient = walls.element(c, stiffness, panel.state).gradient;
    EXPECT_LE((stiffness * walls.stiffness_rate(c, panel.state) - gradient).norm(), 1e-14 * gradient.norm());
  });
}

TEST(ContactEnergy, IsThatOfTheStructureWhereverItIs) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const Touching& panel : touching_panels()) {
    State turned = panel.state;
    for (Pose& pose : turned) pose = {R * pose.R, R * pose.p + Vector3d(3, -40, 17)};
    ContactModel walls(panel.structure, panel.planar);
    const std::vector<Contact> contacts = walls.find(turned);
    EXPECT_EQ(contacts, panel.contacts);
    const double energy = walls.energy(panel.contacts, stiffness);
    EXPECT_NEAR(walls.energy(contacts, stiffness), energy, 1e-12 * energy);
  }
}

TEST(ContactEnergy, IsZeroFlatAndUntilTheClosedFormCloses) {
  Structure s = make_structure(rectangle(3, 3), {10, 2, 6});
  const double closing = closing_theta(s.size);
  for (const bool planar : {true, false}) {
    ContactModel walls(s, planar);
    EXPECT_TRUE(walls.find(rest_state(s)).empty());
    for (const double side : {1.0, -1.0}) {
      EXPECT_TRUE(walls.find(fold(classify(s), s, side * (closing - 1e-6))).empty());
      EXPECT_FALSE(walls.find(fold(classify(s), s, side * (closing + 1e-6))).empty());
    }
  }
}

TEST(ContactEnergy, OnlyWallsThatOverlapTouch) {
  for_each_contact([](const Touching& panel, const Contact& c) {
    const auto overlapping = WallContact(panel.structure).overlapping(panel.state);
    const WallPair pair{std::min(c.plate, c.other), std::max(c.plate, c.other)};
    EXPECT_TRUE(std::find(overlapping.begin(), overlapping.end(), pair) != overlapping.end());
  });
}

TEST(ContactEnergy, AStateThatIsNotFiniteTouchesNothing) {
  const Touching panel = touching_panels().front();
  State broken = panel.state;
  broken[1].p.x() = NAN;
  EXPECT_TRUE(ContactModel(panel.structure, panel.planar).find(broken).empty());
}

TEST(ContactEnergy, RememberedCandidatesGiveWhatAFreshModelFinds) {
  std::mt19937 random(2);
  for (const bool planar : {true, false}) {
    Structure s = random_panel(5, 4, random, planar);
    s.size.thickness_mm = 4;
    ContactModel walls(s, planar);
    State state = shaken(s, rest_state(s), 0.2, random, planar);
    int found = 0;
    for (int step = 0; step < 200; ++step) {
      state = shaken(s, state, step % 20 == 0 ? 0.1 : 0.01, random, planar);
      const auto remembered = walls.find(state), fresh = ContactModel(s, planar).find(state);
      ASSERT_EQ(remembered, fresh);
      for (std::size_t k = 0; k < fresh.size(); ++k) EXPECT_EQ(remembered[k].depth, fresh[k].depth);
      found += static_cast<int>(fresh.size());
    }
    EXPECT_GE(found, 200);
  }
}

/// Returns a state of a strip in which all bodies except two are far apart. A wall tip of one hangs `high` above the
/// middle of the other's x-wall, `along` from that one's vertex, in cell edges.
State hanging(const Structure& s, double along, double high) {
  const double L = s.size.edge_mm;
  State state(s.bodies.size());
  for (std::size_t b = 0; b < state.size(); ++b)
    state[b].p = 10 * L * Vector3d(0, static_cast<double>(b + 1), 0);
  state[*s.body_at({0, 0})].p.setZero();
  state[*s.body_at({2, 1})].p = L * Vector3d(along, 0.5 + high, 0);
  return state;
}

TEST(ContactEnergy, APointThatJumpsAcrossAWallHasPassedThrough) {
  const Structure s = make_structure(rectangle(3, 1), {});
  for (const bool planar : {true, false}) {
    ContactModel walls(s, planar);
    for (const double high : {0.05, 0.12, 0.2, 0.4}) {
      SCOPED_TRACE(high);
      EXPECT_TRUE(walls.find(hanging(s, 0.3, high)).empty());
      EXPECT_TRUE(walls.passed_through(hanging(s, 0.3, high), hanging(s, 0.3, -high)));
      EXPECT_TRUE(walls.passed_through(hanging(s, 0.3, -high), hanging(s, 0.2, high)));
      EXPECT_FALSE(walls.passed_through(hanging(s, 0.3, high), hanging(s, 0.3, high / 2)));
      EXPECT_FALSE(walls.passed_through(hanging(s, 0.3, high), hanging(s, 0.7, -high)));
      EXPECT_FALSE(walls.passed_through(hanging(s, 0.7, high), hanging(s, 0.7, -high)));
    }
  }
}

/// Returns a state in which half walls of one body cross those of another in two places. Lower edges of the one are
/// `deep` inside upper edges of the other.
State crossing_edges(const Structure& s, double deep) {
  State state = hanging(s, 0, 0);
  state[*s.body_at({2, 1})].p << 0.25 * s.size.edge_mm, 0.25 * s.size.edge_mm,
      s.size.height_mm - deep * s.size.edge_mm;
  return state;
}

TEST(ContactEnergy, WallsAcrossEachOtherArePushedOutThroughTheirRims) {
  for (const double thickness_mm : {0.3, 0.8, 2.0}) {
    const Structure s = make_structure(rectangle(3, 1), {10, thickness_mm, 6});
    ContactModel walls(s, false);
    EXPECT_TRUE(walls.find(crossing_edges(s, -1e-6)).empty());
    for (const double deep : {1e-6, 1e-3, 0.2 * thickness_mm / 2 / s.size.edge_mm}) {
      SCOPED_TRACE(::testing::Message() << thickness_mm << " mm, deep " << deep);
      const std::vector<Contact> found = walls.find(crossing_edges(s, deep));
      std::set<std::pair<int, int>> pairs;
      for (const Contact& c : found) pairs.insert(std::minmax(c.plate, c.other));
      EXPECT_EQ(pairs.size(), 2u);
      double deepest = 0;
      for (const Contact& c : found) deepest = std::max(deepest, c.depth);
      EXPECT_NEAR(deepest, deep, 1e-12);
      // They are lifted, whatever their sides do.
      const int above = *s.body_at({2, 1});
      double lift = 0;
      for (const Contact& c : found) {
        const Vector12 g = walls.element(c, stiffness, crossing_edges(s, deep)).gradient;
        lift -= walls.body(c.plate) == above ? g[5] : 0;
        lift -= walls.body(c.other) == above ? g[11] : 0;
      }
      EXPECT_GT(lift, stiffness / 3 * deep);
    }
  }
}

TEST(ContactEnergy, WallsThatSinkIntoEachOtherHavePassedThrough) {
  const Structure s = make_structure(rectangle(3, 1), {});
  ContactModel walls(s, false);
  const State apart = crossing_edges(s, -0.01), touching = crossing_edges(s, 0.01),
              deep = crossing_edges(s, 0.06);
  EXPECT_TRUE(walls.passed_through(apart, deep));
  EXPECT_FALSE(walls.passed_through(apart, touching));
  EXPECT_TRUE(walls.newly_cross(apart, deep));
  EXPECT_FALSE(walls.newly_cross(apart, touching));
  EXPECT_FALSE(walls.newly_cross(deep, deep));
}

/// The body at the corner is shifted so that its wall along x lies across the wall that stands up beside it.
TEST(ContactModel, SeesWallsThatCameToLieAcrossEachOther) {
  const Structure s = make_structure(rectangle(2, 2), {10, 0.4, 6});
  const State apart = rest_state(s);
  State across = apart;
  across[*s.body_at({0, 0})].p += s.size.edge_mm * Vector3d(0.8, 0.25, 0);
  ContactModel walls(s, true);
  EXPECT_TRUE(walls.newly_cross(apart, across));
  EXPECT_FALSE(walls.newly_cross(across, across));
  EXPECT_FALSE(walls.newly_cross(across, apart));
  EXPECT_FALSE(walls.newly_cross(apart, apart));
}

/// Returns a state in which the half wall along x is turned by `angle` about the vertical through its vertex.
State turned_past(const Structure& s, double angle, double high = 0) {
  State state = hanging(s, 0.3, 0);
  Pose& pose = state[*s.body_at({2, 1})];
  pose.p = s.size.edge_mm * Vector3d(0.3, -0.3, high);
  pose.R = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  return state;
}

/// The tips of thin walls go round each other's ends in both states, and not between them.
TEST(ContactModel, SeesThinWallsThatPassEachOtherBetweenTwoStates) {
  for (const double thickness_mm : {0.001, 0.01, 0.1})
    for (const bool planar : {true, false}) {
      SCOPED_TRACE(::testing::Message() << thickness_mm << " mm, planar " << planar);
      const Structure s = make_structure(rectangle(3, 1), {10, thickness_mm, 6});
      ContactModel walls(s, planar);
      int swept = 0;
      for (double angle = 0; angle < 2 * pi; angle += 0.05)
        swept += walls.sweep_through(turned_past(s, angle), turned_past(s, angle + 0.05));
      // Two half walls of one body, at right angles, sweep over those of the other.
      EXPECT_GE(swept, 2);
      EXPECT_LE(swept, 8);
      EXPECT_FALSE(walls.sweep_through(turned_past(s, 0), turned_past(s, 0)));
      if (planar) continue;
      for (double angle = 0; angle < 2 * pi; angle += 0.05)
        EXPECT_FALSE(walls.sweep_through(turned_past(s, angle, 0.61), turned_past(s, angle + 0.05, 0.61)))
            << "over it, " << angle;
    }
}

/// Contact acts between the boxes of half walls, cut along their hinges. Parts outside these boxes never touch.
TEST(ContactEnergy, IsOfWallsCutAlongTheirHinges) {
  std::mt19937 random(11);
  int touching = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Structure s = random_panel(2, 2, random);
    for (Hinge& hinge : s.hinges) hinge.parameters.alpha = pi / 2 + (trial % 2 == 0 ? 0.5 : -0.5);
    s.size.thickness_mm = 1;
    ContactModel walls(s, false);
    if (walls.overlap_at_rest()) continue;
    const State state = shaken(s, rest_state(s), 0.3, random, false);
    const std::vector<HalfWall> boxes = half_walls(s);
    for (const Contact& c : walls.find(state)) {
      ++touching;
      EXPECT_TRUE(overlap(placed(boxes[c.plate], state[boxes[c.plate].body]),
                          placed(boxes[c.other], state[boxes[c.other].body])))
          << trial;
    }
  }
  EXPECT_GE(touching, 40);
}

}  // namespace
}  // namespace kinetix::model
