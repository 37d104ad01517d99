#include "targets/fold/net_layout.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

constexpr int unplaced = -1;  // instead of the crease by which a face was placed: none has this index

/// Lays the faces out; knows by which crease each one was reached.
class Placing {
 public:
  Placing(const FoldNet& net, const std::vector<int>& columns)
      : net_(net), columns_(columns), faces_(net.faces.size()), by_(net.faces.size(), unplaced) {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      faces_[f] = {0, 0, net.faces[f].width, net.faces[f].height};
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

  std::vector<PlacedFace>& faces() { return faces_; }

  /// The creases on the way from a face to the first one.
  std::vector<int> way_back(int face) const {
    std::vector<int> way;
    while (by_[face] != unplaced) {
      way.push_back(by_[face]);
      const FoldCrease& c = net_.creases[by_[face]];
      face = c.first == face ? c.second : c.first;
    }
    return way;
  }

  bool joins_tree(int crease) const { return std::find(by_.begin(), by_.end(), crease) != by_.end(); }

  /// Corner of the second face of a crease, given the first, or the other way round.
  std::array<int, 2> corner_beyond(int crease, int next) const {
    const FoldCrease& c = net_.creases[crease];
    const bool forward = next == c.second;
    const PlacedFace& from = faces_[forward ? c.first : c.second];
    const PlacedFace& to = faces_[next];
    const int shift = forward ? c.shift : -c.shift, gap = columns_[crease];
    switch (forward ? c.side : opposite(c.side)) {
      case Side::left:
        return {from.i - gap - to.width, from.j + shift};
      case Side::right:
        return {from.i + from.width + gap, from.j + shift};
      case Side::bottom:
        return {from.i + shift, from.j - gap - to.height};
      case Side::top:
        break;
    }
    return {from.i + shift, from.j + from.height + gap};
  }

 private:
  void place(int crease, int next) {
    by_[next] = crease;
    const auto [i, j] = corner_beyond(crease, next);
    faces_[next].i = i;
    faces_[next].j = j;
  }

  const FoldNet& net_;
  const std::vector<int>& columns_;
  std::vector<PlacedFace> faces_;
  std::vector<int> by_;  // crease by which a face was reached
};

std::string named(const FoldNet& net, int crease) {
  return "crease " + in_ticks(crease_name(net, net.creases[crease]));
}

/// A crease that closes a ring: its faces must be beside each other as they lie, and the ring may fold in one
/// direction only.
void check_ring(const FoldNet& net, const Placing& placing, const std::vector<PlacedFace>& faces,
                int crease) {
  const FoldCrease& c = net.creases[crease];
  const auto [i, j] = placing.corner_beyond(crease, c.second);
  if (faces[c.second].i != i || faces[c.second].j != j)
    throw InvalidInput(named(net, crease) + ": as the other creases lay them out, face " +
                       in_ticks(net.faces[c.second].name) + " is no neighbour of face " +
                       in_ticks(net.faces[c.first].name) + " on its " + to_string(c.side) +
                       "; leave the crease out or place the faces otherwise");
  std::vector<int> ring = placing.way_back(c.first), other = placing.way_back(c.second);
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
                       ": such a ring cannot move; cut it at one of its creases");
}

PlacedCrease crease_between(const FoldNet& net, const std::vector<PlacedFace>& faces, int crease,
                            int columns) {
  const FoldCrease& c = net.creases[crease];
  const bool forward = c.side == Side::right || c.side == Side::top;
  const PlacedFace& low = faces[forward ? c.first : c.second];
  const PlacedFace& high = faces[forward ? c.second : c.first];
  PlacedCrease out{across(c.side), 0, 0, columns, 0};
  if (out.axis == model::Axis::x) {
    out.i = low.i + low.width;
    out.j = std::max(low.j, high.j);
    out.length = std::min(low.j + low.height, high.j + high.height) - out.j;
  } else {
    out.i = std::max(low.i, high.i);
    out.j = low.j + low.height;
    out.length = std::min(low.i + low.width, high.i + high.width) - out.i;
  }
  if (out.length < 1)
    throw InvalidInput(named(net, crease) + ": shifted by " + std::to_string(c.shift) +
                       " cells the faces are no neighbours; no cell of one lies beside the other");
  return out;
}

int cells_along_x(const PlacedCrease& c) { return c.axis == model::Axis::x ? c.columns : c.length; }
int cells_along_y(const PlacedCrease& c) { return c.axis == model::Axis::x ? c.length : c.columns; }

/// Who has a cell, or a vertex.
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
                     "; each needs its own place in the flat net");
}

