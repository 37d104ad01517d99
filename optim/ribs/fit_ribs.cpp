#include "optim/ribs/fit_ribs.hpp"

#include <fmt/format.h>
#include <set>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

constexpr int looks = 16;              // states from flat to theta: a contact between two of them is missed
constexpr std::size_t most_named = 3;  // pairs of walls: enough to find the place

std::vector<model::WallPair> meeting(const model::Structure& structure, double theta) {
  const model::NetTree tree = make_net_tree(structure);
  model::WallContact contact(structure);
  std::set<model::WallPair> found;
  for (int k = 1; k <= looks; ++k) {
    const auto& pairs = contact.overlapping(fold_net(tree, structure, theta * k / looks));
    found.insert(pairs.begin(), pairs.end());
  }
  return {found.begin(), found.end()};
}

}  // namespace

RibsCollisions::RibsCollisions(const model::Fishbone& fishbone, double theta)
    : walls_(half_walls(fishbone.structure)), pairs_(meeting(fishbone.structure, theta)) {
  for (const model::Hinge& hinge : fishbone.structure.hinges) names_.push_back(to_string(hinge.wall));
  for (int b = 0; b < static_cast<int>(fishbone.structure.bodies.size()); ++b)
    places_.push_back(model::place_of(fishbone, b));
}

int RibsCollisions::trim(model::FishboneLayout& spine_and_ribs) const {
  int removed = 0;
  for (const model::WallPair& pair : pairs_) {
    const model::FishbonePlace &a = place_of_plate(pair.first), &b = place_of_plate(pair.second);
    if (a.rib == b.rib && a.side == b.side) continue;
    const model::FishbonePlace& cut = a.cells >= b.cells ? a : b;
    int& cells = spine_and_ribs.ribs[cut.rib].cells[cut.side];
    removed += std::max(0, cells - (cut.cells - 1));
    cells = std::min(cells, cut.cells - 1);
  }
  return removed;
}

std::vector<std::string> RibsCollisions::describe() const {
  std::vector<std::string> out;
  for (const model::WallPair& pair : pairs_) {
    std::string words =
        "walls " + names_[walls_[pair.first].hinge] + " and " + names_[walls_[pair.second].hinge] + " meet";
    if (std::find(out.begin(), out.end(), words) == out.end()) out.push_back(std::move(words));
  }
  if (out.size() <= most_named) return out;
  const std::string more = "and so do " + std::to_string(out.size() - most_named) + " more pairs of walls";
  out.resize(most_named);
  out.push_back(more);
  return out;
}

namespace {

using Eigen::Vector3d;

constexpr int max_trims = 30;  // fits with shortened ribs: remaining collisions are reported
/// Fractions of the tilt limit, tried in turn if walls meet with the whole limit.
constexpr double tilt_parts[] = {0.6, 0.4, 0.25};
// Steps of Newton's method towards the curve, each of which about squares the error.
constexpr int steps_in_plane = 6;

/// Returns the distance of p from the curve at the clearance, in the plane through p normal to `along`.
double distance_in_plane(const targets::MeshDistance& surface, const Vector3d& p, const Vector3d& along,
                         double clearance) {
  Vector3d q = p;
  for (int k = 0; k < steps_in_plane; ++k) {
    const targets::ClosestMeshPoint closest = surface.closest(q);
    const Vector3d slope = closest.normal - along.dot(closest.normal) * along;
    if (!(slope.squaredNorm() > 1e-4)) break;
    q -= (closest.distance - clearance) / slope.squaredNorm() * slope;
  }
  return (q - p).norm();
}

double rib_error(const model::Fishbone& fishbone, const model::FishboneRib& rib, const model::State& state,
                 const targets::MeshDistance& surface, double clearance) {
  const auto columns = rib_columns(fishbone, rib);
  double sum = 0;
  for (const auto& [lower, upper] : columns) {
    const Vector3d &a = state[lower].p, &b = state[upper].p;
    sum += std::pow(distance_in_plane(surface, (a + b) / 2, (b - a).normalized(), clearance), 2);
  }
  return std::sqrt(sum / static_cast<double>(columns.size()));
}

/// Returns the shape for a fishbone with shortened ribs.
RibsShape cut_to(RibsShape shape, const model::FishboneLayout& spine_and_ribs) {
  for (std::size_t r = 0; r < spine_and_ribs.ribs.size(); ++r)
    for (const int side : {0, 1}) shape.ribs[r][side].resize(spine_and_ribs.ribs[r].cells[side]);
  return shape;
}

RibsDesign fit_with_limit(const targets::MeshDistance& surface, const Vector3d& crown, const RibsSpec& spec,
                          const SolverOptions& options, RibsLayout layout, double tilt) {
  RibsShape shape = layout.start;
  for (int trims = 0, trimmed = 0;; ++trims) {
    model::Fishbone fishbone = make_fishbone(layout.spine_and_ribs, spec.size);
    const RibsProblem problem(fishbone, ribs_goal(layout, surface, crown, spec), tilt, spec.theta);
    SolveResult search = solve(problem, problem.pack(shape), options);
    shape = problem.unpack(search.x);
    model::State state = problem.state(search.x);
    fishbone.structure = problem.structure(search.x);
    const RibsCollisions collisions(fishbone, shape.theta);
    const int removed =
        trims < max_trims && !options.stop.stop_requested() ? collisions.trim(layout.spine_and_ribs) : 0;
    trimmed += removed;
    if (removed == 0) {
      RibsError error = ribs_error(fishbone, state, surface, spec.clearance_mm);
      return {std::move(layout),
              std::move(fishbone),
              std::move(shape),
              std::move(state),
              std::move(error),
              std::move(search),
              tilt,
              trimmed,
              collisions.describe()};
    }
    shape = cut_to(std::move(shape), layout.spine_and_ribs);
  }
}

}  // namespace

