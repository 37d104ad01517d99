#include "model/lattice/planar/creased_motion.hpp"

#include <Eigen/LU>
#include <map>
#include <set>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/hinge/crease_law.hpp"
#include "model/lattice/planar/exact_designs.hpp"

namespace kinetix::model {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double same_lean = 1e-9;     // tangent of a tilt: files have angles of more digits
constexpr double on_its_line = 1e-10;  // cell edges: above the rounding of a line of thousands of walls
constexpr double leads_back = 1e-10;   // rad and cell edges, of a turn about the creases that meet in a face
// Cell edges: rows of plates that press with this clearance resist nothing
constexpr double straight_row = 1e-7;
constexpr double meets = 0.5;  // theta in rad at which messages state a deviation

/// Returns the turn of the far side of a crease about its line through a point.
Isometry3d turn_about(const Vector2d& line, const Vector3d& point, double theta) {
  const double c = line.norm();
  const Vector3d axis = Vector3d(line.x(), line.y(), 0) / c;
  const Eigen::AngleAxisd turn(-crease_turn(std::atan(c), theta), axis);
  return Eigen::Translation3d(point) * turn * Eigen::Translation3d(-point);
}

std::string wall(const PlanarStructure& s, int hinge) { return to_string(s.graph.edges[hinge]); }

std::string describe_lean_difference(const PlanarStructure& s, const PlanarCreases& creases) {
  for (const PlanarCrease& crease : creases.list)
    for (const int h : crease.hinges) {
      const double off = (line_of(s, creases, h) - crease.line).norm();
      if (off <= same_lean) continue;
      return "the hinges on walls " + wall(s, crease.hinges.front()) + " and " + wall(s, h) +
             " of one crease must lean by the same angle, with the sign of their sublattice: they differ "
             "by " +
             number_text(to_degrees(std::atan(off))) + " deg";
    }
  return {};
}

/// Returns the joint separation of a hinge off its line, cell edges. A crease that hardly folds hardly opens it, and
/// its lean gives the direction of its line only to the lean's own relative precision.
double opened(const CreaseOffset& left, const PlanarCrease& crease) {
  return left.worst() * std::min(1.0, crease.line.norm());
}

/// Describes the wall whose t changes most.
std::string nearest_t(const PlanarStructure& before) {
  const PlanarStructure after = nearest_exact(before);
  int most = 0, changed = 0;
  const bool is_on_wall = std::all_of(after.hinges.begin(), after.hinges.end(),
                                      [](const HingeParameters& p) { return p.t > 0 && p.t < 1; });
  const auto change = [&](int h) { return std::abs(after.hinges[h].t - before.hinges[h].t); };
  for (int h = 0; h < static_cast<int>(after.hinges.size()); ++h) {
    changed += change(h) > on_its_line;
    if (change(h) > change(most)) most = h;
  }
  const ParallelDrawingFit fit = parallel_drawing_of(after);
  for (const PlanarCrease& crease : find_creases(after).list)
    if (!is_on_wall || !fit.is_closed() || !(opened(left_line(after, fit.y, crease), crease) <= on_its_line))
      return "; the nearest t that keep all creases straight lie off their walls";
  return "; the nearest t that keep all creases straight differ on " + std::to_string(changed) +
         " walls, most on wall " + wall(before, most) + ": " + number_text(after.hinges[most].t) +
         " instead of " + number_text(before.hinges[most].t);
}

std::string why_not_straight(const PlanarStructure& s, const ParallelDrawing& y,
                             const PlanarCreases& creases) {
  for (const PlanarCrease& crease : creases.list) {
    const CreaseOffset left = left_line(s, y, crease);
    if (opened(left, crease) <= on_its_line) continue;
    const bool is_moving = !(left.at_rest > on_its_line);
    return "the crease through wall " + wall(s, crease.hinges.front()) +
           " does not stay straight: the hinge on wall " + wall(s, left.hinge) + " leaves its line by " +
           number_text(is_moving ? left.moving : left.at_rest) +
           (is_moving ? " cell edges times the sine of the fold angle" : " cell edges at rest") +
           nearest_t(s);
  }
  return {};
}

/// Returns the product of turns about the creases on a walk around the face.
Isometry3d round_trip(const PlanarStructure& s, const ParallelDrawing& y, const PlanarCreases& creases,
                      const GraphFace& face, double theta) {
  Isometry3d trip = Isometry3d::Identity();
  for (std::size_t k = 0; k < face.edges.size(); ++k) {
    const int h = face.edges[k];
    if (creases.of_hinge[h] < 0) continue;
    const Vector2d line = s.senses[face.vertices[k]] * lean(s, h);
    trip = trip * turn_about(line, hinge_path(s, y, h).at(theta), theta);
  }
  return trip;
}

double turn_of(const Isometry3d& trip) { return Eigen::AngleAxisd(trip.linear()).angle(); }

/// Returns the displacement of the face's first vertex by a trip, cell edges.
double shift_of(const PlanarStructure& s, const GraphFace& face, const Isometry3d& trip) {
  const Vector2d corner = s.graph.vertices[face.vertices[0]];
  const Vector3d at(corner.x(), corner.y(), 0);
  return (trip * at - at).norm();
}

bool leads_home(const PlanarStructure& s, const ParallelDrawing& y, const PlanarCreases& creases,
                const GraphFace& face) {
  for (const double theta : probe_thetas) {
    const Isometry3d trip = round_trip(s, y, creases, face, theta);
    const double scale = 1 + s.graph.vertices[face.vertices[0]].norm();
    if (!(turn_of(trip) <= leads_back && shift_of(s, face, trip) <= leads_back * scale)) return false;
  }
  return true;
}

std::string why_not_round(const PlanarStructure& s, const ParallelDrawing& y, const PlanarCreases& creases) {
  for (const GraphFace& face : s.faces) {
    if (leads_home(s, y, creases, face)) continue;
    const Isometry3d trip = round_trip(s, y, creases, face, meets);
    return "creases meet in " + to_string(face) +
           " where no flat-foldable vertex of four creases is: turned about each of them in turn at theta " +
           number_text(meets) + " rad the sheet is off by " + number_text(to_degrees(turn_of(trip))) +
           " deg and " + number_text(shift_of(s, face, trip)) + " cell edges";
  }
  return {};
}

/// Rejects plates whose gripped rows leave the planes normal to their axis.
void reject_bent_rows(const LinkageDrive& drive, const Linkage& linkage,
                      const std::function<State(double)>& at) {
  if (!drive.has_plates()) return;
  const int part = component(drive.axis);
  for (const double theta : probe_thetas) {
    const State state = at(theta);
    for (const auto& row : drive.gripped)
      for (const int body : row)
        if (!(std::abs(state[body].p[part] - state[row.front()].p[part]) <=
              straight_row * linkage.size.edge_mm))
          throw InvalidInput("plates normal to " + std::string(to_string(drive.axis)) +
                                 " would keep rows straight that bend when this sheet folds. Give `kind: "
                                 "hinge`, or --model equilibrium",
                             {"", 0, 0, "drive.axis"});
  }
}

}  // namespace