template <class Key>
class Ownership {
 public:
  void claim(const Key& key, const Owner& owner) {
    const auto [it, is_new] = owners_.try_emplace(key, owner);
    if (!is_new) refuse_overlap(it->second, owner, to_string(key));
  }
  const std::map<Key, Owner>& all() const { return owners_; }

 private:
  std::map<Key, Owner> owners_;
};

Owner owner_of(const FoldNet& net, int crease) {
  const FoldCrease& c = net.creases[crease];
  return {named(net, crease), true, across(c.side), c.angle != 0};
}

std::vector<model::Cell> claimed_cells(const FoldNet& net, const NetLayout& layout) {
  Ownership<model::Cell> cells;
  for (std::size_t c = 0; c < layout.creases.size(); ++c) {
    const PlacedCrease& crease = layout.creases[c];
    for (int i = 0; i < cells_along_x(crease); ++i)
      for (int j = 0; j < cells_along_y(crease); ++j)
        cells.claim({crease.i + i, crease.j + j}, owner_of(net, static_cast<int>(c)));
  }
  for (std::size_t f = 0; f < layout.faces.size(); ++f)
    for (int i = 0; i < layout.faces[f].width; ++i)
      for (int j = 0; j < layout.faces[f].height; ++j)
        cells.claim({layout.faces[f].i + i, layout.faces[f].j + j}, {"face " + in_ticks(net.faces[f].name)});
  std::vector<model::Cell> all;
  for (const auto& entry : cells.all()) all.push_back(entry.first);
  return all;
}

/// Faces and the bodies within creases are bodies of their own.
void check_vertices(const FoldNet& net, const NetLayout& layout) {
  Ownership<model::Vertex> vertices;
  for (std::size_t f = 0; f < layout.faces.size(); ++f)
    for (int i = 0; i <= layout.faces[f].width; ++i)
      for (int j = 0; j <= layout.faces[f].height; ++j)
        vertices.claim({layout.faces[f].i + i, layout.faces[f].j + j},
                       {"face " + in_ticks(net.faces[f].name)});
  for (std::size_t k = 0; k < layout.creases.size(); ++k) {
    const PlacedCrease& c = layout.creases[k];
    for (int n = 1; n < c.columns; ++n)
      for (int m = 0; m <= c.length; ++m)
        vertices.claim(
            c.axis == model::Axis::x ? model::Vertex{c.i + n, c.j + m} : model::Vertex{c.i + m, c.j + n},
            owner_of(net, static_cast<int>(k)));
  }
}

/// Moves the lowest cell to column and row 0.
void move_to_origin(NetLayout& layout) {
  int i = layout.faces[0].i, j = layout.faces[0].j;
  for (const PlacedFace& face : layout.faces) {
    i = std::min(i, face.i);
    j = std::min(j, face.j);
  }
  for (PlacedFace& face : layout.faces) {
    face.i -= i;
    face.j -= j;
  }
}

}  // namespace

NetLayout lay_out(const FoldNet& net, const std::vector<int>& columns) {
  Placing placing(net, columns);
  NetLayout layout;
  layout.faces = placing.faces();
  move_to_origin(layout);
  for (int c = 0; c < static_cast<int>(net.creases.size()); ++c) {
    if (!placing.joins_tree(c)) check_ring(net, placing, placing.faces(), c);
    layout.creases.push_back(crease_between(net, layout.faces, c, columns[c]));
  }
  layout.cells = claimed_cells(net, layout);
  check_vertices(net, layout);
  return layout;
}

std::vector<model::Wall> bending_walls(const PlacedCrease& crease) {
  std::vector<model::Wall> walls;
  for (int n = 0; n < crease.columns; ++n)
    for (int m = 0; m <= crease.length; ++m)
      walls.push_back(crease.axis == model::Axis::x
                          ? model::Wall{{crease.i + n, crease.j + m}, model::Axis::x}
                          : model::Wall{{crease.i + m, crease.j + n}, model::Axis::y});
  return walls;
}

int middle_body(const PlacedFace& face, const model::Structure& structure) {
  return *structure.body_at({face.i + face.width / 2, face.j + face.height / 2});
}

std::vector<int> face_bodies(const PlacedFace& face, const model::Structure& structure) {
  std::vector<int> bodies;
  for (int j = 0; j <= face.height; ++j)
    for (int i = 0; i <= face.width; ++i) bodies.push_back(*structure.body_at({face.i + i, face.j + j}));
  return bodies;
}

}  // namespace kinetix::targets