RibsGoal ribs_goal(const RibsLayout& layout, const targets::MeshDistance& surface, const Vector3d& crown,
                   const RibsSpec& spec) {
  return {&surface, spec.clearance_mm, layout.rim_z, crown.x()};
}

RibsError ribs_error(const model::Fishbone& fishbone, const model::State& state,
                     const targets::MeshDistance& surface, double clearance_mm) {
  RibsError error;
  double sum = 0;
  for (const model::Pose& pose : state) {
    const double apart = surface.closest(pose.p).distance - clearance_mm;
    error.of_body.push_back(apart);
    sum += apart * apart;
    if (!(std::abs(apart) <= error.max)) error.max = std::abs(apart);
  }
  error.rms = std::sqrt(sum / static_cast<double>(state.size()));
  for (const model::FishboneRib& rib : fishbone.layout.ribs)
    error.of_ribs.push_back(rib_error(fishbone, rib, state, surface, clearance_mm));
  return error;
}

model::State placed_fishbone(const model::Fishbone& fishbone, const RibsShape& shape, double theta) {
  const model::Structure& structure = fishbone.structure;
  return placed(fold_net(make_net_tree(structure, fishbone.middle), structure, theta), fishbone.middle,
                shape.turn, shape.place);
}

RibsDesign fit_layout(const RibsLayout& layout, const targets::MeshDistance& surface, const Vector3d& crown,
                      const RibsSpec& spec, const SolverOptions& options) {
  RibsDesign first = fit_with_limit(surface, crown, spec, options, layout, spec.tilt);
  if (first.collisions.empty()) return first;
  for (const double part : tilt_parts) {
    if (options.stop.stop_requested()) break;
    RibsDesign gentler = fit_with_limit(surface, crown, spec, options, layout, part * spec.tilt);
    if (gentler.collisions.empty()) return gentler;
  }
  return first;
}

