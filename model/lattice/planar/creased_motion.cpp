#include "model/lattice/planar/creased_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/hinge/crease_law.hpp"
#include "model/lattice/planar/exact_designs.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "model/linkage/probe_thetas.hpp"

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
             " of one crease must lean alike, each to the side of its class, along its line: they differ "
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
  const RedrawingFit fit = redrawing_of(after);
  for (const PlanarCrease& crease : find_creases(after).list)
    if (!is_on_wall || !fit.is_closed() || !(opened(left_line(after, fit.y, crease), crease) <= on_its_line))
      return "; the nearest t that keep all creases straight lie off their walls";
  return "; the nearest t that keep all creases straight differ on " + std::to_string(changed) +
         " walls, most on wall " + wall(before, most) + ": " + number_text(after.hinges[most].t) +
         " instead of " + number_text(before.hinges[most].t);
}

std::string why_not_straight(const PlanarStructure& s, const Redrawing& y, const PlanarCreases& creases) {
  for (const PlanarCrease& crease : creases.list) {
    const CreaseOffset left = left_line(s, y, crease);
    if (opened(left, crease) <= on_its_line) continue;
    const bool is_moving = !(left.at_rest > on_its_line);
    return "the crease through wall " + wall(s, crease.hinges.front()) +
           " does not stay straight: the hinge on wall " + wall(s, left.hinge) + " leaves its line by " +
           number_text(is_moving ? left.moving : left.at_rest) +
           (is_moving ? " cell edges times sin(theta)" : " cell edges at rest") + nearest_t(s);
  }
  return {};
}

/// Returns the product of turns about the creases on a walk around the face.
Isometry3d round_trip(const PlanarStructure& s, const Redrawing& y, const PlanarCreases& creases,
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
double way_of(const PlanarStructure& s, const GraphFace& face, const Isometry3d& trip) {
  const Vector2d corner = s.graph.vertices[face.vertices[0]];
  const Vector3d at(corner.x(), corner.y(), 0);
  return (trip * at - at).norm();
}

bool leads_home(const PlanarStructure& s, const Redrawing& y, const PlanarCreases& creases,
                const GraphFace& face) {
  for (const double theta : probe_thetas) {
    const Isometry3d trip = round_trip(s, y, creases, face, theta);
    const double scale = 1 + s.graph.vertices[face.vertices[0]].norm();
    if (!(turn_of(trip) <= leads_back && way_of(s, face, trip) <= leads_back * scale)) return false;
  }
  return true;
}

std::string why_not_round(const PlanarStructure& s, const Redrawing& y, const PlanarCreases& creases) {
  for (const GraphFace& face : s.faces) {
    if (leads_home(s, y, creases, face)) continue;
    const Isometry3d trip = round_trip(s, y, creases, face, meets);
    return "creases meet in " + to_string(face) +
           " where no flat-foldable vertex of four creases is: turned about each of them in turn at theta " +
           number_text(meets) + " rad the sheet is off by " + number_text(to_degrees(turn_of(trip))) +
           " deg and " + number_text(way_of(s, face, trip)) + " cell edges";
  }
  return {};
}

/// Rejects plates whose gripped rows leave the planes normal to their axis.
void refuse_rows_that_bend(const LinkageDrive& drive, const Linkage& linkage,
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
                                 " would hold rows straight that bend as this sheet folds; allowed: "
                                 "kind: hinge, or --model equilibrium",
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

std::vector<Isometry3d> facet_frames(const PlanarStructure& s, const Redrawing& y,
                                     const PlanarCreases& creases, const FacetTree& tree, double theta) {
  std::vector<Isometry3d> frames(creases.facets, Isometry3d::Identity());
  for (const auto& [facet, parent, c, side] : tree.links) {
    const PlanarCrease& crease = creases.list[c];
    const Vector3d point = hinge_path(s, y, crease.hinges.front()).at(theta) * s.size.edge_mm;
    frames[facet] = frames[parent] * turn_about(side * crease.line, point, theta);
  }
  return frames;
}

State fold(const PlanarStructure& s, const Redrawing& y, const PlanarCreases& creases, const FacetTree& tree,
           double theta) {
  const std::vector<Isometry3d> frames = facet_frames(s, y, creases, tree, theta);
  State state = fold(s, y, theta);
  for (std::size_t v = 0; v < state.size(); ++v) {
    const Isometry3d& frame = frames[creases.facet_of[v]];
    state[v].p = frame * state[v].p;
    state[v].R = frame.linear() * state[v].R;
  }
  return state;
}

std::string why_not_creased(const PlanarStructure& s, const Redrawing& y, const PlanarCreases& creases) {
  if (!creases.loose.empty())
    return "the hinge on wall " + wall(s, creases.loose.front()) +
           " does not stand upright, and upright hinges join what lies on both sides of it: a crease runs "
           "from "
           "rim to rim, or to where it meets others";
  if (std::string why = describe_lean_difference(s, creases); !why.empty()) return why;
  if (std::string why = why_not_straight(s, y, creases); !why.empty()) return why;
  return why_not_round(s, y, creases);
}

ExactMotion creased_motion(const PlanarStructure& structure, const Redrawing& y) {
  const PlanarCreases creases = find_creases(structure);
  if (const std::string why = why_not_creased(structure, y, creases); !why.empty())
    return {{}, "none", "no exact family: " + why};
  const auto at = [structure, y, creases, tree = facet_tree(creases)](double theta) {
    return fold(structure, y, creases, tree, theta);
  };
  const auto theta = [structure, at](const LinkageDrive& drive) {
    refuse_rows_that_bend(drive, structure, at);
    return theta_of(drive, structure, at);
  };
  return {at, creased_family,
          "creased: facets of upright hinges move as a planar structure, folded about the lines of " +
              std::to_string(creases.list.size()) + " creases, which stay straight",
          theta};
}

}  // namespace kinetix::model
