#include "app/files/drive_section.hpp"

#include "app/files/wall_node.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/family/net_grip.hpp"
#include "model/linkage/actuators.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Kind = DriveSection::Kind;

// Of a compression (fraction of the plates' first distance): 0 leaves nothing to do, at 1 the plates meet.
const targets::Bounds fraction = targets::between(0, 1);
// Of a driven hinge, degrees: half a turn either way is all that one angle can tell.
const targets::Bounds turn = targets::between(-180, 180, "degrees");
// What the keys of the section may say.
constexpr targets::Word<Kind> kinds[] = {{"plates", Kind::plates},
                                         {"hinge", Kind::hinge},
                                         {"cord", Kind::cord},
                                         {"shape_memory", Kind::shape_memory}};
constexpr targets::Word<model::Axis> axes[] = {{"x", model::Axis::x}, {"y", model::Axis::y}};
constexpr targets::Word<int> signs[] = {{"1", 1}, {"-1", -1}};  // of `branch` and `side`, nothing between

targets::Key side_key() {
  return {"side", value::choice(signs), targets::by_default("1"),
          "which way to leave a bifurcation that the drive leaves open"};
}

targets::Key branch_key(const char* with) {
  return {"branch", value::choice(signs), targets::otherwise("that of `design.theta_deg`"),
          std::string(with) == "cord" ? "sign of theta where the cord pulls to both sides alike"
                                      : "sign of theta",
          with};
}

targets::Key walls_key(const char* name, std::size_t shortest, targets::Default fallback, const char* meaning,
                       const char* with) {
  return {name, value::list(wall_key().type, "list of walls, each by its two vertices", shortest),
          std::move(fallback), meaning, with};
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
          branch_key("plates"),
          {"grip", value::list(vertex_type(), "`[[i0, j0], [i1, j1]]`", 2, 2),
           targets::otherwise("the rim; of a net its base or spine"),
           "the part that the plates grip: its lower left and upper right vertex", "plates"},
          press_key(),
          wall_key("hinge"),
          {"angle_deg", value::angle(turn), targets::needed,
           "turn of the wall's half at its upper vertex against that at its lower one", "hinge"},
          walls_key("through", 2, targets::needed,
                    "the walls through whose hinge points the cord runs, in its order; two that share a "
                    "vertex keep their "
                    "distance, whatever the sheet does",
                    "cord"),
          {"shorten_mm", value::number(targets::above(0, "mm (below the cord's length)")), targets::needed,
           "by how much the whole cord gets shorter; it pulls and never pushes", "cord"},
          branch_key("cord"),
          {"angle_deg", value::angle(turn), targets::needed,
           "turn at which the hot springs rest: that of a hinge at theta = `angle_deg` / 2 in the sense of "
           "the "
           "checkerboard",
           "shape_memory"},
          {"k_turn", value::number(targets::above(0, "N mm/rad")), targets::needed,
           "stiffness of the spring in each hinge, besides that of the hinge", "shape_memory"},
          walls_key("walls", 1, targets::otherwise("all"), "the walls whose hinges have such a spring",
                    "shape_memory"),
          side_key(),
      },
      {{"plates", "hinge", "cord", "shape_memory"}, "kind"});
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

std::vector<int> read_walls(const targets::Node& node, const model::Sheet& structure) {
  const WallReader walls(structure);
  std::vector<int> hinges;
  for (const targets::Node& wall : node.list("a list of walls")) hinges.push_back(walls.hinge_of(wall));
  if (hinges.empty()) throw node.error("names no wall; allowed: at least one");
  return hinges;
}

DriveSection read_cord(const targets::Node& node, const model::Sheet& structure) {
  const targets::KeyTable keys = drive_keys().only("cord");
  const targets::Section section(node, keys);
  DriveSection drive{.kind = Kind::cord};
  const targets::Node through =
      section.required("through", "at least two walls, e.g. `[[[0, 0], [0, 1]], [[1, 0], [1, 1]]]`");
  drive.through = read_walls(through, structure);
  section.read_needed("shorten_mm", "a length in mm, above 0", drive.shorten_mm);
  section.read("branch", drive.branch, signs);
  through.located([&] { model::cord_drive(structure, drive.through, 0); });
  section.optional("shorten_mm")->located([&] {
    model::cord_drive(structure, drive.through, drive.shorten_mm);
  });
  return drive;
}

DriveSection read_shape_memory(const targets::Node& node, const model::Sheet& structure) {
  const targets::KeyTable keys = drive_keys().only("shape_memory");
  const targets::Section section(node, keys);
  DriveSection drive{.kind = Kind::shape_memory};
  section.read_needed("angle_deg", turn.describe(), drive.angle);
  section.read_needed("k_turn", "a stiffness in N mm/rad, above 0", drive.k_turn);
  section.optional("k_turn")->located(
      [&] { model::shape_memory_drive(structure, {}, drive.k_turn, drive.angle); });
  if (const auto walls = section.optional("walls")) {
    drive.springs = read_walls(*walls, structure);
    walls->located([&] { model::shape_memory_drive(structure, drive.springs, drive.k_turn, drive.angle); });
  }
  return drive;
}

DriveSection read_drive(Kind kind, const targets::Node& node, const model::Sheet& structure) {
  switch (kind) {
    case Kind::plates:
      return read_plates(node, structure);
    case Kind::hinge:
      return read_hinge(node, structure);
    case Kind::cord:
      return read_cord(node, structure);
    case Kind::shape_memory:
    case Kind::none:
      break;
  }
  return read_shape_memory(node, structure);
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
  return read_drive(read_word(node->required("kind", "plates, hinge, cord or shape_memory"), kinds), *node,
                    structure);
}

int read_side(const targets::Section& root) {
  const auto drive = root.optional("drive");
  const auto side = drive ? drive->optional("side") : std::nullopt;
  return side ? read_word(*side, signs) : 1;
}

}  // namespace kinetix::app
