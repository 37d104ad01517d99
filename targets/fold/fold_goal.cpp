#include "targets/fold/fold_goal.hpp"

#include <bit>
#include <map>
#include <tuple>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"
#include "targets/fold/fold_error.hpp"

namespace kinetix::targets {
namespace {

using Direction = Eigen::Vector3i;

/// A face as it lies in the net: where its lattice directions point in the box, n = u x v to the inside.
struct Frame {
  Direction u, v, n;
};

Direction cross(const Direction& a, const Direction& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

// Unit vectors into the box, in the order of box_face_names: from the bottom up, from the top down, ...
constexpr std::array<std::array<int, 3>, 6> inward_normals = {
    {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}}};

Direction inward(int face) {
  return {inward_normals[face][0], inward_normals[face][1], inward_normals[face][2]};
}

int face_of(const Direction& n) {
  int face = 0;
  while (inward(face) != n) ++face;
  return face;
}

Frame frame_of(int face) {
  const Direction n = inward(face), u = n.x() == 0 ? Direction(1, 0, 0) : Direction(0, 1, 0);
  return {u, cross(n, u), n};
}

/// Returns the frame of the neighbour on a side: rolled over the edge by 90 degrees.
Frame rolled(const Frame& f, Side side) {
  switch (side) {
    case Side::right:
      return {f.n, f.v, -f.u};
    case Side::left:
      return {-f.n, f.v, f.u};
    case Side::top:
      return {f.u, f.n, -f.v};
    case Side::bottom:
      break;
  }
  return {f.u, -f.n, f.v};
}

int extent(const std::array<int, 3>& edges, const Direction& d) {
  return d.x() != 0 ? edges[0] : d.y() != 0 ? edges[1] : edges[2];
}

using Pair = std::pair<int, int>;

std::vector<Pair> edges_between(const std::vector<int>& faces) {
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a + 1; b < faces.size(); ++b)
      if (inward(faces[a]) != -inward(faces[b])) pairs.emplace_back(faces[a], faces[b]);
  return pairs;
}

/// Unrolling of the box over the edges of a tree. It has fewer faces than the box if the edges form no tree.
class Unrolling {
 public:
  Unrolling(const std::array<int, 3>& edges, const std::vector<Pair>& tree, int root)
      : edges_(edges), tree_(tree) {
    add(root, frame_of(root));
    for (std::size_t k = 0; k < frames_.size(); ++k) roll_from(static_cast<int>(k));
  }

  const FoldNet& net() const { return net_; }

 private:
  void add(int face, const Frame& frame) {
    index_[face] = static_cast<int>(frames_.size());
    frames_.push_back(frame);
    faces_.push_back(face);
    net_.faces.push_back({box_face_names()[face], extent(edges_, frame.u), extent(edges_, frame.v)});
  }

  void roll_from(int k) {
    for (const Side side : {Side::bottom, Side::right, Side::top, Side::left}) {
      const Frame next = rolled(frames_[k], side);
      const int face = face_of(next.n);
      const Pair edge = std::minmax(faces_[k], face);
      if (index_.contains(face) || std::find(tree_.begin(), tree_.end(), edge) == tree_.end()) continue;
      net_.creases.push_back({k, static_cast<int>(frames_.size()), side, pi / 2});
      add(face, next);
    }
  }

