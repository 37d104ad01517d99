#include "model/lattice/planar/planar_motion.hpp"

#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/lattice/planar/creased_motion.hpp"

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

Vector2d parallel_edge(const PlanarStructure& structure, int edge) {
  const HingeParameters& hinge = structure.hinges[edge];
  const Vector2d along = structure.graph.along(edge);
  const Vector2d part = (2 * hinge.t - 1) * along + 2 * hinge.offset * turned_by_90(along.normalized());
  return structure.senses[structure.graph.edges[edge].from] * part;
}

Vector2d parallel_sum(const PlanarStructure& structure, const GraphFace& face) {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t k = 0; k < face.edges.size(); ++k)
    sum += walked(structure.graph, face, k) * parallel_edge(structure, face.edges[k]);
  return sum;
}

// The edge and its parallel drawing both change sign from B to A, so their quotient is independent of the direction.
WallChange change_of(const PlanarStructure& structure, const ParallelDrawing& y, int edge) {
  const auto [from, to] = structure.graph.edges[edge];
  const Vector2d along = structure.graph.along(edge), part = y[to] - y[from];
  const double square = along.squaredNorm();
  return {part.dot(along) / square, turned_by_90(along).dot(part) / (2 * square)};
}

ParallelDrawingFit parallel_drawing_of(const PlanarStructure& structure) {
  ParallelDrawingFit fit;
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
      fit.y[next] = fit.y[open[k]] + (next == to ? 1 : -1) * parallel_edge(structure, e);
      open.push_back(next);
    }
  for (int f = 0; f < static_cast<int>(structure.faces.size()); ++f) {
    const double misfit = parallel_sum(structure, structure.faces[f]).norm(),
                 longest = longest_wall(structure, structure.faces[f]);
    if (misfit * fit.longest <= fit.misfit * longest) continue;
    fit.misfit = misfit;
    fit.longest = longest;
    fit.worst_face = f;
    if (std::isnan(misfit)) break;
  }
  return fit;
}

void place_hinge(const Vector2d& edge, const Vector2d& parallel_edge, int sense, HingeParameters& hinge) {
  const Vector2d part = sense * parallel_edge;
  hinge.t = (1 + part.dot(edge) / edge.squaredNorm()) / 2;
  hinge.offset = turned_by_90(edge.normalized()).dot(part) / 2;
}

void place_hinges(const ParallelDrawing& y, PlanarStructure& structure) {
  for (int e = 0; e < static_cast<int>(structure.hinges.size()); ++e) {
    const auto [from, to] = structure.graph.edges[e];
    place_hinge(structure.graph.along(e), y[to] - y[from], structure.senses[from], structure.hinges[e]);
  }
}

Pose parallel_pose(const Vector2d& x, const Vector2d& y, int sense, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  const Vector2d at = c * x + s * turned_by_90(y);
  Pose pose;
  pose.p = {at.x(), at.y(), 0};
  pose.R << c, -sense * s, 0, sense * s, c, 0, 0, 0, 1;
  return pose;
}

State fold(const PlanarStructure& structure, const ParallelDrawing& y, double theta) {
  State state(y.size());
  for (std::size_t v = 0; v < y.size(); ++v) {
    state[v] = parallel_pose(structure.graph.vertices[v], y[v], structure.senses[v], theta);
    state[v].p *= structure.size.edge_mm;
  }
  return state;
}

ExactMotion exact_motion(const PlanarStructure& structure) {
  ParallelDrawingFit fit = parallel_drawing_of(structure);
  if (!fit.is_closed())
    return {{},
            "none",
            "no exact family: " + to_string(structure.faces[fit.worst_face]) +
                " does not close: it is off by " + number_text(fit.misfit) +
                " cell edges times the sine of the fold angle"};
  if (!all_vertical(structure)) return creased_motion(structure, fit.y);
  const auto at = [structure, y = fit.y](double theta) { return fold(structure, y, theta); };
  const auto theta = [structure, at, y = fit.y](const LinkageDrive& drive) {
    reject_curved_rows(drive, y);
    return theta_of(drive, structure, at);
  };
  return {at, "planar", "planar: all axes vertical, every face closes: each body follows its own path",
          theta};
}

