#include "optim/helmet/helmet_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr double ray_step = 0.5 * radians_per_degree;  // rad: a point a millimetre on a head
constexpr double touch_mm = 1e-6;  // mm: a ray comes ever nearer to the surface, and here it has arrived
constexpr double span_mm = 1;      // mm to either side for directions of curves, the spacing of their points
constexpr double steepest_ray = 120 * radians_per_degree;  // rad from outward: well below any rim
// Cell edges between ribs side by side: more leaves more of the head bare.
constexpr double gap_in_edges = 0.15;

/// The surface that keeps the clearance, as seen from within.
class OffsetSurface {
 public:
  OffsetSurface(const targets::MeshDistance& head, double clearance)
      : head_(head), clearance_(clearance), far_(bounds(head.mesh()).diagonal().norm() + clearance) {}

  /// From far outside towards `inside` until the clearance is reached: the outermost such place.
  /// @throws InvalidInput where there is none
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

/// Middle of the surface at the rim, in the plane of the spine.
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

/// Plane of a rib.
struct RibPlane {
  Vector3d p, along;  ///< a point of the spine, and the spine's direction there
  double beyond(const Vector3d& q) const { return (q - p).dot(along); }
  Vector3d outward() const { return Vector3d::UnitX().cross(along); }
};

/// From the spine to where a rib ends.
struct RibLine {
  targets::SpaceCurve curve;
  bool at_neighbour = false;  ///< it ends before the rim, where it would meet its neighbour
};

class RibTracer {
 public:
  /// @param lowest z that ribs may reach   @param width that a rib takes up to each side
  RibTracer(const OffsetSurface& surface, const std::vector<RibPlane>& planes, double lowest, double width)
      : surface_(surface), planes_(planes), lowest_(lowest), width_(width) {}

  RibLine trace(std::size_t rib, const Vector3d& middle, int side) const {
    const RibPlane& plane = planes_[rib];
    const Vector3d inside = middle - plane.beyond(middle) * plane.along, sideways = side * Vector3d::UnitX();
    std::vector<Vector3d> line;
    for (double angle = 0; angle <= steepest_ray; angle += ray_step) {
      const Vector3d direction = std::cos(angle) * plane.outward() + std::sin(angle) * sideways;
      const Vector3d p = surface_.outermost(inside, direction);
      const bool met = meets_neighbour(rib, p), low = p.z() < lowest_;
      if (line.size() > 1 && (met || low)) return {targets::SpaceCurve(line), met};
      line.push_back(p);
    }
    return {targets::SpaceCurve(line), false};
  }

 private:
  /// Every other rib ends beside its neighbours, so that those between run on to where they meet each other.
  bool meets_neighbour(std::size_t rib, const Vector3d& p) const {
    const std::size_t next = rib % 2 == 1 ? 1 : 2;
    const bool below = rib >= next && planes_[rib - next].beyond(p) < width_;
    const bool above = rib + next < planes_.size() && -planes_[rib + next].beyond(p) < width_;
    return below || above;
  }

  const OffsetSurface& surface_;
  const std::vector<RibPlane>& planes_;
  double lowest_, width_;
};

std::vector<int> rib_rows(const HelmetSpec& spec, double length, double pitch, int rows) {
  const int count = spec.spacing_mm
                        ? 1 + static_cast<int>(std::floor((length - pitch) / *spec.spacing_mm + 1e-9))
                        : spec.ribs;
  if (2 * count - 1 > rows)
    throw InvalidInput(
        fmt::format("{} ribs overlap flat: the spine has {} rows of cells, room for at most {} ribs; "
                    "use fewer ribs or smaller cells",
                    count, rows, (rows + 1) / 2));
  std::vector<int> out;
  for (int k = 0; k < count; ++k)
    out.push_back(count == 1 ? rows / 2 : static_cast<int>(std::lround(k * (rows - 1.0) / (count - 1))));
  return out;
}

/// Tilt of a crease whose far side is to turn `below` its near side.
double tilt_for(const model::Structure& structure, const model::Crease& crease, double below,
                const HelmetSpec& spec, double theta) {
  const double tilt = turn_sense(structure.hinges[crease.hinges[0]].wall) * model::tilt_of_turn(below, theta);
  return std::clamp(tilt, -spec.tilt, spec.tilt);
}

/// Angle of a direction above the plane, in the plane spanned by `level` and `up`.
double slope(const Vector3d& direction, const Vector3d& level, const Vector3d& up) {
  return std::atan2(direction.dot(up), direction.dot(level));
}

double slope_along_spine(const targets::SpaceCurve& spine, double arc) {
  return slope(spine.direction(arc, span_mm), Vector3d::UnitY(), Vector3d::UnitZ());
}

/// Tilts of the spine: each crease turns from the tangent in the middle of the flat piece before it to that
/// of the piece behind it. Angles fall along the spine and do not jump.
std::vector<double> spine_tilts(const model::Fishbone& fishbone, const targets::SpaceCurve& spine,
                                double pitch, double theta, const HelmetSpec& spec) {
  std::vector<int> rows;
  for (const model::Crease& crease : fishbone.spine) rows.push_back(line_of(fishbone.structure, crease));
  const auto middle = [&](std::size_t k) {
    const double from = k == 0 ? 0 : rows[k - 1] + 1, to = k == rows.size() ? fishbone.layout.rows : rows[k];
    return slope_along_spine(spine, pitch * (from + to) / 2);
  };
  std::vector<double> tilts;
  for (std::size_t k = 0; k < rows.size(); ++k)
    tilts.push_back(tilt_for(fishbone.structure, fishbone.spine[k], middle(k) - middle(k + 1), spec, theta));
  return tilts;
}

std::vector<double> rib_tilts(const model::Fishbone& fishbone, const std::vector<model::Crease>& creases,
                              const targets::SpaceCurve& line, const Vector3d& sideways,
                              const Vector3d& outward, double pitch, double theta, const HelmetSpec& spec) {
  const auto angle = [&](double arc) { return slope(line.direction(arc, span_mm), sideways, outward); };
  std::vector<double> tilts;
  double last = 0;
  for (std::size_t k = 0; k < creases.size(); ++k) {
    const double next = angle((static_cast<double>(k) + 1.5) * pitch);
    tilts.push_back(tilt_for(fishbone.structure, creases[k], last - next, spec, theta));
    last = next;
  }
  return tilts;
}

class Planner {
 public:
  Planner(const targets::MeshDistance& head, const Vector3d& crown, const HelmetSpec& spec)
      : surface_(head, spec.clearance_mm),
        spec_(spec),
        edge_(spec.size.edge_mm),
        rim_z_(crown.z() - spec.coverage_mm),
        middle_(middle_at_rim(surface_, crown, rim_z_)),
        spine_(spine_line(surface_, middle_)) {
    rows_ = static_cast<int>(std::lround(spine_.length() / (edge_ * std::cos(spec.start_theta))));
    if (rows_ < 2)
      throw InvalidInput(
          fmt::format("cells of {:g} mm are too large: the line over the head is {:.0f} mm long", edge_,
                      spine_.length()));
    theta_ = std::clamp(std::acos(std::min(1.0, spine_.length() / (rows_ * edge_))), spec.theta.lower,
                        spec.theta.upper);
    pitch_ = edge_ * std::cos(theta_);
  }

