#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/lattice/lattice.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/linkage.hpp"
#include "model/solids/body_solid.hpp"
#include "model/solids/hinge_shape.hpp"

namespace kinetix::model {
namespace {

const CellSize size{10, 0.8, 6};  // mm, those of the shipped cube

HingePrint block() {
  ManufacturedHinge hinge;
  hinge.kind = HingeKind::block;
  hinge.gap_mm = 1;
  hinge.thickness_mm = size.thickness_mm;
  hinge.height_mm = size.height_mm;
  return {.made = hinge};
}

HingePrint pin() {
  ManufacturedHinge hinge;
  hinge.kind = HingeKind::pin;
  hinge.diameter_mm = 1;
  hinge.clearance_mm = 0.1;
  hinge.height_mm = size.height_mm;
  return {.made = hinge, .axial_clearance_mm = 0.2};
}

std::vector<BodySolid> solids(const Linkage& linkage, const HingePrint& print) {
  return body_solids(linkage, [&](int) -> const HingePrint& { return print; });
}

/// A sheet whose hinges lie, lean and are turned in their walls as the seed has it, within what leaves room.
Linkage random_sheet(int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> t(0.4, 0.6), alpha(1.3, 1.8), beta(-0.5, 0.5), offset(-0.05, 0.05);
  Lattice sheet = make_sheet(3, 2, {15, 0.8, 6});
  for (int h = 0; h < sheet.hinges(); ++h)
    sheet.hinge(h) = {t(random), alpha(random), beta(random), offset(random)};
  return sheet;
}

TEST(ConvexHull, OfABoxAndPointsOnItHasItsSixFaces) {
  std::vector<Eigen::Vector3d> points{{0.5, 0, 0}, {0.5, 0.5, 1}, {0.2, 0.3, 0.4}, {1, 1, 1}};
  for (const double x : {0., 1.})
    for (const double y : {0., 1.})
      for (const double z : {0., 1.}) points.emplace_back(x, y, z);
  const ConvexHull hull = convex_hull(points);
  EXPECT_EQ(hull.faces.size(), 6U);
  Polyhedron solid{hull.corners, {}};
  for (const auto& face : hull.faces) {
    EXPECT_EQ(face.size(), 4U);
    solid.add_face(face);
  }
  EXPECT_TRUE(is_closed(solid));
  EXPECT_NEAR(volume_mm3(solid), 1, 1e-15);
}

TEST(MassProperties, AreThoseOfTheBoxInClosedForm) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Vector3d middle(3, -4, 5), sides(1, 2, 3);
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        points.push_back(middle + Eigen::Vector3d(x, y, z).cwiseProduct(sides));
  const ConvexHull hull = convex_hull(points);
  Polyhedron box{hull.corners, {}};
  for (const auto& face : hull.faces) box.add_face(face);
  const MassProperties m = mass_properties(box);
  EXPECT_NEAR(m.volume_mm3, 6, 1e-13);
  EXPECT_LE((m.center - middle).norm(), 1e-13);
  const Eigen::Vector3d expected = 6.0 / 12 * Eigen::Vector3d(4 + 9, 1 + 9, 1 + 4);
  EXPECT_LE((m.inertia - Eigen::Matrix3d(expected.asDiagonal())).norm(), 1e-12);
}

TEST(BodySolid, OfAnUprightCrossHasTheVolumeOfItsPlates) {
  const Linkage sheet = Lattice(make_sheet(2, 2, size));
  const auto bodies = solids(sheet, block());
  const double arm = 10 / 2. - 0.8 / 2 - 1 / 2.;  // from the post to the gap
  EXPECT_NEAR(volume_mm3(body_mesh(bodies[4])), 6 * (0.8 * 0.8 + 4 * arm * 0.8), 1e-10)
      << "the middle vertex";
  EXPECT_NEAR(volume_mm3(soft_solid(sheet, 0, block())), 1 * 0.8 * 6, 1e-12);
}

TEST(BodySolid, AtAPinHasTheVolumeOfPlatesKnucklesAndRods) {
  HingePrint fine = pin();
  fine.tolerance_mm = 1e-6;
  const Linkage sheet = Lattice(make_sheet(2, 2, size));
  const double R = 0.5 + 0.1 + 0.8, g = R + 0.1, half = 0.4;
  // Before the circle: two triangles from the wall's corners to where tangents touch, the wedge between and the circle's rest.
  const double d = std::hypot(g, half), touch = std::acos(R / d), corner = std::atan2(half, g);
  const double knuckle = R * R * (M_PI - touch - corner) + R * std::sqrt(d * d - R * R) + g * half;
  const double arm = 5 - 0.4 - g, plates = 6 * (0.8 * 0.8 + 4 * arm * 0.8);
  const double eye = 3 - 0.2, cheeks = 6 - eye - 0.4;
  double fork_body = plates + 4 * (cheeks * knuckle + (eye + 0.4) * M_PI * 0.25),
         eye_body = plates + 4 * eye * (knuckle - M_PI * 0.36);
  if (sheet.bodies[4].sense < 0) std::swap(fork_body, eye_body);
  EXPECT_NEAR(volume_mm3(body_mesh(solids(sheet, fine)[4])) / fork_body, 1, 1e-5);
}

TEST(BodySolid, OfRandomLeaningHingesIsClosedAndAsLargeAsItsPieces) {
  for (int seed = 1; seed <= 5; ++seed)
    for (const HingePrint& print : {pin(), block()})
      for (const BodySolid& body : solids(random_sheet(seed), print)) {
        const Polyhedron mesh = body_mesh(body);
        EXPECT_TRUE(is_closed(mesh)) << "seed " << seed;
        double pieces = 0;
        for (const ConvexPiece& piece : convex_pieces(body)) {
          if (piece.corners.size() > 20) continue;  // knuckles and rods: too many corners for this hull
          const ConvexHull hull = convex_hull(piece.corners);
          Polyhedron solid{hull.corners, {}};
          for (const auto& face : hull.faces) solid.add_face(face);
          pieces += volume_mm3(solid);
        }
        for (const ArmSolid& arm : body.arms) {
          if (arm.end.knuckle_radius == 0) continue;
          const auto area = [](const std::vector<Eigen::Vector2d>& p) {
            double twice = 0;
            for (std::size_t k = 0; k < p.size(); ++k) {
              const Eigen::Vector2d &a = p[k], &b = p[(k + 1) % p.size()];
              twice += a.x() * b.y() - a.y() * b.x();
            }
            return twice / 2;
          };
          for (const HingeEnd::Lug& lug : arm.end.lugs)
            pieces += (lug.to - lug.from) * (area(arm.end.section) - area(arm.end.bore));
          if (!arm.end.rod.empty()) pieces += (arm.end.lugs[1].from - arm.end.lugs[0].to) * area(arm.end.rod);
        }
        EXPECT_NEAR(volume_mm3(mesh) / pieces, 1, 1e-9) << "seed " << seed;
      }
}

/// Upright walls at uneven angles, as drawings have them.
TEST(BodySolid, OfHingesFarBesideTheirWallsIsClosed) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-0.25, 0.25);
  Lattice sheet = make_sheet(4, 4, {30, 0.8, 6});
  for (int h = 0; h < sheet.hinges(); ++h) sheet.hinge(h).offset = offset(random);
  for (const HingePrint& print : {pin(), block()})
    for (const BodySolid& body : solids(sheet, print)) EXPECT_TRUE(is_closed(body_mesh(body)));
}

