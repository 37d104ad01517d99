#include "app/files/drive_section.hpp"

#include <fmt/format.h>

namespace kinetix::app {
namespace {

constexpr int highest_number = 4'000'000;  // of a vertex in a lattice that numbers them
constexpr int highest_index = 10'000;      // of a vertex: end of the longest side that `cells` allows

model::Wall read_wall(const targets::Node& node) {
  const auto ends = node.list_of(2, "two vertices, e.g. [[0, 0], [1, 0]]");
  const model::Vertex from = read_vertex(ends[0]), to = read_vertex(ends[1]);
  for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
    const model::Wall wall{from, axis};
    if (wall.to() == to) return wall;
    const model::Wall reversed{to, axis};
    if (reversed.to() == from)
      throw node.error("the wall runs from its upper to its lower vertex. Write " + to_string(reversed) +
                       ", and measure position and angles from " + to_string(to));
  }
  throw node.error("vertices " + to_string(from) + " and " + to_string(to) +
                   " are not neighbours. Give a wall of one step along x or y, e.g. [[0, 0], [1, 0]]");
}

int square_hinge(const targets::Node& node, const model::Structure& structure) {
  const model::Wall wall = read_wall(node);
  if (const auto hinge = structure.hinge_at(wall)) return *hinge;
  throw node.error("the structure has no wall " + to_string(wall) +
                   ". Give a side of one of structure.cells");
}

int numbered_hinge(const targets::Node& node, const model::Lattice& sheet,
                   const std::map<std::pair<int, int>, int>& hinge_between) {
  const auto ends = node.list_of(2, "the numbers of two vertices, e.g. [0, 1]");
  const int last = sheet.bodies() - 1, from = ends[0].integer(0, last), to = ends[1].integer(0, last);
  if (const auto hinge = hinge_between.find({from, to}); hinge != hinge_between.end()) return hinge->second;
  if (const auto hinge = hinge_between.find({to, from}); hinge != hinge_between.end())
    throw node.error("the wall runs the other way. Write " + wall_name(sheet, hinge->second) +
                     ", and measure position, angles and offset from vertex " + std::to_string(to));
  throw node.error("no wall joins vertices " + std::to_string(from) + " and " + std::to_string(to) +
                   ". Give a wall by the two vertices that result.json lists for its hinge");
}

}  // namespace

targets::ValueType vertex_type() {
  return targets::value::list(targets::value::integer(0, highest_index), "`[i, j]`", 2, 2);
}

targets::Key wall_key(std::string with, targets::Default fallback) {
  return {
      "wall",
      targets::value::either(
          {targets::value::list(vertex_type(), "`[[i, j], [i, j]]`", 2, 2),
           targets::value::list(targets::value::integer(0, highest_number), "`[number, number]`", 2, 2)}),
      std::move(fallback),
      "the wall. For squares: its lower or left vertex, then the next one along x or y. For other lattices: "
      "the numbers of its two vertices, as in result.json",
      std::move(with)};
}

model::Vertex read_vertex(const targets::Node& node) {
  const auto ij = node.list_of(2, "a vertex [i, j]");
  return {ij[0].integer(0, highest_index), ij[1].integer(0, highest_index)};
}

WallReader::WallReader(const model::Lattice& sheet) : sheet_(sheet) {
  if (sheet.squares()) return;
  for (int h = 0; h < sheet.hinges(); ++h) {
    const model::HingedWall wall = sheet.wall(h);
    hinge_between_.emplace(std::pair(wall.lower, wall.upper), h);
  }
}

int WallReader::hinge_of(const targets::Node& wall) const {
  return sheet_.squares() ? square_hinge(wall, *sheet_.squares())
                          : numbered_hinge(wall, sheet_, hinge_between_);
}

int WallReader::hinge_of(const targets::Section& owner) const {
  return hinge_of(owner.required("wall", sheet_.squares()
                                             ? "its two vertices, e.g. `wall: [[0, 0], [1, 0]]`"
                                             : "the numbers of its two vertices, e.g. `wall: [0, 1]`"));
}