namespace {

// Folded cells: step along a rib to where it meets others, and span for its directions.
constexpr double step_in_cells = 0.25;

targets::SpaceCurve even(const std::vector<Vector3d>& line, double step) {
  const targets::SpaceCurve curve(line);
  return targets::SpaceCurve(
      curve.evenly(std::max(2, static_cast<int>(std::ceil(curve.length() / step)) + 1)));
}

/// Returns a rib to one side, up to its neighbour. A rib right at a rim has no length there.
targets::SpaceCurve trace_section(const targets::TriangleMesh& mesh, const RibPlanes& planes, std::size_t rib,
                                  int side) {
  const RibPlane& plane = planes.planes[rib];
  const double step = step_in_cells * planes.pitch;
  const auto arms = targets::section_from(mesh, plane.p, plane.along);
  const std::vector<Vector3d>& arm = arms[side < 0 ? 0 : 1];
  const targets::SpaceCurve nothing({plane.p, plane.p + side * step * Vector3d::UnitX()});
  if (arm.size() < 2) return nothing;
  std::vector<Vector3d> line;
  const targets::SpaceCurve whole = even(arm, step);
  for (const Vector3d& p : whole.points()) {
    if (line.size() > 1 && planes.meets_neighbour(rib, p)) break;
    line.push_back(p);
  }
  return targets::SpaceCurve(line);
}

/// Returns the surface in a rib's frame: x along it where it leaves the spine, y across, z outward.
targets::MeshDistance seen_from(const targets::RibbedSurface& surface, const RibPlane& plane) {
  Eigen::Matrix3d turn;
  turn << Vector3d::UnitX().transpose(), plane.along.transpose(), plane.outward().transpose();
  targets::TriangleMesh mesh = surface.surface.mesh();
  for (Vector3d& p : mesh.vertices) p = turn * (p - plane.p);
  return {std::move(mesh), turn * (surface.surface.inside() - plane.p)};
}

/// Returns one rib of a plan as a fishbone of one row, in its own frame.
RibsLayout alone(const RibsLayout& all, std::size_t rib, double pitch) {
  RibsShape start;
  start.theta = all.start.theta;
  start.ribs = {all.start.ribs[rib]};
  start.place = {-pitch / 2, -pitch / 2, 0};
  return {{1, {{0, all.spine_and_ribs.ribs[rib].cells}}},
          std::move(start),
          all.spine,
          {all.sections[rib]},
          0,
          {}};
}

}  // namespace

RibsLayout plan_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec) {
  const targets::TriangleMesh mesh = joined(surface.surface.mesh());
  const double span = step_in_cells * spec.size.edge_mm;
  return layout_along(surface.spine, span, spec, [&](const RibPlanes& planes, std::size_t rib, int side) {
    return trace_section(mesh, planes, rib, side);
  });
}

RibsDesign fit_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                    const SolverOptions& options) {
  return fit_layout(plan_ribs(surface, spec), surface.surface, Vector3d::Zero(), spec, options);
}

double open_area(int cells, const model::CellSize& size, double theta, double area) {
  return 1 - cells * std::pow(size.edge_mm * std::cos(theta), 2) / area;
}

LooseRibs fit_loose_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                         const SolverOptions& options) {
  const RibsLayout layout = plan_ribs(surface, spec);
  const double pitch = spec.size.edge_mm * std::cos(layout.start.theta);
  // Folded further than planned, a rib would be too short for its section, and nearer to the surface only for
  // that.
  RibsSpec as_planned = spec;
  as_planned.theta.upper = layout.start.theta;
  LooseRibs out;
  double squares = 0, covered = 0;
  std::size_t bodies = 0;
  for (std::size_t r = 0; r < layout.spine_and_ribs.ribs.size(); ++r) {
    const double arc = std::min((layout.spine_and_ribs.ribs[r].row + 0.5) * pitch, layout.spine.length());
    const RibPlane plane{layout.spine.at(arc),
                         layout.spine.direction(arc, step_in_cells * spec.size.edge_mm)};
    const RibsDesign rib =
        fit_layout(alone(layout, r, pitch), seen_from(surface, plane), Vector3d::Zero(), as_planned, options);
    squares += rib.error.rms * rib.error.rms * static_cast<double>(rib.state.size());
    bodies += rib.state.size();
    out.max = std::max(out.max, rib.error.max);
    covered += 1 - open_area(static_cast<int>(rib.fishbone.structure.cells.size()), spec.size,
                             rib.shape.theta, surface.area);
    ++out.pieces;
  }
  out.rms = std::sqrt(squares / static_cast<double>(bodies));
  out.open = 1 - covered;
  return out;
}

namespace {

constexpr double ray_step = 0.5 * radians_per_degree;  // rad: about one point per millimetre on a head
constexpr double touch_mm = 1e-6;  // mm: a ray approaches the surface step by step, and stops here
constexpr double span_mm = 1;      // mm to either side for directions of curves, the spacing of their points
constexpr double steepest_ray = 120 * radians_per_degree;  // rad from outward: well below any rim

/// Surface at the clearance from the head, seen from within.
class OffsetSurface {
 public:
  OffsetSurface(const targets::MeshDistance& head, double clearance)
      : head_(head), clearance_(clearance), far_(bounds(head.mesh()).diagonal().norm() + clearance) {}