FacetTree facet_tree(const PlanarCreases& creases) {
  std::vector<std::vector<int>> creases_at(creases.facets);
  for (int c = 0; c < static_cast<int>(creases.list.size()); ++c)
    for (const int facet : {creases.list[c].from, creases.list[c].to}) creases_at[facet].push_back(c);
  FacetTree tree;
  std::vector<bool> is_known(creases.facets, false);
  std::vector<int> open = {creases.facet_of[0]};
  is_known[open[0]] = true;
  for (std::size_t k = 0; k < open.size(); ++k)
    for (const int c : creases_at[open[k]]) {
      const PlanarCrease& crease = creases.list[c];
      const int side = crease.from == open[k] ? 1 : -1, next = side > 0 ? crease.to : crease.from;
      if (is_known[next]) continue;
      is_known[next] = true;
      tree.links.push_back({next, open[k], c, side});
      open.push_back(next);
    }
  return tree;
}

std::vector<Isometry3d> facet_frames(const PlanarStructure& s, const ParallelDrawing& y,
                                     const PlanarCreases& creases, const FacetTree& tree, double theta) {
  std::vector<Isometry3d> frames(creases.facets, Isometry3d::Identity());
  for (const auto& [facet, parent, c, side] : tree.links) {
    const PlanarCrease& crease = creases.list[c];
    const Vector3d point = hinge_path(s, y, crease.hinges.front()).at(theta) * s.size.edge_mm;
    frames[facet] = frames[parent] * turn_about(side * crease.line, point, theta);
  }
  return frames;
}

State fold(const PlanarStructure& s, const ParallelDrawing& y, const PlanarCreases& creases,
           const FacetTree& tree, double theta) {
  const std::vector<Isometry3d> frames = facet_frames(s, y, creases, tree, theta);
  State state = fold(s, y, theta);
  for (std::size_t v = 0; v < state.size(); ++v) {
    const Isometry3d& frame = frames[creases.facet_of[v]];
    state[v].p = frame * state[v].p;
    state[v].R = frame.linear() * state[v].R;
  }
  return state;
}

