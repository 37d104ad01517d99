#include "app/print/sheet/coupon.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/print/sheet/pin_faces.hpp"
#include "app/print/sheet/raised_text.hpp"
#include "model/base/angle.hpp"
#include "model/linkage/wall.hpp"

namespace kinetix::app {
namespace {

constexpr int gaps = 6;                      // of 0.1, 0.2, ... 0.6 mm: round the 0.25 and 0.3 of SLA and FDM
constexpr double gap_step_mm = 0.1;          // mm: what printers differ by
constexpr double tilts_deg[] = {0, 30, 60};  // degrees from upright: layers step sideways by their tangent
constexpr double edge_mm = 26;               // mm, of a wall with room for the largest knuckle and its number
constexpr double flat = 1e-9;                // of a unit vector: less is rounding
constexpr double wall_mm = 0.8;              // mm: that of the shipped targets
constexpr double height_mm = 8;              // mm: room for three knuckles
constexpr double column_mm = 32, row_mm = 20;  // mm, from one hinge to the next: walls stay apart

/// @param column of its gap   @param row of its tilt
void add_hinge(int column, int row, const model::Process& process, PrintSheet& sheet) {
  model::Linkage& linkage = sheet.linkage;
  const Eigen::Vector3d at = Eigen::Vector3d(column * column_mm, row * row_mm, 0) / edge_mm;
  model::HingedWall wall;
  wall.lower = static_cast<int>(linkage.bodies.size());
  wall.upper = wall.lower + 1;
  wall.edge = Eigen::Vector3d::UnitX();
  wall.hinge.beta = tilts_deg[row] * radians_per_degree;
  linkage.bodies.push_back({at, 1});
  linkage.bodies.push_back({at + wall.edge, -1});
  for (const model::Plate& plate : plates(wall, static_cast<int>(linkage.hinges.size())))
    linkage.plates.push_back(plate);
  linkage.hinges.push_back(rest_hinge(wall));
  model::MadeHinge pin;
  pin.kind = model::HingeKind::pin;
  pin.material = *model::find_material("pa12");
  pin.diameter_mm = process.least_pin_mm;
  pin.clearance_mm = gap_step_mm * (column + 1);
  pin.height_mm = height_mm;
  sheet.hinges.push_back(with_faces({.made = pin, .knuckle_wall_mm = process.least_wall_mm}, process));
}

std::string coupon_hinge_name(int hinge) {
  const int row = hinge % static_cast<int>(std::size(tilts_deg)),
            column = hinge / static_cast<int>(std::size(tilts_deg));
  return fmt::format("{:.1f} mm, {:g} degrees", gap_step_mm * (column + 1), tilts_deg[row]);
}

/// The gap, on the side of the fork's wall that looks up, or to the front.
void add_number(int hinge, PrintSheet& sheet) {
  const int body = sheet.linkage.hinges[hinge].lower;
  const model::ArmSolid& arm = sheet.bodies[body].arms.front();
  const double from = arm.start, to = arm.edge.dot(arm.point({-arm.end.wall_end, 0}, 0));
  const double side = arm.normal.z() > flat || (arm.normal.z() > -flat && arm.normal.y() < 0) ? 1 : -1;
  const Eigen::Vector3d outwards = side * arm.normal;
  const TextFace face{(from + to) / 2 * arm.edge + arm.size.thickness_mm / 2 * outwards,
                      arm.up.cross(outwards), arm.up};
  raise_text(fmt::format("{:.1f}", sheet.hinges[hinge].made.clearance_mm), face, sheet.meshes[body]);
}

/// Both bodies of a hinge on one tile.
Tiles coupon_tiles(const PrintSheet& sheet, const Eigen::Vector2d& bed_mm) {
  std::vector<Eigen::AlignedBox2d> pairs(sheet.hinges.size());
  const int bodies = static_cast<int>(sheet.meshes.size());
  for (int b = 0; b < bodies; ++b)
    for (const Eigen::Vector3d& p : placed_body(sheet, sheet.path.front(), b).points)
      pairs[b / 2].extend(p.head<2>());
  Tiles tiles = cut_into_tiles(pairs, bed_mm);
  const std::vector<int> of_pair = std::move(tiles.of_body);
  tiles.of_body.clear();
  for (int b = 0; b < bodies; ++b) tiles.of_body.push_back(of_pair[b / 2]);
  return tiles;
}

}  // namespace

PrintSheet make_coupon(const model::Process& process, const std::optional<Eigen::Vector2d>& bed_mm) {
  PrintSheet sheet;
  sheet.name = "coupon";
  sheet.process = process;
  sheet.linkage.size = {edge_mm, std::max(wall_mm, process.least_wall_mm), height_mm};
  for (int column = 0; column < gaps; ++column)
    for (int row = 0; row < static_cast<int>(std::size(tilts_deg)); ++row)
      add_hinge(column, row, process, sheet);
  sheet.linkage.wall_name = coupon_hinge_name;
  sheet.linkage.vertex_name = [](int body) {
    return coupon_hinge_name(body / 2) + (body % 2 == 0 ? ", fork" : ", eye");
  };
  sheet.path = {rest_state(sheet.linkage)};
  sheet.thetas = {0};
  sheet.why_no_path = "a coupon's hinges each turn by themselves";
  sheet.warnings = {
      "gaps from 0.1 to 0.6 mm a side, left to right, told by the numbers on them; rows lean by 0, 30 and 60 "
      "degrees: the least gap that turns is your printer's, for --clearance"};
  make_solids(sheet);
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) add_number(h, sheet);
  if (bed_mm) sheet.tiles = coupon_tiles(sheet, *bed_mm);
  return sheet;
}

}  // namespace kinetix::app