namespace {

namespace value = targets::value;

// Range of a compression (fraction of the plates' initial distance): 0 leaves nothing to do, at 1 the plates meet.
const targets::Bounds fraction = targets::between(0, 1);
// Range of a driven hinge, degrees: one angle cannot describe more than half a turn in either direction.
const targets::Bounds turn = targets::between(-180, 180, "degrees");
// Words of the section's keys.

constexpr targets::Word<model::Axis> axes[] = {{"x", model::Axis::x}, {"y", model::Axis::y}};
constexpr targets::Word<int> signs[] = {{"1", 1}, {"-1", -1}};  // of `branch` and `side`, nothing between

targets::Key side_key() {
  return {"side", value::choice(signs), targets::by_default("1"),
          "direction at a bifurcation that the drive leaves open"};
}

targets::Key branch_key(const char* with) {
  return {"branch", value::choice(signs), targets::otherwise("the sign of `design.fold_angle_deg`"),
          std::string(with) == "cord" ? "sign of the fold angle if the tendon pulls equally to both sides"
                                      : "sign of the fold angle",
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

model::Grip read_grip(const targets::Node& node, model::Axis axis, const model::Lattice& structure) {
  const model::Structure* squares = structure.squares();
  if (!squares)
    throw node.key_error("a part to grip is a rectangle of squares, and the lattice is `" +
                         lattice_name(structure) + "`. Remove the key: plates then grip the boundary");
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
          {"kind", value::choice({"plates", "hinge", "cord", "shape_memory"}), targets::needed,
           "actuation of the structure"},
          {"axis", value::choice(axes), targets::by_default("y"), "normal of the two plates", "plates"},
          {"compression", value::number(fraction), targets::needed,
           "relative shortening: 1 minus the ratio of final to initial distance of the plates", "plates"},
          branch_key("plates"),
          {"grip", value::list(vertex_type(), "`[[i0, j0], [i1, j1]]`", 2, 2),
           targets::otherwise("the boundary; for a net its base or spine"),
           "part that the plates grip: its lower left and upper right vertex", "plates"},
          press_key(),
          wall_key("hinge"),
          {"angle_deg", value::angle(turn), targets::needed,
           "rotation of the wall's half at its upper vertex relative to the half at its lower vertex",
           "hinge"},
          walls_key("through", 2, targets::needed,
                    "walls through whose hinge points the tendon runs, in order. The distance of two walls "
                    "that share a vertex never changes",
                    "cord"),
          {"shorten_mm", value::number(targets::above(0, "mm (below the tendon's length)")), targets::needed,
           "shortening of the whole tendon. A tendon only pulls", "cord"},
          branch_key("cord"),
          {"angle_deg", value::angle(turn), targets::needed,
           "rest angle of the hot springs. Hinges have this rotation at a fold angle of `angle_deg` / 2, "
           "with "
           "the signs of the checkerboard",
           "shape_memory"},
          {"k_turn", value::number(targets::above(0, "N mm/rad")), targets::needed,
           "stiffness of the spring in each hinge, in addition to that of the hinge", "shape_memory"},
          walls_key("walls", 1, targets::otherwise("all"), "walls whose hinges have such a spring",
                    "shape_memory"),
          side_key(),
      },
      {{"plates", "hinge", "cord", "shape_memory"}, "kind"});
  return keys;
}

/// Returns the keys of a drive without a goal, `drive: {side: -1}`.
const targets::KeyTable& side_only_keys() {
  static const targets::KeyTable keys({side_key()});
  return keys;
}

bool is_side_alone(const targets::Node& drive) {
  if (!drive.optional("side")) return false;
  for (const targets::Key& key : drive_keys().keys())
    if (key.name != "side" && (drive.optional(key.name) || drive.optional(key.old_name))) return false;
  return true;
}

model::Drive read_plates(const targets::Node& node, const model::Lattice& structure) {
  const targets::KeyTable keys = drive_keys().only("plates");
  const targets::Section section(node, keys);
  model::Plates drive;
  section.read("axis", drive.axis, axes);
  section.read_needed("compression", "a number above 0 and below 1", drive.compression);
  section.read("branch", drive.branch, signs);
  section.read("push_only", drive.press);
  if (const auto grip = section.optional("grip")) drive.grip = read_grip(*grip, drive.axis, structure);
  return drive;
}

model::Drive read_hinge(const targets::Node& node, const model::Lattice& structure) {
  const targets::KeyTable keys = drive_keys().only("hinge");
  const targets::Section section(node, keys);
  model::HingeTurn drive;
  drive.hinge = WallReader(structure).hinge_of(section);
  section.read_needed("angle_deg", turn.describe(), drive.angle);
  return drive;
}

std::vector<int> read_walls(const targets::Node& node, const model::Lattice& structure) {
  const WallReader walls(structure);
  std::vector<int> hinges;
  for (const targets::Node& wall : node.list("a list of walls")) hinges.push_back(walls.hinge_of(wall));
  if (hinges.empty()) throw node.error("the list has no wall. Give at least one");
  return hinges;
}

model::Drive read_cord(const targets::Node& node, const model::Lattice& structure) {
  const targets::KeyTable keys = drive_keys().only("cord");
  const targets::Section section(node, keys);
  model::CordPull drive;
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

model::Drive read_shape_memory(const targets::Node& node, const model::Lattice& structure) {
  const targets::KeyTable keys = drive_keys().only("shape_memory");
  const targets::Section section(node, keys);
  model::ShapeMemory drive;
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

using DriveReader = model::Drive (*)(const targets::Node& node, const model::Lattice& structure);
constexpr targets::Word<DriveReader> readers[] = {
    {"plates", read_plates}, {"hinge", read_hinge}, {"cord", read_cord}, {"shape_memory", read_shape_memory}};

std::string walls_text(const model::Lattice& structure, const std::vector<int>& hinges) {
  std::string text;
  for (const int h : hinges) text += (text.empty() ? "" : ", ") + wall_name(structure, h);
  return "[" + text + "]";
}

std::string branch_text(const std::optional<int>& branch) {
  return branch ? fmt::format(", branch: {}", *branch) : "";
}

/// Formatter of the keys of a drive, its kind first.
struct DriveText {
  const model::Lattice& structure;

  std::string operator()(const model::Plates& plates) const {
    return fmt::format("kind: plates, axis: {}, compression: {}{}{}{}", to_string(plates.axis),
                       targets::shortest_text(plates.compression), branch_text(plates.branch),
                       plates.grip ? ", grip: " + to_string(*plates.grip) : "",
                       plates.press ? ", " + press_key().written_name() + ": true" : "");
  }

  std::string operator()(const model::HingeTurn& turn) const {
    return fmt::format("kind: hinge, wall: {}, angle_deg: {}", wall_name(structure, turn.hinge),
                       targets::degrees_text(turn.angle));
  }

  std::string operator()(const model::CordPull& cord) const {
    return fmt::format("kind: cord, through: {}, shorten_mm: {}{}", walls_text(structure, cord.through),
                       targets::shortest_text(cord.shorten_mm), branch_text(cord.branch));
  }

  std::string operator()(const model::ShapeMemory& hot) const {
    return fmt::format("kind: shape_memory, angle_deg: {}, k_turn: {}{}", targets::degrees_text(hot.angle),
                       targets::shortest_text(hot.k_turn),
                       hot.springs.empty() ? "" : ", walls: " + walls_text(structure, hot.springs));
  }

  std::string operator()(const model::BodyPull&) const { return ""; }  // bodies_text() writes it
};

struct DriveDescription {
  const char* operator()(const model::Plates& plates) const {
    return plates.press ? "two plates that press" : "two plates";
  }
  const char* operator()(const model::HingeTurn&) const {
    return "one hinge that is turned, its force at a lever of a cell edge";
  }
  const char* operator()(const model::CordPull&) const { return "a tendon that is pulled"; }
  const char* operator()(const model::ShapeMemory&) const { return "springs of shape memory"; }
  const char* operator()(const model::BodyPull&) const { return "bodies that are pulled"; }
};

}  // namespace

targets::Key press_key() {
  return targets::Key("push_only", value::boolean(), targets::by_default("false"),
                      "`true`: plates push the vertices of their rows and do not hold them. Vertices may "
                      "leave their plate. Needs elastic hinges (`--model equilibrium`, or a simulation of "
                      "them)",
                      "plates")
      .formerly("press");
}

targets::Key drive_key() {
  return {"drive", value::either({value::map(drive_keys()), value::map(side_only_keys())}),
          targets::otherwise("to `design.fold_angle_deg`"),
          "actuation of the structure. `side` may be its only key"};
}

std::optional<model::Drive> read_drive_section(const targets::Section& root,
                                               const model::Lattice& structure) {
  const auto node = root.optional("drive");
  if (!node) return std::nullopt;
  if (is_side_alone(*node)) {
    targets::Section(*node, side_only_keys());
    return std::nullopt;
  }
  return read_word(node->required("kind", "plates, hinge, cord or shape_memory"), readers)(*node, structure);
}

std::string drive_text(const model::Lattice& structure, const std::optional<model::Drive>& drive, int side) {
  std::string keys = drive ? std::visit(DriveText{structure}, *drive) : "";
  if (side != 1) keys += fmt::format("{}side: {}", keys.empty() ? "" : ", ", side);
  return keys.empty() ? "" : "drive: {" + keys + "}\n";
}

const char* describe(const model::Drive& drive) { return std::visit(DriveDescription{}, drive); }

int read_side(const targets::Section& root) {
  const auto drive = root.optional("drive");
  const auto side = drive ? drive->optional("side") : std::nullopt;
  return side ? read_word(*side, signs) : 1;
}

}  // namespace kinetix::app
