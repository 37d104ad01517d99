#include "app/drive_section.hpp"

#include "app/wall_node.hpp"
#include "model/classify.hpp"
#include "model/net_grip.hpp"

namespace kinetix {
namespace {

const Bounds fraction = between(0, 1);

Grip read_corners(const Node& node) {
  const auto corners = node.list_of(2, "its lower left and upper right vertex, e.g. [[3, 3], [5, 5]]");
  return {read_vertex(corners[0]), read_vertex(corners[1])};
}

Grip read_grip(const Node& node, Axis axis, const Structure& structure) {
  const Grip grip = read_corners(node);
  node.located([&] {
    validate(grip, axis, structure);
    require_kept_rows(structure, classify(structure), axis, grip);
  });
  return grip;
}

int read_sign(const Node& node) { return node.choice<int>({{"1", 1}, {"-1", -1}}); }

/// `drive: {side: -1}` alone says nothing of where to go.
bool is_side_alone(const Node& drive) {
  if (!drive.optional("side")) return false;
  for (const char* key : {"kind", "axis", "compression", "branch", "grip", "wall", "angle_deg"})
    if (drive.optional(key)) return false;
  return true;
}

}  // namespace

std::optional<DriveSection> read_drive_section(const Node& root, const Structure& structure) {
  using Kind = DriveSection::Kind;
  const auto section = root.optional("drive");
  if (!section) return std::nullopt;
  if (is_side_alone(*section)) {
    section->reject_unknown_keys({"side"});
    return std::nullopt;
  }
  DriveSection drive;
  drive.kind = section->required("kind", "plates or hinge")
                   .choice<Kind>({{"plates", Kind::plates}, {"hinge", Kind::hinge}});
  if (drive.kind == Kind::plates) {
    section->reject_unknown_keys({"kind", "axis", "compression", "branch", "grip", "side"});
    if (const auto node = section->optional("axis"))
      drive.axis = node->choice<Axis>({{"x", Axis::x}, {"y", Axis::y}});
    drive.compression = section->required("compression", "a number above 0 and below 1").number(fraction);
    if (const auto node = section->optional("branch")) drive.branch = read_sign(*node);
    if (const auto node = section->optional("grip")) drive.grip = read_grip(*node, drive.axis, structure);
  } else {
    section->reject_unknown_keys({"kind", "wall", "angle_deg", "side"});
    drive.wall = structure.hinges[read_hinge_index(*section, structure)].wall;
    const Bounds turn = between(-180, 180, "degrees");
    drive.angle = section->required("angle_deg", turn.describe()).angle(turn);
  }
  return drive;
}

int read_side(const Node& root) {
  const auto drive = root.optional("drive");
  const auto side = drive ? drive->optional("side") : std::nullopt;
  return side ? read_sign(*side) : 1;
}

}  // namespace kinetix