namespace {

// Cell edges: rounding separates vertices on one line of a drawing by as much
constexpr double one_line = 1e-9;

std::vector<int> bodies_at(const PlanarStructure& s, Axis axis, double place) {
  const int along = component(axis);
  std::vector<int> row;
  for (int v = 0; v < static_cast<int>(s.graph.vertices.size()); ++v)
    if (std::abs(s.graph.vertices[v][along] - place) <= one_line) row.push_back(v);
  std::sort(row.begin(), row.end(),
            [&](int a, int b) { return s.graph.vertices[a][1 - along] < s.graph.vertices[b][1 - along]; });
  return row;
}

/// Returns the boundary rows without the check for single bodies.
GrippedRows outermost_rows(const PlanarStructure& s, Axis axis) {
  const int along = component(axis);
  const auto [low, high] =
      std::minmax_element(s.graph.vertices.begin(), s.graph.vertices.end(),
                          [along](const auto& a, const auto& b) { return a[along] < b[along]; });
  return {bodies_at(s, axis, (*low)[along]), bodies_at(s, axis, (*high)[along])};
}

bool can_grip(const GrippedRows& rows) { return rows[0].size() > 1 && rows[1].size() > 1; }

/// Returns the distance of the rows at theta over that at rest. Along x a body is at cos(theta) x - sin(theta) y_y,
/// along y at cos(theta) y + sin(theta) y_x.
double closing(const PlanarStructure& s, const ParallelDrawing& y, Axis axis, const GrippedRows& rows,
               double theta) {
  const int first = rows[0].front(), last = rows[1].front(), along = component(axis);
  const double rest = s.graph.vertices[last][along] - s.graph.vertices[first][along];
  const double moved = y[last][1 - along] - y[first][1 - along];
  return std::cos(theta) + (axis == Axis::x ? -1 : 1) * std::sin(theta) * moved / rest;
}

/// Returns the first upright hinge, or the first hinge if none is upright.
int first_upright(const PlanarStructure& s) {
  const Linkage linkage = s;
  const auto upright = std::find_if(linkage.hinges.begin(), linkage.hinges.end(),
                                    [](const RestHinge& hinge) { return is_vertical(hinge); });
  return upright == linkage.hinges.end() ? 0 : static_cast<int>(upright - linkage.hinges.begin());
}

}  // namespace

GrippedRows boundary_rows(const PlanarStructure& structure, Axis axis) {
  GrippedRows rows = outermost_rows(structure, axis);
  if (can_grip(rows)) return rows;
  const int single = rows[0].size() > 1 ? rows[1].front() : rows[0].front();
  throw InvalidInput("plates normal to " + std::string(to_string(axis)) +
                         " would touch this panel at vertex " + std::to_string(single) +
                         " alone and let it turn; allowed: " +
                         to_string(axis == Axis::x ? Axis::y : Axis::x) + ", or kind: hinge",
                     {"", 0, 0, "drive.axis"});
}

LinkageDrive plate_drive(const PlanarStructure& structure, Axis axis, double compression, int branch) {
  validate_hinges(structure);
  return plates_between(boundary_rows(structure, axis), axis, compression, branch,
                        static_cast<int>(structure.graph.vertices.size()));
}

LinkageDrive hinge_drive(const PlanarStructure& structure, int hinge, double angle) {
  validate_hinges(structure);
  return turned_hinge(hinge, structure.senses[structure.graph.edges[hinge].from], angle);
}

LinkageDrive drive_to(const PlanarStructure& structure, double theta) {
  require("theta", theta, std::abs(theta) < pi / 2, "in (-pi/2, pi/2) rad");
  if (const ParallelDrawingFit fit = parallel_drawing_of(structure);
      fit.is_closed() && all_vertical(structure))
    for (const Axis axis : {Axis::y, Axis::x}) {
      const GrippedRows rows = outermost_rows(structure, axis);
      if (!can_grip(rows) || !keeps_rows_straight(fit.y, axis, rows)) continue;
      const double compression = 1 - closing(structure, fit.y, axis, rows, theta);
      if (compression >= 0) return plate_drive(structure, axis, compression, theta < 0 ? -1 : 1);
    }
  const int hinge = first_upright(structure);
  return hinge_drive(structure, hinge,
                     turn_at_theta(structure.senses[structure.graph.edges[hinge].from], theta));
}

bool keeps_rows_straight(const ParallelDrawing& y, Axis axis, const GrippedRows& rows) {
  const int part = 1 - component(axis);
  const auto is_straight = [&](const std::vector<int>& row) {
    return std::all_of(row.begin(), row.end(), [&](int b) {
      return std::abs(y[b][part] - y[row.front()][part]) <= ParallelDrawingFit::closed;
    });
  };
  return is_straight(rows[0]) && is_straight(rows[1]);
}

void reject_curved_rows(const LinkageDrive& drive, const ParallelDrawing& y) {
  if (keeps_rows_straight(y, drive.axis, drive.gripped)) return;
  throw InvalidInput("plates normal to " + std::string(to_string(drive.axis)) +
                         " would keep rows straight that curve in this panel's motion. Give `kind: hinge`, "
                         "or --model equilibrium",
                     {"", 0, 0, "drive.axis"});
}

}  // namespace kinetix::model