TEST(BlockEnd, TakesStepsThatFilesCannotHoldAsNone) {
  HingePrint print = block();
  const double flush = size.thickness_mm / 2 - print.made.thickness_mm / 2;
  EXPECT_TRUE(block_end(print, size, flush + 5e-4).section.empty());
  EXPECT_EQ(block_end(print, size, flush + 0.5).section.size(), 4U) << "a foot at 45 degrees";
  EXPECT_EQ(block_end(print, size, flush + size.thickness_mm + 5e-4).section.size(), 4U);
  EXPECT_EQ(block_end(print, size, flush + size.thickness_mm + 0.5).section.size(), 5U)
      << "and upright above";
}

TEST(BodySolid, OfWallsAtAnyAnglesIsClosed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(0.7, 2.2);
  for (int trial = 0; trial < 200; ++trial) {
    Linkage star;
    star.size = {20, 0.8, 6};
    star.wall_name = star.vertex_name = [](int) { return std::string("one"); };
    star.bodies.push_back({Eigen::Vector3d::Zero(), 1});
    double angle = 0;
    while ((angle += between(random)) < 2 * M_PI - 0.7) {
      HingedWall wall;
      wall.upper = static_cast<int>(star.bodies.size());
      wall.edge = {std::cos(angle), std::sin(angle), 0};
      star.bodies.push_back({wall.edge, -1});
      for (const Plate& plate : plates(wall, static_cast<int>(star.hinges.size())))
        star.plates.push_back(plate);
      star.hinges.push_back(rest_hinge(wall));
    }
    for (const BodySolid& body : solids(star, pin()))
      EXPECT_TRUE(is_closed(body_mesh(body))) << "trial " << trial;
  }
}

