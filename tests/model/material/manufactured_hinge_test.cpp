#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::model {
namespace {

using testing::refusal;

ManufacturedHinge block(double L, double t, double h, double nu, double E = 1) {
  return {.kind = HingeKind::block,
          .material = {.E_mpa = E, .nu = nu},
          .gap_mm = L,
          .thickness_mm = t,
          .height_mm = h};
}

const CellSize cell{20, 2, 8};  // mm: larger than the hinges below

/// Timoshenko's beam between ends that stay parallel, with 5/6 of a rectangle in shear (0.86 here).
TEST(ManufacturedHinge, OfAMaterialThatDoesNotContractIsATimoshenkoBeam) {
  for (const double L : {1.0, 2.0, 4.0})
    for (const double h : {5.0, 10.0}) {
      const double E = 3, t = 1, G = E / 2, I = h / 12, I_high = h * h * h / 12;
      const HingeStiffness k = stiffness(block(L, t, h, 0, E));
      EXPECT_NEAR(k.axial, E * h / L, 1e-12);
      EXPECT_NEAR(k.turn, E * I / L, 1e-12);
      const double shear = 1 / (L / (G * h * 5 / 6) + L * L * L / (12 * E * I)),
                   along = 1 / (L / (G * h * 5 / 6) + L * L * L / (12 * E * I_high));
      EXPECT_NEAR(k.shear, shear, 0.03 * shear);
      EXPECT_NEAR(k.along, along, (L / h > 0.3 ? 0.08 : 0.2) * along);  // short ones shear evenly
    }
}

/// Ends and edges have no effect on a long and much higher strip: it is a plate in cylindrical bending.
TEST(ManufacturedHinge, OfALongHighFilmIsAPlateInCylindricalBending) {
  const double E = 1300, nu = 0.42, L = 3, t = 0.03, h = 3000;
  const HingeStiffness k = stiffness(block(L, t, h, nu, E));
  const double plate = E / (1 - nu * nu);
  EXPECT_NEAR(k.axial, plate * t * h / L, 3e-3 * k.axial);
  EXPECT_NEAR(k.turn, plate * h * t * t * t / 12 / L, 3e-3 * k.turn);
  EXPECT_NEAR(k.shear, plate * h * t * t * t / (L * L * L), 3e-3 * k.shear);
}

TEST(ManufacturedHinge, StiffnessGrowsAsTheModulusAndWithTheSize) {
  const HingeStiffness one = stiffness(block(1, 0.8, 6, 0.45)), stiff = stiffness(block(1, 0.8, 6, 0.45, 26)),
                       large = stiffness(block(2, 1.6, 12, 0.45));
  EXPECT_NEAR(stiff.axial, 26 * one.axial, 1e-12 * stiff.axial);
  EXPECT_NEAR(stiff.turn, 26 * one.turn, 1e-12 * stiff.turn);
  EXPECT_NEAR(large.axial, 2 * one.axial, 1e-12);
  EXPECT_NEAR(large.shear, 2 * one.shear, 1e-12);
  EXPECT_NEAR(large.along, 2 * one.along, 1e-12);
  EXPECT_NEAR(large.turn, 8 * one.turn, 1e-12);
}

/// A rod of length h is clamped by a knuckle at each end: its deflection is F h^3 / (192 E I) + F h / (4 k G A).
TEST(ManufacturedHinge, APinIsARodThatIsHeldAtBothEnds) {
  const ManufacturedHinge pin{.kind = HingeKind::pin,
                              .material = *find_material("pa12"),
                              .height_mm = 6,
                              .diameter_mm = 3,
                              .clearance_mm = 0.3};
  const double E = 1700, I = pi * 81 / 64, A = pi * 9 / 4, G = 1700 / 2.8;
  const double deflection = 216 / (192 * E * I) + 6 / (4 * 0.9 * G * A);
  const HingeStiffness k = stiffness(pin);
  EXPECT_NEAR(k.axial * deflection, 1, 1e-12);
  EXPECT_EQ(k.axial, k.shear);
  EXPECT_GT(k.axial, 1e3);  // N/mm: from 1e3 to 1e4 is what printed pins have
  EXPECT_LT(k.axial, 1e4);
  EXPECT_DOUBLE_EQ(play_mm(pin), 0.3);
  EXPECT_DOUBLE_EQ(clearance_tilt(pin), std::atan(0.1));
  EXPECT_EQ(strain(pin, 1), 0);
  EXPECT_EQ(contact_turn(pin, 0.8, 0), pi);
}

/// A wire of the usual diameter is stiffer than the thinnest rod that FDM prints, at all heights of walls.
TEST(ManufacturedHinge, ARodOfWireIsStiffAsAPinOfSteel) {
  for (const double h : {3.0, 6.0, 20.0}) {
    const ManufacturedHinge wire{.kind = HingeKind::rod,
                                 .material = *find_material("steel"),
                                 .height_mm = h,
                                 .diameter_mm = usual_rod_mm,
                                 .clearance_mm = 0.3};
    const double E = 200000, I = pi / 64, A = pi / 4, G = E / 2.6;
    const double deflection = h * h * h / (192 * E * I) + h / (4 * 0.9 * G * A);
    EXPECT_NEAR(stiffness(wire).axial * deflection, 1, 1e-12);
    ManufacturedHinge printed = wire;
    printed.kind = HingeKind::pin;
    EXPECT_EQ(stiffness(printed).shear, stiffness(wire).shear);
    printed.material = *find_material("pa12");
    printed.diameter_mm = 3;
    EXPECT_GT(stiffness(wire).axial, stiffness(printed).axial) << h;
    EXPECT_EQ(play_mm(wire), 0.3);
    EXPECT_EQ(strain(wire, 1), 0);
    EXPECT_EQ(largest_turn(wire), pi);
    EXPECT_EQ(to_string(wire.kind), "rod");
  }
}

TEST(ManufacturedHinge, StrainsAndTouchesByItsProportions) {
  const ManufacturedHinge b = block(1.5, 1, 6, 0.45);
  EXPECT_DOUBLE_EQ(strain(b, 0.6), 0.2);
  EXPECT_DOUBLE_EQ(strain(b, -0.6), 0.2);
  EXPECT_NEAR(strain(b, largest_turn(b)), b.material.strain_max, 1e-15);
  EXPECT_NEAR(std::tan(contact_turn(b, 1, 0) / 2), 1.5, 1e-14);
  EXPECT_NEAR(std::tan(contact_turn(b, 2, 0.5) / 2), 0.5, 1e-14);
  EXPECT_DOUBLE_EQ(largest_turn(block(30, 1, 6, 0.45)), pi);
}

TEST(ManufacturedHinge, SitsWithinTheFacesOfItsWall) {
  const auto walls = [](double thickness_mm) { return CellSize{10, thickness_mm, 6}; };
  EXPECT_DOUBLE_EQ(largest_offset_mm(block(1, 0.4, 6, 0.4), walls(2)), 0.8);
  EXPECT_EQ(largest_offset_mm(block(1, 2, 6, 0.4), walls(2)), 0);
  const ManufacturedHinge pin{.kind = HingeKind::pin, .height_mm = 6, .diameter_mm = 1, .clearance_mm = 0.2};
  EXPECT_DOUBLE_EQ(largest_offset_mm(pin, walls(5)), (10 / std::sqrt(2.0) - 3) / 2);
  EXPECT_DOUBLE_EQ(largest_offset_mm(pin, walls(1)), (10 / std::sqrt(2.0) - 3) / 2);
}

TEST(ManufacturedHinge, HoldsATiltedWallAsItsWholeHeightDoes) {
  const ManufacturedHinge b = block(1, 0.8, 6, 0.45);
  const Elasticity e = elasticity_of(b);
  const HingeStiffness k = stiffness(b), back = stiffness_of(e);
  EXPECT_NEAR(e.reach_mm * e.reach_mm, 36.0 / 12, 1e-14);
  EXPECT_NEAR(back.axial, k.axial, 1e-14 * k.axial);
  EXPECT_NEAR(back.shear, k.shear, 1e-14 * k.shear);
  EXPECT_NEAR(back.along, k.along, 1e-14 * k.along);
  EXPECT_EQ(back.turn, k.turn);
  EXPECT_EQ(back.rock, k.rock);
  EXPECT_EQ(back.twist, k.twist);
}

TEST(ManufacturedHinge, TiltsAsABeamWhereItIsLongAndItsMaterialDoesNotContract) {
  const double L = 4, t = 0.4, h = 6, E = 2, G = E / 2;  // nu = 0: no correction of ends or edges
  const HingeStiffness k = stiffness(block(L, t, h, 0, E));
  EXPECT_NEAR(k.rock.value(), E * t * h * h * h / 12 / L, 1e-12);
  const double torsion = G * h * t * t * t / 3 * (1 - 0.63 * t / h) / L;
  EXPECT_NEAR((k.twist.value() - k.shear * h * h / 12) / torsion, 1.2, 0.03);
}

TEST(ManufacturedHinge, OfAPinWithPlayBearsWhereItsRodLeavesTheBore) {
  ManufacturedHinge pin{.kind = HingeKind::pin,
                        .material = {.E_mpa = 1700, .nu = 0.4, .strain_max = 0.1},
                        .height_mm = 6,
                        .diameter_mm = 1,
                        .clearance_mm = 0.2};
  EXPECT_EQ(elasticity_of(pin).play_mm, 0);
  pin.with_play = true;
  const Elasticity e = elasticity_of(pin);
  e.validate();
  EXPECT_EQ(e.play_mm, 0.2);
  EXPECT_NEAR(std::atan(e.play_mm / e.reach_mm), clearance_tilt(pin), 1e-15);
}

TEST(ManufacturedHinge, PlayIsOfHingesThatAreRound) {
  const auto refuses = [](Elasticity e) {
    e.play_mm = e.play_mm == 0 ? 0.2 : e.play_mm;
    EXPECT_THROW(e.validate(), InvalidInput);
  };
  refuses({.ratios = {1, 0.5, 1}});
  refuses({.tilt = {.rock = 3}});
  for (const double bad : {-0.1, 2.0, double(NAN), double(INFINITY)}) refuses({.play_mm = bad});
  for (const double bad : {-1.0, 0.0, double(NAN), double(INFINITY)}) {
    EXPECT_THROW((Elasticity{.tilt = {.rock = bad}}.validate()), InvalidInput);
    EXPECT_THROW((Elasticity{.tilt = {.twist = bad}}.validate()), InvalidInput);
  }
}

TEST(ManufacturedHinge, NamesAFieldThatCannotBeMade) {
  const auto refused = [](auto change) {
    ManufacturedHinge hinge = block(3, 1, 6, 0.45);
    change(hinge);
    return refusal([&] { validate(hinge, cell); });
  };
  EXPECT_EQ(refused([](ManufacturedHinge&) {}), "");
  using ::testing::HasSubstr;
  for (const double bad : {std::nan(""), 0.0, -1.0}) {
    EXPECT_THAT(refused([&](ManufacturedHinge& h) { h.gap_mm = bad; }), HasSubstr("gap_mm"));
    EXPECT_THAT(refused([&](ManufacturedHinge& h) { h.thickness_mm = bad; }), HasSubstr("thickness_mm"));
    EXPECT_THAT(refused([&](ManufacturedHinge& h) { h.height_mm = bad; }), HasSubstr("height_mm"));
    EXPECT_THAT(refused([&](ManufacturedHinge& h) { h.material.E_mpa = bad; }), HasSubstr("E_mpa"));
    EXPECT_THAT(refused([&](ManufacturedHinge& h) { h.material.strain_max = bad; }), HasSubstr("strain_max"));
  }
  for (const double bad : {std::nan(""), 0.5, -0.1})
    EXPECT_THAT(refused([&](ManufacturedHinge& h) { h.material.nu = bad; }), HasSubstr("nu is"));
  EXPECT_THAT(refused([](ManufacturedHinge& h) { h.gap_mm = 20; }), HasSubstr("below the cell edge, 20 mm"));
  EXPECT_THAT(refused([](ManufacturedHinge& h) { h.gap_mm = 0.4; }),
              HasSubstr("half of the hinge's thickness"));
  EXPECT_THAT(refused([](ManufacturedHinge& h) { h.thickness_mm = 2.1; }),
              HasSubstr("the thickness of the wall"));
  EXPECT_THAT(refused([](ManufacturedHinge& h) { h.height_mm = 8.1; }), HasSubstr("the height of the wall"));
  const auto pin = [](ManufacturedHinge& h) {
    h.kind = HingeKind::pin;
    h.clearance_mm = 0.3;
  };
  EXPECT_THAT(refused([&](ManufacturedHinge& h) {
                pin(h);
                h.diameter_mm = 12;
              }),
              HasSubstr("at most 11.9421 mm"));
  ManufacturedHinge rod = block(3, 1, 2, 0.45);
  pin(rod);
  rod.diameter_mm = 1;
  EXPECT_THAT(refusal([&] {
                validate(rod, CellSize{3, 1, 2});
              }),
              HasSubstr("a pin does not fit cells of 3 mm"))
      << "not a diameter below 0";
  EXPECT_THAT(refused([&](ManufacturedHinge& h) {
                pin(h);
                h.diameter_mm = std::nan("");
              }),
              HasSubstr("diameter_mm"));
}

TEST(Materials, AreFoundByTheirNames) {
  for (const Material& material : materials()) {
    EXPECT_EQ(find_material(material.name), &material);
    EXPECT_FALSE(material.source.empty());
    EXPECT_EQ(refusal([&] {
                ManufacturedHinge hinge = block(3, 1, 6, 0.45);
                hinge.material = material;
                validate(hinge, cell);
              }),
              "");
  }
  EXPECT_EQ(find_material("oak"), nullptr);
}

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr ManufacturedHinge make_one_mm_block() {
  return {.kind = HingeKind::block, .gap_mm = 1, .thickness_mm = 0.8, .height_mm = 6};
}

/// Returns the flat state with the upper body of hinge 0 turned by `angle` about `direction` through the hinge point.
State turned(const Linkage& linkage, double angle, const Vector3d& direction) {
  State state = rest_state(linkage);
  const RestHinge& h = linkage.hinges[0];
  Pose& upper = state[h.upper];
  const Vector3d point = state[h.lower].p + linkage.size.edge_mm * (state[h.lower].R * h.lower_arm);
  upper.R = AngleAxisd(angle, direction) * upper.R;
  upper.p = point - linkage.size.edge_mm * (upper.R * h.upper_arm);
  return state;
}

/// Rocking by 0.1 rad across its axis pulls a block 6 mm high apart at its edge. It opens there by 3 mm times that
/// angle, over a gap of 1 mm. Turning about its axis strains its outermost fibre by angle times thickness over twice
/// the gap.
TEST(HingeStrain, CountsWhatRockingPullsApart) {
  const Linkage linkage = make_structure(rectangle(1, 1), {20, 1, 6});
  const ManufacturedHinge block = make_one_mm_block();
  const Vector3d axis = linkage.hinges[0].axis,
                 along = (linkage.hinges[0].lower_arm - linkage.hinges[0].upper_arm).normalized();
  EXPECT_NEAR(hinge_strain(block, linkage, turned(linkage, 0.1, axis.cross(along)), 0),
              2 * std::sin(0.05) * 3, 1e-9);
  EXPECT_NEAR(hinge_strain(block, linkage, turned(linkage, 0.1, axis), 0), 0.1 * 0.8 / 2, 1e-9);
  EXPECT_EQ(hinge_strain(block, linkage, rest_state(linkage), 0), 0);
}

}  // namespace
}  // namespace kinetix::model
