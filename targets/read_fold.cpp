#include "targets/read_fold.hpp"

#include <algorithm>

namespace kinetix {
namespace {

constexpr const char* wanted_shape = "`box: [a, b, c]` or `net: {faces: [...], creases: [...]}`";
constexpr std::size_t longest_face_name = 40;
constexpr int max_faces = 100;

std::vector<std::string_view> as_views(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

FoldGoal read_box(const Node& target, const Node& box, int columns) {
  target.reject_unknown_keys({"kind", "box", "open", "crease_columns"});
  const auto sides = box.list_of(3, "[a, b, c], edge lengths in cells");
  std::array<int, 3> edges;
  for (int k = 0; k < 3; ++k) edges[k] = sides[k].integer(1, max_face_side);
  const auto open = target.optional("open");
  const auto face =
      open ? std::optional(static_cast<int>(open->one_of(as_views(box_face_names())))) : std::nullopt;
  return box.located([&] { return box_goal(edges, face, columns); });
}

FoldFace read_face(const Node& node) {
  node.reject_unknown_keys({"name", "cells"});
  const Node name = node.required("name", "a name that creases refer to");
  FoldFace face{name.text("a name that creases refer to")};
  if (face.name.size() > longest_face_name) throw name.error("is too long; at most 40 bytes");
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
      throw entry.required("name", "").error("is the name of a face above; give each face its own");
  }
  if (faces.empty()) throw node.error("is empty; give at least one face {name: base, cells: [4, 4]}");
  if (faces.size() > max_faces) throw node.error("holds more than 100 faces");
  return faces;
}

FoldCrease read_crease(const Node& node, const std::vector<std::string_view>& names, int columns) {
  node.reject_unknown_keys({"faces", "side", "angle_deg", "shift", "columns"});
  const auto pair =
      node.required("faces", "[first, second], names of two faces").list_of(2, "[first, second]");
  FoldCrease crease;
  crease.first = static_cast<int>(pair[0].one_of(names));
  crease.second = static_cast<int>(pair[1].one_of(names));
  if (crease.first == crease.second) throw pair[1].error("joins a face with itself; name two faces");
  crease.side =
      node.required("side", "the side of the first face: left, right, bottom or top")
          .choice<Side>(
              {{"left", Side::left}, {"right", Side::right}, {"bottom", Side::bottom}, {"top", Side::top}});
  crease.angle = node.required("angle_deg", "the angle to fold by").angle(from_to(-180, 180, "degrees"));
  if (const auto shift = node.optional("shift")) crease.shift = shift->integer(-max_face_side, max_face_side);
  crease.columns = columns;
  if (const auto own = node.optional("columns")) crease.columns = own->integer(1, max_crease_columns);
  return crease;
}

FoldGoal read_net(const Node& target, const Node& node, int columns) {
  target.reject_unknown_keys({"kind", "net", "crease_columns"});
  node.reject_unknown_keys({"faces", "creases"});
  FoldNet net;
  net.faces = read_faces(node.required("faces", "a list of faces {name: base, cells: [4, 4]}"));
  std::vector<std::string_view> names;
  for (const FoldFace& face : net.faces) names.push_back(face.name);
  constexpr const char* wanted = "a list of creases {faces: [base, flap], side: top, angle_deg: 90}";
  for (const Node& entry : node.required("creases", wanted).list(wanted))
    net.creases.push_back(read_crease(entry, names, columns));
  return node.located([&] { return net_goal(std::move(net)); });
}

}  // namespace

FoldGoal read_fold(const Node& target) {
  target.reject_unknown_keys({"kind", "box", "open", "net", "crease_columns"});
  const auto box = target.optional("box"), net = target.optional("net");
  if (!box && !net) throw target.error(std::string("says nothing to fold; give ") + wanted_shape);
  if (box && net) throw target.error(std::string("gives both a box and a net; give only ") + wanted_shape);
  const auto key = target.optional("crease_columns");
  const int columns = key ? key->integer(1, max_crease_columns) : 0;
  return box ? read_box(target, *box, columns) : read_net(target, *net, columns);
}

}  // namespace kinetix