TEST(PinEnd, KeepsItsClearanceBetweenThePolygonsOfRodAndBore) {
  for (const double offset : {0.0, 0.3, 0.9, -1.4}) {
    const HingeEnd fork = pin_end(pin(), size, offset, true), eye = pin_end(pin(), size, offset, false);
    ASSERT_EQ(fork.rod.size(), eye.bore.size());
    double least = 1;
    for (const Eigen::Vector2d& p : fork.rod)
      for (std::size_t k = 0; k < eye.bore.size(); ++k) {
        const Eigen::Vector2d &a = eye.bore[k], side = eye.bore[(k + 1) % eye.bore.size()] - a;
        least = std::min(least, (side.x() * (p - a).y() - side.y() * (p - a).x()) / side.norm());
      }
    EXPECT_GE(least, 0.1 - 1e-12);
    EXPECT_LE(least, 0.11);
    // The knuckle goes all the way round, wherever the axis is.
    double furthest = 0;
    for (const Eigen::Vector2d& p : fork.section) furthest = std::max(furthest, p.x());
    EXPECT_NEAR(furthest, 1.4, 1e-9) << offset;
    EXPECT_NEAR(fork.lugs[0].to, -eye.lugs[0].to - 0.2, 1e-12);
  }
}

/// The bore of a separate rod may be narrower than the gap between plates and knuckles.
TEST(PinEnd, KeepsTheLeastGapAroundANarrowBore) {
  HingePrint rod = pin();
  rod.made.kind = HingeKind::rod;
  rod.loose = true;
  const HingeEnd tight = hinge_end(rod, size, 0, false), fork = hinge_end(rod, size, 0, true);
  rod.min_gap_mm = 0.3;
  const HingeEnd apart = hinge_end(rod, size, 0, false);
  EXPECT_EQ(apart.bore_radius, tight.bore_radius);
  EXPECT_NEAR(apart.bore_radius, 0.6, 1e-12);
  EXPECT_NEAR(apart.wall_end - tight.wall_end, 0.2, 1e-12);
  EXPECT_EQ(fork.bore_radius, 0.5) << "holds the rod by friction";
  EXPECT_TRUE(fork.rod.empty());
}

/// Least distance of points within a polygon from its sides, mm.
double least_inside(const std::vector<Eigen::Vector2d>& points, const std::vector<Eigen::Vector2d>& around) {
  double least = INFINITY;
  for (const Eigen::Vector2d& p : points)
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Eigen::Vector2d &a = around[k], side = around[(k + 1) % around.size()] - a;
      if (side.norm() > 0)
        least = std::min(least, (side.x() * (p - a).y() - side.y() * (p - a).x()) / side.norm());
    }
  return least;
}

