#include "targets/fold/fold_goal.hpp"

#include "targets/fold/solid.hpp"

namespace kinetix::targets {
namespace {

// End of messages about a target with no shape, or with two.
constexpr const char* wanted_shape =
    "`box: [a, b, c]`, `box_mm: [a, b, c]`, `net: {faces: [...], creases: [...]}` or `solid: icosahedron`";
constexpr std::size_t longest_face_name = 40;         // bytes: names stand in messages and in the report
constexpr int max_box_cells = 4000;                   // of all faces: searched in a minute or two
const Bounds box_edge_mm = from_to(1, 10'000, "mm");  // mm: what a printer can make, and ten metres
constexpr int max_faces = 100;  // in a net: a limit so that a wrong file is refused at once

std::vector<std::string_view> as_views(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

// Words of the key `side` of a crease.
constexpr Word<Side> side_choices[] = {
    {"left", Side::left}, {"right", Side::right}, {"bottom", Side::bottom}, {"top", Side::top}};

const KeyTable& face_keys() {
  static const KeyTable keys({
      {"name", value::text("at most 40 bytes"), needed, "name of the face in creases"},
      {"cells", value::list(value::integer(1, max_face_side), "`[columns, rows]`", 2, 2), needed,
       "size of the face"},
  });
  return keys;
}

const KeyTable& crease_keys() {
  static const KeyTable keys({
      {"faces", value::list(value::text("name of a face"), "`[first, second]`, names of two faces", 2, 2),
       needed, "the faces that the crease joins"},
      {"side", value::choice(side_choices), needed,
       "side of the first face, beyond which the second one lies"},
      {"angle_deg", &FoldCrease::angle, value::angle(from_to(-180, 180, "degrees")),
       needed_as("the angle to fold by"), "fold angle of the crease, positive towards +z"},
      {"shift", &FoldCrease::shift, value::integer(-max_face_side, max_face_side),
       "cells by which the second face is moved along the crease"},
      {"columns", &FoldCrease::columns, value::integer(1, max_crease_columns),
       otherwise("`target.crease_columns`"), "columns of cells that the crease bends over"},
  });
  return keys;
}

KeyTable net_keys() {
  return KeyTable({
      {"faces", value::list(value::map(face_keys()), "a list of faces", 1, max_faces), needed,
       "rectangles of cells"},
      {"creases", value::list(value::map(crease_keys()), "a list of creases", 0), needed,
       "creases between the faces, as a tree"},
  });
}

std::optional<int> read_open_face(const Section& target) {
  const auto open = target.optional("open");
  if (!open) return std::nullopt;
  return static_cast<int>(open->one_of(as_views(box_face_names())));
}

/// Refuses boxes of thousands of cells: their lengths are probably in mm.
void check_cells(const Node& box, const std::array<int, 3>& e) {
  const int cells = 2 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]);
  const auto text = [&](const char* between) {
    return std::to_string(e[0]) + between + std::to_string(e[1]) + between + std::to_string(e[2]);
  };
  if (cells > max_box_cells)
    throw box.error("a box of " + text(" x ") + " cells has " + std::to_string(cells) +
                    " cells, more than the " + std::to_string(max_box_cells) +
                    " for a search. For mm give box_mm: [" + text(", ") + "]");
}

FoldGoal read_box(const Section& target, const Node& box, int columns) {
  target.node().reject_unknown_keys(fold_target_keys().only("box").names());
  const auto sides = box.list_of(3, "[a, b, c], edge lengths in cells");
  std::array<int, 3> edges;
  for (int k = 0; k < 3; ++k) edges[k] = sides[k].integer(1, max_face_side);
  check_cells(box, edges);
  const auto face = read_open_face(target);
  return box.located([&] { return box_goal(edges, face, columns); });
}

FoldGoal read_box_mm(const Section& target, const Node& box, int columns) {
  target.node().reject_unknown_keys(fold_target_keys().only("box_mm").names());
  const auto sides = box.list_of(3, "[a, b, c], edge lengths in mm");
  std::array<double, 3> edges_mm;
  for (int k = 0; k < 3; ++k) edges_mm[k] = sides[k].number(box_edge_mm);
  FoldGoal goal = box_goal({1, 1, 1}, read_open_face(target), columns);
  goal.box_mm = edges_mm;
  return goal;
}

FoldFace read_face(const Node& entry) {
  const Section node(entry, face_keys());
  const Node name = node.required("name", "a name that creases refer to");
  FoldFace face{name.text("a name that creases refer to")};
  if (face.name.size() > longest_face_name) throw name.error("the name is too long. Give at most 40 bytes");
  const auto sides = node.required("cells", "[columns, rows]").list_of(2, "[columns, rows]");
  face.width = sides[0].integer(1, max_face_side);
  face.height = sides[1].integer(1, max_face_side);
  return face;
}

std::vector<FoldFace> read_faces(const Node& node) {
  std::vector<FoldFace> faces;
  for (const Node& entry : node.list("a list of faces {name: base, cells: [4, 4]}")) {
    faces.push_back(read_face(entry));
    const auto same = [&](const FoldFace& face) { return face.name == faces.back().name; };
    if (std::any_of(faces.begin(), faces.end() - 1, same))
      throw entry.optional("name")->error("a face above has this name. Give each face a separate name");
  }
  if (faces.empty())
    throw node.error("the list is empty. Give at least one face {name: base, cells: [4, 4]}");
  if (faces.size() > max_faces) throw node.error("holds more than 100 faces");
  return faces;
}

FoldCrease read_crease(const Node& entry, const std::vector<std::string_view>& names, int columns) {
  const Section node(entry, crease_keys());
  const auto pair =
      node.required("faces", "[first, second], names of two faces").list_of(2, "[first, second]");
  FoldCrease crease;
  crease.first = static_cast<int>(pair[0].one_of(names));
  crease.second = static_cast<int>(pair[1].one_of(names));
  if (crease.first == crease.second)
    throw pair[1].error("the crease joins a face with itself. Give two faces");
  node.read_needed("side", "the side of the first face: left, right, bottom or top", crease.side,
                   side_choices);
  crease.columns = columns;
  node.read_into(crease);
  return crease;
}

FoldGoal read_net(const Section& target, int columns) {
  target.node().reject_unknown_keys(fold_target_keys().only("net").names());
  const Section node = target.section("net");
  FoldNet net;
  net.faces = read_faces(node.required("faces", "a list of faces {name: base, cells: [4, 4]}"));
  std::vector<std::string_view> names;
  for (const FoldFace& face : net.faces) names.push_back(face.name);
  constexpr const char* wanted = "a list of creases {faces: [base, flap], side: top, angle_deg: 90}";
  for (const Node& entry : node.required("creases", wanted).list(wanted))
    net.creases.push_back(read_crease(entry, names, columns));
  return node.node().located([&] { return net_goal(std::move(net)); });
}

// Least cells per half side: with one, a single hinge would join two faces, and each would move by itself.
constexpr int min_solid_cells = 2;

/// Reads a name or a file of a solid.
SolidGoal read_shape(const Node& solid, const MeshReader& read) {
  const std::string text = solid.text("the name of a solid, or the path of a file of one");
  if (text.find('.') == std::string::npos) {
    const auto k = static_cast<int>(solid.one_of(as_views(solid_names())));
    return {solid_names()[k], named_solid(k)};
  }
  const FileMesh file = read_mesh_at(solid, read);
  return {text, solid.located([&] { return solid_of(file.mesh); })};
}

FoldGoal read_solid(const Section& target, const Node& solid, int columns, const MeshReader& read) {
  target.node().reject_unknown_keys(fold_target_keys().only("solid").names());
  FoldGoal goal;
  goal.solid = read_shape(solid, read);
  goal.solid->columns = columns;
  target.read("cells", goal.solid->cells);
  return goal;
}

}  // namespace

const KeyTable& fold_target_keys() {
  static const KeyTable keys(
      {
          goal_kind_key("fold"),
          {"box", value::list(value::integer(1, max_face_side), "`[a, b, c]`, cells", 3, 3), no_default,
           "edge lengths along x, y and z: the bottom has a x b cells. Every unfolding of it is tried"},
          {"box_mm", value::list(value::number(box_edge_mm), "`[a, b, c]`, mm", 3, 3), no_default,
           "edge lengths in mm along x, y and z of the folded box. The number of cells, and their size "
           "without `structure.cell_mm`, follow from them"},
          {"open",
           value::choice(box_face_names()),
           otherwise("the box is closed"),
           "face that is omitted",
           {"box", "box_mm"}},
          {"net", net_keys(), "faces that lie side by side, joined by creases"},
          {"solid",
           value::either(
               {value::choice(solid_names()), value::text("path of an OBJ, OFF, FOLD or other mesh file")}),
           no_default,
           "a convex solid, cut open into one sheet whose creases run in as many directions as its edges. A "
           "file may "
           "have up to 60 corners, and edges up to 4 times as long as the shortest"},
          {"cells", value::integer(min_solid_cells, max_solid_cells), by_default(SolidGoal().cells),
           "cells along half a side of a face", "solid"},
          {"crease_columns", value::integer(1, max_crease_columns), otherwise("the search chooses"),
           "columns of cells that every crease bends over"},
      },
      {{"box", "box_mm", "net", "solid"}});
  return keys;
}

FoldGoal read_fold(const Node& node, const MeshReader& read) {
  const Section target(node, fold_target_keys());
  const auto box = target.optional("box"), box_mm = target.optional("box_mm"), net = target.optional("net"),
             solid = target.optional("solid");
  if (!box && !box_mm && !net && !solid)
    throw target.error(std::string("the shape is missing. Give ") + wanted_shape);
  if (box.has_value() + box_mm.has_value() + net.has_value() + solid.has_value() > 1)
    throw target.error(std::string("the target has more than one shape. Give only ") + wanted_shape);
  int columns = 0;
  target.read("crease_columns", columns);
  if (solid) return read_solid(target, *solid, columns, read);
  if (box_mm) return read_box_mm(target, *box_mm, columns);
  return box ? read_box(target, *box, columns) : read_net(target, columns);
}

}  // namespace kinetix::targets
