#include "targets/fold/fold_net.hpp"

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "model/base/invalid_input.hpp"
#include "targets/document/number.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

void check_faces(const FoldNet& net) {
  if (net.faces.empty()) throw InvalidInput("the net has no faces. Give at least one");
  std::set<std::string> names;
  for (const FoldFace& face : net.faces) {
    if (std::min(face.width, face.height) < 1 || std::max(face.width, face.height) > max_face_side)
      throw InvalidInput("face " + in_ticks(face.name) + " has " + std::to_string(face.width) + " x " +
                         std::to_string(face.height) + " cells. Give 1 to " + std::to_string(max_face_side) +
                         " a side");
    if (!names.insert(face.name).second)
      throw InvalidInput("two faces are named " + in_ticks(face.name) + ". Give each its own name");
  }
}

void check_creases(const FoldNet& net) {
  std::set<std::pair<int, int>> pairs;
  for (const FoldCrease& crease : net.creases) {
    const std::string name = "crease " + in_ticks(crease_name(net, crease));
    if (crease.first == crease.second) throw InvalidInput(name + " joins a face with itself");
    if (!pairs.insert(std::minmax(crease.first, crease.second)).second)
      throw InvalidInput(name + " is listed twice. Give one crease for two faces");
    if (!(std::abs(crease.angle) <= pi))
      throw InvalidInput(name + " turns by " + shortest_text(to_degrees(crease.angle)) +
                         " degrees. Give -180 to 180");
  }
}

/// Returns which faces are connected to the first one.
std::vector<bool> reached(const FoldNet& net) {
  std::vector<bool> in(net.faces.size(), false);
  in[0] = true;
  for (std::size_t round = 1; round < net.faces.size(); ++round)
    for (const FoldCrease& c : net.creases)
      if (in[c.first] || in[c.second]) in[c.first] = in[c.second] = true;
  return in;
}

}  // namespace

std::string crease_name(const FoldNet& net, const FoldCrease& crease) {
  return net.faces[crease.first].name + "-" + net.faces[crease.second].name;
}

void validate(const FoldNet& net) {
  check_faces(net);
  check_creases(net);
  const std::vector<bool> in = reached(net);
  const auto loose = std::find(in.begin(), in.end(), false);
  if (loose != in.end())
    throw InvalidInput("face " + in_ticks(net.faces[loose - in.begin()].name) + " is joined to face " +
                       in_ticks(net.faces[0].name) + " by no creases. Connect all faces");
}

namespace {

constexpr int unplaced = -1;  // instead of the crease by which a face was placed: none has this index

/// Lays the faces out; knows by which crease each one was reached.
class Placing {
 public:
  Placing(const FoldNet& net, const std::vector<int>& columns)
      : net_(net), columns_(columns), faces_(net.faces.size()), by_(net.faces.size(), unplaced) {
    for (std::size_t f = 0; f < faces_.size(); ++f) faces_[f] = {{}, net.faces[f].width, net.faces[f].height};
    std::vector<bool> placed(faces_.size(), false);
    placed[0] = true;
    for (std::size_t round = 1; round < faces_.size(); ++round)
      for (std::size_t c = 0; c < net.creases.size(); ++c) {
        const auto [first, second] = std::pair(net.creases[c].first, net.creases[c].second);
        if (placed[first] == placed[second]) continue;
        const int next = placed[first] ? second : first;
        place(static_cast<int>(c), next);
        placed[next] = true;
      }
  }

  std::vector<model::CellRectangle>& faces() { return faces_; }

  /// Returns the creases on the path from a face to the first one.
  std::vector<int> path_to_root(int face) const {
    std::vector<int> path;
    while (by_[face] != unplaced) {
      path.push_back(by_[face]);
      const FoldCrease& c = net_.creases[by_[face]];
      face = c.first == face ? c.second : c.first;
    }
    return path;
  }

  bool joins_tree(int crease) const { return std::find(by_.begin(), by_.end(), crease) != by_.end(); }

  /// Returns the place of face `next` beyond a crease, from that of the crease's other face.
  model::CellRectangle beyond(int crease, int next) const {
    const FoldCrease& c = net_.creases[crease];
    if (next == c.second) return faces_[next].beside(faces_[c.first], c.side, columns_[crease], c.shift);
    return faces_[next].beside(faces_[c.second], opposite(c.side), columns_[crease], -c.shift);
  }

 private:
  void place(int crease, int next) {
    by_[next] = crease;
    faces_[next] = beyond(crease, next);
  }