/// Wall ends and outlines are those of an axis in the middle, to what polygons leave of circles; bores have their wall.
TEST(PinEnd, OfCapsLooksAlikeWhereverTheAxisIs) {
  HingePrint caps = pin();
  caps.cap_across_mm = 0.9;
  caps.turn = 1.1;
  const double radius = 0.5 + 0.1 + 0.8 + 0.9;
  for (const double across : {0.0, 0.4, -0.9, 0.9})
    for (const bool fork : {true, false}) {
      const HingeEnd end = pin_end(caps, size, across, fork);
      EXPECT_EQ(end.wall_end, pin_end(caps, size, 0, fork).wall_end);
      EXPECT_EQ(end.axis_across, across);
      for (const Eigen::Vector2d& p : end.section) {
        if (p.x() < 0) continue;
        EXPECT_NEAR(p.norm(), radius, 0.02) << across;
      }
      EXPECT_GE(least_inside(fork ? end.rod : end.bore, end.section), 0.8 - 0.03) << across;
      // The other's cap, as far beside the axis, turned as far as it goes: its nearest point to this plate's end.
      EXPECT_GE(end.wall_end - (radius + std::abs(across) * std::sin(1.1)), 0.1 - 1e-12);
    }
}

TEST(BodySolid, OfCapsIsClosed) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-0.03, 0.03);
  Lattice sheet = make_sheet(4, 4, {30, 0.8, 6});
  for (int h = 0; h < sheet.hinges(); ++h) sheet.hinge(h).offset = offset(random);
  HingePrint caps = pin();
  caps.cap_across_mm = 0.9;
  for (const BodySolid& body : solids(sheet, caps)) EXPECT_TRUE(is_closed(body_mesh(body)));
}

double frustum_mm3(double R, double r, double along) { return M_PI / 3 * along * (R * R + R * r + r * r); }

/// Compares with knuckles that have flat faces: cones about a fork's rod, and sunk into an eye.
TEST(BodySolid, AtInclinedFacesHasTheVolumeOfTheirCones) {
  HingePrint flat = pin();
  flat.tolerance_mm = 4e-6;  // of volumes of some mm^3 that agree to 1e-4
  HingePrint inclined = flat;
  inclined.rim_mm = 0.4;
  const Linkage sheet = Lattice(make_sheet(2, 2, size));
  const double rod = 0.5, bore = 0.6, rim = bore + 0.8 - 0.4, up = 1.1 * (rim - rod), in = 1.1 * (rim - bore);
  const std::vector<BodySolid> with_cones = solids(sheet, inclined), without = solids(sheet, flat);
  for (const int body : {4, 1}) {
    const double arms = static_cast<double>(with_cones[body].arms.size());
    const Polyhedron mesh = body_mesh(with_cones[body]);
    EXPECT_TRUE(is_closed(mesh));
    const double change = volume_mm3(mesh) - volume_mm3(body_mesh(without[body]));
    EXPECT_NEAR(change,
                sheet.bodies[body].sense > 0
                    ? 2 * arms * (frustum_mm3(rim, rod, up) - M_PI * rod * rod * up)
                    : -2 * arms * (frustum_mm3(rim, bore, in) - M_PI * bore * bore * in),
                1e-4)
        << body;
  }
  EXPECT_NE(sheet.bodies[4].sense, sheet.bodies[1].sense);
  inclined.tolerance_mm = 1e-4;  // being closed needs no accurate circles
  for (int seed = 1; seed <= 3; ++seed)
    for (const BodySolid& body : solids(random_sheet(seed), inclined))
      EXPECT_TRUE(is_closed(body_mesh(body)));
}

/// The smallest cell that leaves pins turned in their walls by alpha room beside their junctions, to a thousandth of a mm.
double min_edge_mm(double alpha) {
  double refused = 4, taken = 40;  // mm
  while (taken - refused > 1e-3) {
    const double edge = (refused + taken) / 2;
    Lattice sheet = make_sheet(2, 2, {edge, 0.8, 6});
    for (int h = 0; h < sheet.hinges(); ++h) sheet.hinge(h).alpha = alpha;
    try {
      solids(sheet, pin());
      taken = edge;
    } catch (const InvalidInput&) {
      refused = edge;
    }
  }
  return taken;
}

