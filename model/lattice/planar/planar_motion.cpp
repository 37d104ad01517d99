#include "model/lattice/planar/planar_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/lattice/planar/creased_motion.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "model/lattice/planar/plane_geometry.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

/// Returns the length of a face's longest wall, cell edges, at least 1.
double longest_wall(const PlanarStructure& s, const GraphFace& face) {
  double longest = 1;
  for (const int e : face.edges) longest = std::max(longest, s.graph.along(e).norm());
  return longest;
}

}  // namespace

Vector2d redrawn(const PlanarStructure& structure, int edge) {
  const HingeParameters& hinge = structure.hinges[edge];
  const Vector2d along = structure.graph.along(edge);
  const Vector2d part = (2 * hinge.t - 1) * along + 2 * hinge.offset * turned_by_90(along.normalized());
  return structure.senses[structure.graph.edges[edge].from] * part;
}

Vector2d redrawn_sum(const PlanarStructure& structure, const GraphFace& face) {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t k = 0; k < face.edges.size(); ++k)
    sum += walked(structure.graph, face, k) * redrawn(structure, face.edges[k]);
  return sum;
}

// The edge and its parallel drawing both change sign from B to A, so their quotient is independent of the direction.
WallChange change_of(const PlanarStructure& structure, const Redrawing& y, int edge) {
  const auto [from, to] = structure.graph.edges[edge];
  const Vector2d along = structure.graph.along(edge), part = y[to] - y[from];
  const double square = along.squaredNorm();
  return {part.dot(along) / square, turned_by_90(along).dot(part) / (2 * square)};
}

RedrawingFit redrawing_of(const PlanarStructure& structure) {
  RedrawingFit fit;
  fit.y.assign(structure.graph.vertices.size(), Vector2d::Zero());
  std::vector<std::vector<int>> edges_at(structure.graph.vertices.size());
  for (int e = 0; e < static_cast<int>(structure.graph.edges.size()); ++e)
    for (const int end : {structure.graph.edges[e].from, structure.graph.edges[e].to})
      edges_at[end].push_back(e);
  std::vector<bool> is_known(fit.y.size(), false);
  is_known[0] = true;
  std::vector<int> open = {0};
  for (std::size_t k = 0; k < open.size(); ++k)
    for (const int e : edges_at[open[k]]) {
      const auto [from, to] = structure.graph.edges[e];
      const int next = from == open[k] ? to : from;
      if (is_known[next]) continue;
      is_known[next] = true;
      fit.y[next] = fit.y[open[k]] + (next == to ? 1 : -1) * redrawn(structure, e);
      open.push_back(next);
    }
  for (int f = 0; f < static_cast<int>(structure.faces.size()); ++f) {
    const double misfit = redrawn_sum(structure, structure.faces[f]).norm(),
                 longest = longest_wall(structure, structure.faces[f]);
    if (misfit * fit.longest <= fit.misfit * longest) continue;
    fit.misfit = misfit;
    fit.longest = longest;
    fit.worst_face = f;
    if (std::isnan(misfit)) break;
  }
  return fit;
}

void place_hinge(const Vector2d& edge, const Vector2d& redrawn, int sense, HingeParameters& hinge) {
  const Vector2d part = sense * redrawn;
  hinge.t = (1 + part.dot(edge) / edge.squaredNorm()) / 2;
  hinge.offset = turned_by_90(edge.normalized()).dot(part) / 2;
}

void place_hinges(const Redrawing& y, PlanarStructure& structure) {
  for (int e = 0; e < static_cast<int>(structure.hinges.size()); ++e) {
    const auto [from, to] = structure.graph.edges[e];
    place_hinge(structure.graph.along(e), y[to] - y[from], structure.senses[from], structure.hinges[e]);
  }
}

Pose redrawn_pose(const Vector2d& x, const Vector2d& y, int sense, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  const Vector2d at = c * x + s * turned_by_90(y);
  Pose pose;
  pose.p = {at.x(), at.y(), 0};
  pose.R << c, -sense * s, 0, sense * s, c, 0, 0, 0, 1;
  return pose;
}

State fold(const PlanarStructure& structure, const Redrawing& y, double theta) {
  State state(y.size());
  for (std::size_t v = 0; v < y.size(); ++v) {
    state[v] = redrawn_pose(structure.graph.vertices[v], y[v], structure.senses[v], theta);
    state[v].p *= structure.size.edge_mm;
  }
  return state;
}

ExactMotion exact_motion(const PlanarStructure& structure) {
  RedrawingFit fit = redrawing_of(structure);
  if (!fit.is_closed())
    return {{},
            "none",
            "no exact family: " + to_string(structure.faces[fit.worst_face]) +
                " does not close: it is off by " + number_text(fit.misfit) + " cell edges times sin(theta)"};
  if (!all_vertical(structure)) return creased_motion(structure, fit.y);
  const auto at = [structure, y = fit.y](double theta) { return fold(structure, y, theta); };
  const auto theta = [structure, at, y = fit.y](const LinkageDrive& drive) {
    refuse_rows_that_curve(drive, y);
    return theta_of(drive, structure, at);
  };
  return {at, "planar", "planar: all axes vertical, every face closes: each body on a path of its own",
          theta};
}

}  // namespace kinetix::model
