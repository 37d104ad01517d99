#include "optim/ribs/fit_ribs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "optim/ribs/ribs_layout.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

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

}  // namespace kinetix::optim