  const std::array<int, 3>& edges_;
  const std::vector<Pair>& tree_;
  std::vector<Frame> frames_;
  std::vector<int> faces_;
  std::map<int, int> index_;
  FoldNet net_;
};

using Rectangles = std::vector<model::CellRectangle>;

/// A net as it lies flat, with a gap of one cell between faces.
struct FlatNet {
  Rectangles faces;
  Rectangles creases;  ///< the gaps
  auto operator<=>(const FlatNet&) const = default;
};

FlatNet flat(const FoldNet& net) {
  FlatNet out;
  for (const FoldFace& face : net.faces) out.faces.push_back({{}, face.width, face.height});
  for (const FoldCrease& c : net.creases) {
    out.faces[c.second] = out.faces[c.second].beside(out.faces[c.first], c.side, 1);
    out.creases.push_back(gap_between(out.faces[c.first], c.side, out.faces[c.second]));
  }
  return out;
}

/// Returns the net with each of its rectangles moved by the same motion, sorted.
template <class Motion>
FlatNet moved(FlatNet net, const Motion& motion) {
  for (Rectangles* rectangles : {&net.faces, &net.creases}) {
    for (model::CellRectangle& r : *rectangles) r = motion(r);
    std::sort(rectangles->begin(), rectangles->end());
  }
  return net;
}

FlatNet at_origin(const FlatNet& net) {
  const model::Cell lowest = bounds(net.faces).low;
  return moved(net, [&](const model::CellRectangle& r) { return r.seen_from(lowest); });
}

/// Returns a net that is equal for congruent nets: the least of all turned and mirrored ones, at the origin.
FlatNet canonical(FlatNet net) {
  FlatNet least = at_origin(net);
  for (int k = 1; k < 8; ++k) {
    net = moved(net, [&](const model::CellRectangle& r) { return k == 4 ? r.mirrored() : r.turned(); });
    least = std::min(least, at_origin(net));
  }
  return least;
}

bool overlaps(const FlatNet& net) {
  for (std::size_t a = 0; a < net.faces.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (touch(net.faces[a], net.faces[b])) return true;
  return false;
}

/// Largest number of folds between two faces.
int folds_apart(const FoldNet& net) {
  const std::size_t n = net.faces.size();
  std::vector<std::vector<int>> d(n, std::vector<int>(n, static_cast<int>(n)));
  for (std::size_t k = 0; k < n; ++k) d[k][k] = 0;
  for (const FoldCrease& c : net.creases) d[c.first][c.second] = d[c.second][c.first] = 1;
  int most = 0;
  for (std::size_t m = 0; m < n; ++m)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) d[a][b] = std::min(d[a][b], d[a][m] + d[m][b]);
  for (const auto& row : d) most = std::max(most, *std::max_element(row.begin(), row.end()));
  return most;
}

}  // namespace

const std::vector<std::string>& box_face_names() {
  static const std::vector<std::string> names = {"bottom", "top", "front", "back", "left", "right"};
  return names;
}

int box_face_axis(int face) {
  const Direction n = inward(face);
  return n.x() != 0 ? 0 : n.y() != 0 ? 1 : 2;
}

std::vector<FoldNet> box_unfoldings(const std::array<int, 3>& edges, std::optional<int> open) {
  std::vector<int> faces;
  for (int f = 0; f < 6; ++f)
    if (f != open) faces.push_back(f);
  const std::vector<Pair> pairs = edges_between(faces);
  using Score = std::tuple<int, int, int, unsigned>;
  std::map<FlatNet, std::pair<Score, FoldNet>> found;
  for (unsigned chosen = 0; chosen < 1u << pairs.size(); ++chosen) {
    if (std::popcount(chosen) != static_cast<int>(faces.size()) - 1) continue;
    std::vector<Pair> tree;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (chosen >> k & 1) tree.push_back(pairs[k]);
    FoldNet net = Unrolling(edges, tree, faces[0]).net();
    if (net.faces.size() != faces.size()) continue;
    const FlatNet lying = flat(net);
    if (overlaps(lying)) continue;
    const model::CellRectangle whole = bounds(lying.faces);
    const Score score = {folds_apart(net), whole.width * whole.height, std::max(whole.width, whole.height),
                         chosen};
    const auto [it, is_new] = found.try_emplace(canonical(lying), score, net);
    if (!is_new && score < it->second.first) it->second = {score, std::move(net)};
  }
  std::vector<std::pair<Score, FoldNet>> sorted;
  for (auto& entry : found) sorted.push_back(std::move(entry.second));
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<FoldNet> nets;
  for (auto& entry : sorted) nets.push_back(std::move(entry.second));
  return nets;
}

FoldGoal box_goal(const std::array<int, 3>& edges, std::optional<int> open, int columns) {
  for (const int edge : edges)
    if (edge < 1 || edge > max_face_side)
      throw InvalidInput("an edge of the box is " + std::to_string(edge) + " cells long. Give 1 to " +
                         std::to_string(max_face_side));
  FoldGoal goal{edges, {}, open, box_unfoldings(edges, open)};
  for (FoldNet& net : goal.nets)
    for (FoldCrease& crease : net.creases) crease.columns = columns;
  return goal;
}

FoldGoal net_goal(FoldNet net) {
  validate(net);
  std::vector<int> columns;
  for (const FoldCrease& crease : net.creases) columns.push_back(std::max(crease.columns, 1));
  const int open = open_crease(net, lay_out(net, columns));
  if (open >= 0)
    throw InvalidInput("the ring of faces with crease " + in_ticks(crease_name(net, net.creases[open])) +
                       " does not close when it folds. Give creases in one line the same angle");
  return {{}, {}, {}, {std::move(net)}};
}

}  // namespace kinetix::targets