/// Counts the triangles on the sides of an arm's plate that face into it.
int turned_over(const Polyhedron& mesh, const ArmSolid& arm) {
  int count = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d from = mesh.points[a];
    const double at = arm.normal.dot(from);
    const Eigen::Vector3d outwards = (mesh.points[b] - from).cross(mesh.points[c] - from);
    const bool is_side = std::abs(std::abs(at) - arm.size.thickness_mm / 2) < 1e-9 &&
                         std::abs(arm.normal.dot(mesh.points[b]) - at) < 1e-9 &&
                         std::abs(arm.normal.dot(mesh.points[c]) - at) < 1e-9;
    count += is_side && arm.normal.dot(outwards) * at < 0;
  }
  return count;
}

TEST(BodySolid, OfTheShortestPlatesBesideTurnedHingesHasNoFaceTurnedOver) {
  for (const double alpha : {1.2, 1.4, M_PI / 2, 1.9}) {
    Lattice sheet = make_sheet(2, 2, {min_edge_mm(alpha), 0.8, 6});
    for (int h = 0; h < sheet.hinges(); ++h) sheet.hinge(h).alpha = alpha;
    for (const BodySolid& body : solids(sheet, pin())) {
      const Polyhedron mesh = body_mesh(body);
      for (const ArmSolid& arm : body.arms) EXPECT_EQ(turned_over(mesh, arm), 0) << "alpha " << alpha;
    }
  }
}

TEST(BodySolid, RefusesAHingeThatOverlapsItsJunction) {
  Lattice sheet = make_sheet(2, 2, size);
  sheet.hinge(0).t = 0.15;
  EXPECT_THROW(solids(sheet, pin()), InvalidInput);
  sheet.hinge(0).t = 0.5;
  EXPECT_NO_THROW(solids(sheet, pin()));
}

// Least length, strain and corners in turn ask for most; stretch comes in addition.
TEST(OpenHinge, IsAsLongAsItsFoldNeeds) {
  const CellSize size{10, 0.8, 6};
  const Process& process = *find_process("polyjet");
  const ManufacturedHinge block = open_hinge(HingeKind::block, process, size);
  EXPECT_EQ(block.material.name, process.rubber);
  EXPECT_EQ(block.thickness_mm, 0.8);
  EXPECT_NEAR(open_gap_mm(block, 0.8, 0, 0.5), 1.0, 1e-12);        // 1.25 thick
  EXPECT_NEAR(open_gap_mm(block, 0.8, 0, 2.01), 1.7, 1e-12);       // 2.01 x 0.4 / 0.5 = 1.608
  EXPECT_NEAR(open_gap_mm(block, 0.8, 0, 0.5, 0.44), 1.3, 1e-12);  // (0.5 x 0.4 + 0.44) / 0.5 = 1.28
  EXPECT_NEAR(open_gap_mm(block, 4, 0, 1.5), 4.1, 1e-12);          // 2.2 x 2 tan(0.75) = 4.099
  const ManufacturedHinge pin = open_hinge(HingeKind::pin, process, size);
  EXPECT_EQ(pin.diameter_mm, process.min_pin_mm);
  EXPECT_EQ(pin.clearance_mm, process.clearance_mm);
  const ManufacturedHinge rod = open_hinge(HingeKind::rod, *find_process("fdm"), size);
  EXPECT_EQ(rod.material.name, "steel");
  EXPECT_EQ(rod.diameter_mm, usual_rod_mm) << "less than FDM prints";
  EXPECT_EQ(rod.clearance_mm, 2 * find_process("fdm")->sd.clearance_mm);
  const ManufacturedHinge film = open_hinge(HingeKind::film, *find_process("sla"), size);
  EXPECT_EQ(film.thickness_mm, 0.4);
  EXPECT_EQ(film.material.name, "pp") << "films of SLA are strips of their own";
}

}  // namespace
}  // namespace kinetix::model
