#include "app/files/drive_section.hpp"

#include "app/files/wall_node.hpp"
#include "model/lattice/square/classify.hpp"
#include "model/lattice/square/net_grip.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Kind = DriveSection::Kind;

// Of a compression (fraction of the plates' first distance): 0 leaves nothing to do, at 1 the plates meet.
const targets::Bounds fraction = targets::between(0, 1);
// Of a driven hinge, degrees: half a turn either way is all that one angle can tell.
const targets::Bounds turn = targets::between(-180, 180, "degrees");
// What the keys of the section may say.
constexpr targets::Word<Kind> kinds[] = {{"plates", Kind::plates}, {"hinge", Kind::hinge}};
constexpr targets::Word<model::Axis> axes[] = {{"x", model::Axis::x}, {"y", model::Axis::y}};
constexpr targets::Word<int> signs[] = {{"1", 1}, {"-1", -1}};  // of `branch` and `side`, nothing between

targets::Key side_key() {
  return {"side", value::choice(signs), targets::by_default("1"),
          "which way to leave a bifurcation that the drive leaves open"};
}

model::Grip read_corners(const targets::Node& node) {
  const auto corners = node.list_of(2, "its lower left and upper right vertex, e.g. [[3, 3], [5, 5]]");
  return {read_vertex(corners[0]), read_vertex(corners[1])};
}

model::Grip read_grip(const targets::Node& node, model::Axis axis, const model::Sheet& structure) {
  const model::Structure* squares = structure.squares();
  if (!squares)
    throw node.key_error("a part to grip is a rectangle of squares: not with lattice: " +
                         lattice_name(structure) + "; plates grip the rim");
  const model::Grip grip = read_corners(node);
  node.located([&] {
    validate(grip, axis, *squares);
    require_kept_rows(*squares, classify(*squares), axis, grip);
  });
  return grip;
}

const targets::KeyTable& drive_keys() {
  static const targets::KeyTable keys(
      {
          {"kind", value::choice(kinds), targets::needed, "what moves the structure"},
          {"axis", value::choice(axes), targets::by_default("y"), "normal of the two plates", "plates"},
          {"compression", value::number(fraction), targets::needed,
           "1 less the final over the initial distance of the plates", "plates"},
          {"branch", value::choice(signs), targets::otherwise("that of `design.theta_deg`"), "sign of theta",
           "plates"},
          {"grip", value::list(vertex_type(), "`[[i0, j0], [i1, j1]]`", 2, 2),
           targets::otherwise("the rim; of a net its base or spine"),
           "the part that the plates grip: its lower left and upper right vertex", "plates"},
          press_key(),
          wall_key("hinge"),
          {"angle_deg", value::angle(turn), targets::needed,
           "turn of the wall's half at its upper vertex against that at its lower one", "hinge"},
          side_key(),
      },
      {{"plates", "hinge"}, "kind"});
  return keys;
}

/// `drive: {side: -1}` alone says nothing of where to go.
const targets::KeyTable& side_alone_keys() {
  static const targets::KeyTable keys({side_key()});
  return keys;
}

bool is_side_alone(const targets::Node& drive) {
  if (!drive.optional("side")) return false;
  for (const std::string_view key : drive_keys().names())
    if (key != "side" && drive.optional(key)) return false;
  return true;
}

DriveSection read_plates(const targets::Node& node, const model::Sheet& structure) {
  const targets::KeyTable keys = drive_keys().only("plates");
  const targets::Section section(node, keys);
  DriveSection drive;
  section.read("axis", drive.axis, axes);
  section.read_needed("compression", "a number above 0 and below 1", drive.compression);
  section.read("branch", drive.branch, signs);
  section.read("press", drive.press);
  if (const auto grip = section.optional("grip")) drive.grip = read_grip(*grip, drive.axis, structure);
  return drive;
}

DriveSection read_hinge(const targets::Node& node, const model::Sheet& structure) {
  const targets::KeyTable keys = drive_keys().only("hinge");
  const targets::Section section(node, keys);
  DriveSection drive{.kind = Kind::hinge};
  drive.hinge = WallReader(structure).hinge_of(section);
  section.read_needed("angle_deg", turn.describe(), drive.angle);
  return drive;
}

}  // namespace

targets::Key press_key() {
  return {
      "press", value::boolean(), targets::by_default("false"),
      "`true`: plates push the vertices of their rows and do not hold them, so that vertices may leave their "
      "plate; only with elastic hinges (`--model equilibrium`, or a physics run of them)",
      "plates"};
}

targets::Key drive_key() {
  return {"drive", value::either({value::map(drive_keys()), value::map(side_alone_keys())}),
          targets::otherwise("to `design.theta_deg`"), "how the structure is moved; `side` may stand alone"};
}

std::optional<DriveSection> read_drive_section(const targets::Section& root, const model::Sheet& structure) {
  const auto node = root.optional("drive");
  if (!node) return std::nullopt;
  if (is_side_alone(*node)) {
    targets::Section(*node, side_alone_keys());
    return std::nullopt;
  }
  const Kind kind = read_word(node->required("kind", "plates or hinge"), kinds);
  return kind == Kind::plates ? read_plates(*node, structure) : read_hinge(*node, structure);
}

int read_side(const targets::Section& root) {
  const auto drive = root.optional("drive");
  const auto side = drive ? drive->optional("side") : std::nullopt;
  return side ? read_word(*side, signs) : 1;
}

}  // namespace kinetix::app