  /// Returns the outermost point at the clearance, searched from far outside towards `inside`.
  /// @throws InvalidInput if there is none
  Vector3d outermost(const Vector3d& inside, const Vector3d& direction) const {
    double radius = far_;
    while (radius > 0) {
      const Vector3d p = inside + radius * direction;
      const double apart = std::abs(head_.closest(p).distance) - clearance_;
      if (apart <= touch_mm) return p;
      radius -= apart;
    }
    throw InvalidInput(
        fmt::format("the head has no surface from [{:.0f}, {:.0f}, {:.0f}] mm (from the crown) towards "
                    "[{:.2f}, {:.2f}, {:.2f}]",
                    inside.x(), inside.y(), inside.z(), direction.x(), direction.y(), direction.z()));
  }

 private:
  const targets::MeshDistance& head_;
  double clearance_, far_;
};

/// Returns the middle of the surface at the rim, in the plane of the spine.
Vector3d middle_at_rim(const OffsetSurface& surface, const Vector3d& crown, double rim_z) {
  const Vector3d below(crown.x(), crown.y(), rim_z);
  return (surface.outermost(below, -Vector3d::UnitY()) + surface.outermost(below, Vector3d::UnitY())) / 2;
}

targets::SpaceCurve spine_line(const OffsetSurface& surface, const Vector3d& middle) {
  std::vector<Vector3d> line;
  const int rays = static_cast<int>(std::round(pi / ray_step));
  for (int k = 0; k <= rays; ++k) {
    const double angle = pi * k / rays;
    line.push_back(surface.outermost(middle, {0, -std::cos(angle), std::sin(angle)}));
  }
  return targets::SpaceCurve(line);
}

class RibTracer {
 public:
  /// @param lowest smallest z of ribs, mm
  RibTracer(const OffsetSurface& surface, const Vector3d& middle, double lowest)
      : surface_(surface), middle_(middle), lowest_(lowest) {}

  struct Line {
    targets::SpaceCurve curve;
    bool at_neighbour = false;  ///< the line ends before the rim, where it would meet its neighbour
  };
  Line trace(const RibPlanes& planes, std::size_t rib, int side) const {
    const RibPlane& plane = planes.planes[rib];
    const Vector3d inside = middle_ - plane.beyond(middle_) * plane.along,
                   sideways = side * Vector3d::UnitX();
    std::vector<Vector3d> line;
    for (double angle = 0; angle <= steepest_ray; angle += ray_step) {
      const Vector3d direction = std::cos(angle) * plane.outward() + std::sin(angle) * sideways;
      const Vector3d p = surface_.outermost(inside, direction);
      const bool met = planes.meets_neighbour(rib, p), low = p.z() < lowest_;
      if (line.size() > 1 && (met || low)) return {targets::SpaceCurve(line), met};
      line.push_back(p);
    }
    return {targets::SpaceCurve(line), false};
  }

 private:
  const OffsetSurface& surface_;
  Vector3d middle_;
  double lowest_;
};

}  // namespace

RibsLayout plan_helmet(const targets::MeshDistance& head, const Vector3d& crown, const RibsSpec& spec) {
  const OffsetSurface surface(head, spec.clearance_mm);
  const double rim_z = crown.z() - spec.coverage_mm, edge = spec.size.edge_mm;
  const Vector3d middle = middle_at_rim(surface, crown, rim_z);
  const RibTracer tracer(surface, middle, rim_z - edge);
  std::vector<double> above;  // height at which each rib ends above the rim, mm
  RibsLayout out = layout_along(spine_line(surface, middle), span_mm, spec,
                                [&](const RibPlanes& planes, std::size_t rib, int side) {
                                  const RibTracer::Line line = tracer.trace(planes, rib, side);
                                  above.resize(planes.planes.size(), 0);
                                  if (line.at_neighbour)
                                    above[rib] = std::max(above[rib], line.curve.points().back().z() - rim_z);
                                  return line.curve;
                                });
  out.rim_z = rim_z;
  for (std::size_t rib = 0; rib < above.size(); ++rib)
    if (above[rib] > edge)
      out.notes.push_back(
          fmt::format("rib {} ends {:.0f} mm above the rim: further down it would meet a neighbour", rib + 1,
                      above[rib]));
  return out;
}

RibsDesign fit_helmet(const targets::MeshDistance& head, const Vector3d& crown, const RibsSpec& spec,
                      const SolverOptions& options) {
  return fit_layout(plan_helmet(head, crown, spec), head, crown, spec, options);
}

}  // namespace kinetix::optim