  const FoldNet& net_;
  const std::vector<int>& columns_;
  std::vector<model::CellRectangle> faces_;
  std::vector<int> by_;  // crease by which a face was reached
};

std::string named(const FoldNet& net, int crease) {
  return "crease " + in_ticks(crease_name(net, net.creases[crease]));
}

/// Checks a crease that closes a ring: its faces must be next to each other as placed, and the ring may fold in one
/// direction only.
void check_ring(const FoldNet& net, const Placing& placing, const std::vector<model::CellRectangle>& faces,
                int crease) {
  const FoldCrease& c = net.creases[crease];
  if (faces[c.second] != placing.beyond(crease, c.second))
    throw InvalidInput(named(net, crease) + ": as the other creases lay them out, face " +
                       in_ticks(net.faces[c.second].name) + " is not a neighbour of face " +
                       in_ticks(net.faces[c.first].name) + " on its " + to_string(c.side) +
                       ". Remove the crease, or move the faces");
  std::vector<int> ring = placing.path_to_root(c.first), other = placing.path_to_root(c.second);
  while (!ring.empty() && !other.empty() && ring.back() == other.back()) {
    ring.pop_back();
    other.pop_back();
  }
  ring.insert(ring.end(), other.begin(), other.end());
  ring.push_back(crease);
  std::optional<int> along_x, along_y;
  for (const int k : ring)
    if (net.creases[k].angle != 0) (across(net.creases[k].side) == model::Axis::x ? along_x : along_y) = k;
  if (along_x && along_y)
    throw InvalidInput("the ring of faces that " + named(net, crease) + " closes folds both ways, at " +
                       named(net, *along_x) + " and " + named(net, *along_y) +
                       ": such a ring cannot move. Cut it at one of its creases");
}

PlacedCrease crease_between(const FoldNet& net, const std::vector<model::CellRectangle>& faces, int crease) {
  const FoldCrease& c = net.creases[crease];
  const PlacedCrease out{across(c.side), gap_between(faces[c.first], c.side, faces[c.second])};
  if (out.cells.is_empty())
    throw InvalidInput(named(net, crease) + ": shifted by " + std::to_string(c.shift) +
                       " cells the faces are not neighbours. Change the offset");
  return out;
}

/// Owner of a cell or a vertex.
struct Owner {
  std::string name;
  bool is_crease = false;
  model::Axis axis = model::Axis::x;
  bool bends = false;
};

[[noreturn]] void refuse_overlap(const Owner& a, const Owner& b, const std::string& where) {
  if (a.bends && b.bends && a.axis != b.axis)
    throw InvalidInput(a.name + " and " + b.name + " would need cell " + where + " to bend both ways");
  throw InvalidInput(a.name + " and " + b.name + " overlap or touch flat at " + where +
                     ". Give each a separate place in the flat net");
}

/// Owners of places: cells, or vertices.
class Ownership {
 public:
  template <class Place>
  void claim(const std::vector<Place>& places, const Owner& owner) {
    for (const Place& place : places) {
      const std::string name = to_string(place);
      const auto [it, is_new] = owners_.try_emplace(name, owner);
      if (!is_new) refuse_overlap(it->second, owner, name);
    }
  }

 private:
  std::map<std::string, Owner> owners_;
};

Owner owner_of_face(const FoldNet& net, std::size_t face) {
  return {"face " + in_ticks(net.faces[face].name)};
}

Owner owner_of_crease(const FoldNet& net, std::size_t crease) {
  const FoldCrease& c = net.creases[crease];
  return {named(net, static_cast<int>(crease)), true, across(c.side), c.angle != 0};
}

std::vector<model::Cell> claimed_cells(const FoldNet& net, const NetLayout& layout) {
  Ownership owners;
  std::vector<model::Cell> all;
  const auto claim = [&](const model::CellRectangle& rectangle, const Owner& owner) {
    const std::vector<model::Cell> cells = rectangle.cells();
    owners.claim(cells, owner);
    all.insert(all.end(), cells.begin(), cells.end());
  };
  for (std::size_t c = 0; c < layout.creases.size(); ++c)
    claim(layout.creases[c].cells, owner_of_crease(net, c));
  for (std::size_t f = 0; f < layout.faces.size(); ++f) claim(layout.faces[f], owner_of_face(net, f));
  std::sort(all.begin(), all.end());
  return all;
}

/// Checks that faces and the bodies within creases share no vertices, since they are separate bodies.
void check_vertices(const FoldNet& net, const NetLayout& layout) {
  Ownership owners;
  for (std::size_t f = 0; f < layout.faces.size(); ++f)
    owners.claim(layout.faces[f].vertices(), owner_of_face(net, f));
  for (std::size_t c = 0; c < layout.creases.size(); ++c) {
    const PlacedCrease& crease = layout.creases[c];
    owners.claim(crease.cells.vertices_between_ends(crease.axis), owner_of_crease(net, c));
  }
}

/// Moves the lowest cell to column and row 0.
void move_to_origin(std::vector<model::CellRectangle>& faces) {
  const model::Cell lowest = bounds(faces).low;
  for (model::CellRectangle& face : faces) face = face.seen_from(lowest);
}

}  // namespace

NetLayout lay_out(const FoldNet& net, const std::vector<int>& columns) {
  Placing placing(net, columns);
  NetLayout layout;
  layout.faces = placing.faces();
  move_to_origin(layout.faces);
  for (int c = 0; c < static_cast<int>(net.creases.size()); ++c) {
    if (!placing.joins_tree(c)) check_ring(net, placing, placing.faces(), c);
    layout.creases.push_back(crease_between(net, layout.faces, c));
  }
  layout.cells = claimed_cells(net, layout);
  check_vertices(net, layout);
  return layout;
}

std::vector<model::Wall> bending_walls(const PlacedCrease& crease) {
  return crease.cells.walls_along(crease.axis);
}

}  // namespace kinetix::targets