std::string why_not_creased(const PlanarStructure& s, const ParallelDrawing& y,
                            const PlanarCreases& creases) {
  if (!creases.loose.empty())
    return "the hinge on wall " + wall(s, creases.loose.front()) +
           " leans, and upright hinges join both sides of it. A crease must run from boundary to boundary, "
           "or to "
           "another crease";
  if (std::string why = describe_lean_difference(s, creases); !why.empty()) return why;
  if (std::string why = why_not_straight(s, y, creases); !why.empty()) return why;
  return why_not_round(s, y, creases);
}

ExactMotion creased_motion(const PlanarStructure& structure, const ParallelDrawing& y) {
  const PlanarCreases creases = find_creases(structure);
  if (const std::string why = why_not_creased(structure, y, creases); !why.empty())
    return {{}, "none", "no exact family: " + why};
  const auto at = [structure, y, creases, tree = facet_tree(creases)](double theta) {
    return fold(structure, y, creases, tree, theta);
  };
  const auto theta = [structure, at](const LinkageDrive& drive) {
    reject_bent_rows(drive, structure, at);
    return theta_of(drive, structure, at);
  };
  return {at, creased_family,
          "creased: facets of upright hinges move as a planar structure, folded about the lines of " +
              std::to_string(creases.list.size()) + " creases, which stay straight",
          theta};
}

namespace {

/// Vertex of the pattern: a body at the boundary, the hinge at which a crease reaches the boundary, or the face in
/// which creases meet.
struct Corner {
  enum class Kind { body, hinge, face };
  Kind kind = Kind::body;
  int index = 0;
  auto operator<=>(const Corner&) const = default;
};

[[noreturn]] void refuse(const PlanarStructure& s, int hinge) {
  throw InvalidInput("the facets next to wall " + to_string(s.graph.edges[hinge]) + " are not polygons");
}

/// Returns the intersection of the lines of two creases at theta, in the plane of the sheet without its folds.
Vector2d meeting(const PlanarStructure& s, const ParallelDrawing& y, const PlanarCrease& a,
                 const PlanarCrease& b, double theta) {
  const Vector2d p = hinge_path(s, y, a.hinges.front()).at(theta).head<2>(),
                 q = hinge_path(s, y, b.hinges.front()).at(theta).head<2>();
  Eigen::Matrix2d lines;
  lines << a.line.normalized(), -b.line.normalized();
  return p + a.line.normalized() * (lines.inverse() * (q - p)).x();
}

class CreaseDrawing {
 public:
  CreaseDrawing(const PlanarStructure& s, const ParallelDrawing& y)
      : s_(s), y_(y), creases_(find_creases(s)) {
    walk_boundary();
    add_creases();
  }

  CreasePattern at(double theta) {
    CreasePattern out;
    out.edges = edges_;
    for (int facet = 0; facet < creases_.facets; ++facet) out.facets.push_back(polygon(facet));
    const auto frames = facet_frames(s_, y_, creases_, facet_tree(creases_), theta);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Vector2d flat = place(corners_[k], 0), now = place(corners_[k], theta);
      out.flat.push_back(s_.size.edge_mm * flat);
      out.folded.push_back(frames[facet_of_[k]] * (s_.size.edge_mm * Vector3d(now.x(), now.y(), 0)));
    }
    return out;
  }

 private:
  int number(const Corner& corner, int facet) {
    const auto [found, is_new] = known_.try_emplace(corner, static_cast<int>(corners_.size()));
    if (is_new) {
      corners_.push_back(corner);
      facet_of_.push_back(facet);
    }
    return found->second;
  }

  void join(int from, int to, int facet) {
    sides_[facet].push_back({from, to});
    edges_.push_back({from, to, -1, 0});
  }

  void walk_boundary() {
    sides_.resize(creases_.facets);
    const GraphFace rim = outer_boundary(s_.graph);
    for (std::size_t k = 0; k < rim.edges.size(); ++k) {
      const int here = rim.vertices[k], next = rim.vertices[(k + 1) % rim.vertices.size()],
                hinge = rim.edges[k];
      const int facet = creases_.facet_of[here], beyond = creases_.facet_of[next];
      const int from = number({Corner::Kind::body, here}, facet),
                to = number({Corner::Kind::body, next}, beyond);
      if (creases_.of_hinge[hinge] < 0) {
        join(from, to, facet);
        continue;
      }
      if (!at_boundary_.insert(hinge).second) refuse(s_, hinge);
      const int between = number({Corner::Kind::hinge, hinge}, facet);
      join(from, between, facet);
      join(between, to, beyond);
    }
  }