  HelmetLayout run() {
    HelmetLayout out{{rows_, {}}, {}, spine_, {}, rim_z_, {}};
    for (const int row : rib_rows(spec_, spine_.length(), pitch_, rows_)) {
      const double arc = std::min((row + 0.5) * pitch_, spine_.length());
      out.spine_and_ribs.ribs.push_back({row, {0, 0}});
      planes_.push_back({spine_.at(arc), spine_.direction(arc, span_mm)});
    }
    trace_ribs(out);
    const model::Fishbone fishbone = make_fishbone(out.spine_and_ribs, spec_.size);
    out.start.theta = theta_;
    out.start.spine = spine_tilts(fishbone, spine_, pitch_, theta_, spec_);
    for (std::size_t r = 0; r < planes_.size(); ++r) out.start.ribs.push_back(tilts_of_rib(fishbone, out, r));
    const double root_arc = (rows_ / 2) * pitch_;
    out.start.turn = {slope_along_spine(spine_, root_arc), 0, 0};
    out.start.place = spine_.at(root_arc) - pitch_ / 2 * Vector3d::UnitX();
    return out;
  }

 private:
  void trace_ribs(HelmetLayout& out) const {
    const double width = pitch_ + edge_ * (std::sin(theta_) + gap_in_edges) + spec_.size.thickness_mm;
    const RibTracer tracer(surface_, planes_, rim_z_ - edge_, width);
    for (std::size_t r = 0; r < planes_.size(); ++r) {
      const RibLine lower = tracer.trace(r, middle_, -1), upper = tracer.trace(r, middle_, 1);
      out.spine_and_ribs.ribs[r].cells = {cells_along(lower.curve), cells_along(upper.curve)};
      note_ends(r, lower, upper, out.notes);
      out.sections.push_back({lower.curve, upper.curve});
    }
  }

  void note_ends(std::size_t rib, const RibLine& lower, const RibLine& upper,
                 std::vector<std::string>& notes) const {
    double highest = edge_;
    for (const RibLine* line : {&lower, &upper})
      if (line->at_neighbour) highest = std::max(highest, line->curve.points().back().z() - rim_z_);
    if (highest > edge_)
      notes.push_back(fmt::format(
          "rib {} ends {:.0f} mm above the rim: further down it would meet a neighbour", rib + 1, highest));
  }

  int cells_along(const targets::SpaceCurve& line) const {
    return std::max(0, static_cast<int>(std::floor((line.length() - pitch_ / 2) / pitch_)));
  }

  std::array<std::vector<double>, 2> tilts_of_rib(const model::Fishbone& fishbone, const HelmetLayout& out,
                                                  std::size_t r) const {
    std::array<std::vector<double>, 2> tilts;
    for (const int side : {0, 1})
      tilts[side] =
          rib_tilts(fishbone, fishbone.ribs[r][side], out.sections[r][side],
                    (side == 0 ? -1 : 1) * Vector3d::UnitX(), planes_[r].outward(), pitch_, theta_, spec_);
    return tilts;
  }

  OffsetSurface surface_;
  const HelmetSpec& spec_;
  double edge_, rim_z_;
  Vector3d middle_;
  targets::SpaceCurve spine_;
  int rows_ = 0;
  double theta_ = 0, pitch_ = 0;
  std::vector<RibPlane> planes_;
};

}  // namespace

HelmetLayout plan_helmet(const targets::MeshDistance& head, const Vector3d& crown, const HelmetSpec& spec) {
  return Planner(head, crown, spec).run();
}

}  // namespace kinetix::optim
