#include "optim/helmet/fit_helmet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

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