  /// Adds the ends of creases: faces where they meet others, and hinges where they reach the boundary.
  void add_creases() {
    std::vector<std::vector<int>> ends(creases_.list.size());
    const auto end = [&](int crease, const Corner& corner) {
      ends[crease].push_back(number(corner, creases_.list[crease].from));
    };
    for (const int hinge : at_boundary_) end(creases_.of_hinge[hinge], {Corner::Kind::hinge, hinge});
    for (int f = 0; f < static_cast<int>(s_.faces.size()); ++f) {
      std::set<int> here;
      for (const int e : s_.faces[f].edges)
        if (creases_.of_hinge[e] >= 0) here.insert(creases_.of_hinge[e]);
      if (here.size() < 2) continue;
      meets_[f] = {here.begin(), here.end()};
      for (const int crease : here) end(crease, {Corner::Kind::face, f});
    }
    for (std::size_t c = 0; c < ends.size(); ++c) {
      const PlanarCrease& crease = creases_.list[c];
      if (ends[c].size() != 2) refuse(s_, crease.hinges.front());
      edges_.push_back({ends[c][0], ends[c][1], static_cast<int>(c), fold_of(crease)});
      for (const int facet : {crease.from, crease.to}) sides_[facet].push_back({ends[c][0], ends[c][1]});
    }
  }

  /// Returns the fold multiplier by the sign rule of set_fold(): positive if the facet to the left of the line rises.
  double fold_of(const PlanarCrease& crease) const {
    const auto [from, to] = s_.graph.edges[crease.hinges.front()];
    const int near = creases_.facet_of[from] == crease.from ? from : to, far = from + to - near;
    const Vector2d across = s_.graph.vertices[near] - s_.graph.vertices[far];
    const Vector2d left(-crease.line.y(), crease.line.x());
    return (left.dot(across) > 0 ? 1 : -1) * crease.line.norm();
  }

  std::vector<int> polygon(int facet) const {
    std::map<int, std::vector<int>> beside;
    for (const auto& [a, b] : sides_[facet]) {
      beside[a].push_back(b);
      beside[b].push_back(a);
    }
    const auto fits = [](const auto& entry) { return entry.second.size() == 2; };
    if (beside.size() < 3 || !std::all_of(beside.begin(), beside.end(), fits)) refuse(s_, hinge_of(facet));
    std::vector<int> loop = {beside.begin()->first};
    for (int before = -1, here = loop[0];;) {
      const std::vector<int>& two = beside.at(here);
      const int next = two[0] == before ? two[1] : two[0];
      if (next == loop[0]) break;
      loop.push_back(next);
      before = here;
      here = next;
    }
    if (loop.size() != beside.size()) refuse(s_, hinge_of(facet));
    if (signed_area(loop.size(), [&](std::size_t k) { return place(corners_[loop[k]], 0); }) < 0)
      std::reverse(loop.begin(), loop.end());
    return loop;
  }

  int hinge_of(int facet) const {
    for (int h = 0; h < static_cast<int>(s_.hinges.size()); ++h)
      if (creases_.facet_of[s_.graph.edges[h].from] == facet) return h;
    return 0;
  }

  /// Returns the position of a corner at theta in the unfolded plane, cell edges.
  Vector2d place(const Corner& corner, double theta) const {
    if (corner.kind == Corner::Kind::hinge) return hinge_path(s_, y_, corner.index).at(theta).head<2>();
    if (corner.kind == Corner::Kind::body)
      return parallel_pose(s_.graph.vertices[corner.index], y_[corner.index], s_.senses[corner.index], theta)
          .p.head<2>();
    const std::vector<int>& here = meets_.at(corner.index);
    const PlanarCrease &first = creases_.list[here[0]], *other = &creases_.list[here[1]];
    const auto steep = [&](const PlanarCrease& c) {
      const Vector2d a = first.line.normalized(), b = c.line.normalized();
      return std::abs(a.x() * b.y() - a.y() * b.x());
    };
    for (const int c : here)
      if (steep(creases_.list[c]) > steep(*other)) other = &creases_.list[c];
    return meeting(s_, y_, first, *other, theta);
  }

  const PlanarStructure& s_;
  const ParallelDrawing& y_;
  PlanarCreases creases_;
  std::map<Corner, int> known_;
  std::vector<Corner> corners_;
  std::vector<int> facet_of_;  ///< one of the facets at each corner
  std::set<int> at_boundary_;
  std::map<int, std::vector<int>> meets_;
  std::vector<std::vector<std::pair<int, int>>> sides_;
  std::vector<CreasePattern::Edge> edges_;
};

}  // namespace

CreasePattern crease_pattern(const PlanarStructure& structure, const ParallelDrawing& y, double theta) {
  return CreaseDrawing(structure, y).at(theta);
}

}  // namespace kinetix::model
