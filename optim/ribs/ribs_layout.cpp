#include "optim/ribs/ribs_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

// Cell edges between adjacent ribs: more leaves more of the surface bare.
constexpr double gap_in_edges = 0.15;

/// Returns the number of even spaces of a length that are nearest to the requested spacing.
int spaces_of(double length, double asked) {
  const double exact = length / asked;
  const int fewer = static_cast<int>(exact);
  if (fewer == 0) return static_cast<int>(std::lround(exact));
  return exact / fewer - 1 <= 1 - exact / (fewer + 1) ? fewer : fewer + 1;
}

/// Returns the number of ribs. @param length from the middle of the first rib to that of the last, mm
int ribs_of(const RibsSpec& spec, double length, int rows) {
  if (!spec.spacing_mm) return spec.ribs;
  const int spaces = spaces_of(length, *spec.spacing_mm);
  const bool has_room = 2 * spaces + 1 <= rows;
  return has_room || !(spaces > length / *spec.spacing_mm) ? spaces + 1 : spaces;
}

std::vector<int> rib_rows(const RibsSpec& spec, double length, double pitch, int rows) {
  const int count = ribs_of(spec, length - pitch, rows);
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

/// Returns the tilt of a crease whose far side turns `below` its near side.
double tilt_for(const model::Structure& structure, const model::Crease& crease, double below,
                const RibsSpec& spec, double theta) {
  const double tilt = turn_sense(structure.hinges[crease.hinges[0]].wall) * model::tilt_of_turn(below, theta);
  return std::clamp(tilt, -spec.tilt, spec.tilt);
}

/// Returns the angle of a direction above the plane, in the plane spanned by `level` and `up`.
double slope(const Vector3d& direction, const Vector3d& level, const Vector3d& up) {
  return std::atan2(direction.dot(up), direction.dot(level));
}

double slope_along_spine(const targets::SpaceCurve& spine, double arc, double span_mm) {
  return slope(spine.direction(arc, span_mm), Vector3d::UnitY(), Vector3d::UnitZ());
}

/// Returns the fall from the first to the second slope, in [-pi, pi].
double fall(double from, double to) { return std::remainder(from - to, 2 * pi); }

/// Returns the tilts of the spine. Each crease turns from the tangent in the middle of the flat piece before
/// it to that of the piece behind it.
std::vector<double> spine_tilts(const model::Fishbone& fishbone, const targets::SpaceCurve& spine,
                                double span_mm, double pitch, double theta, const RibsSpec& spec) {
  std::vector<int> rows;
  for (const model::Crease& crease : fishbone.spine) rows.push_back(line_of(fishbone.structure, crease));
  const auto middle = [&](std::size_t k) {
    const double from = k == 0 ? 0 : rows[k - 1] + 1, to = k == rows.size() ? fishbone.layout.rows : rows[k];
    return slope_along_spine(spine, std::min(pitch * (from + to) / 2, spine.length()), span_mm);
  };
  std::vector<double> tilts;
  for (std::size_t k = 0; k < rows.size(); ++k)
    tilts.push_back(
        tilt_for(fishbone.structure, fishbone.spine[k], fall(middle(k), middle(k + 1)), spec, theta));
  return tilts;
}

std::vector<double> rib_tilts(const model::Fishbone& fishbone, const std::vector<model::Crease>& creases,
                              const targets::SpaceCurve& line, double span_mm, const Vector3d& sideways,
                              const Vector3d& outward, double pitch, double theta, const RibsSpec& spec) {
  const auto angle = [&](double arc) { return slope(line.direction(arc, span_mm), sideways, outward); };
  std::vector<double> tilts;
  double last = 0;
  for (std::size_t k = 0; k < creases.size(); ++k) {
    const double next = angle(std::min((static_cast<double>(k) + 1.5) * pitch, line.length()));
    tilts.push_back(tilt_for(fishbone.structure, creases[k], fall(last, next), spec, theta));
    last = next;
  }
  return tilts;
}

class Planner {
 public:
  Planner(const targets::SpaceCurve& spine, double span_mm, const RibsSpec& spec)
      : spec_(spec), spine_(spine), span_mm_(span_mm), edge_(spec.size.edge_mm) {
    rows_ = static_cast<int>(std::lround(spine_.length() / (edge_ * std::cos(spec.start_theta))));
    if (rows_ < 2)
      throw InvalidInput(fmt::format(
          "cells of {:g} mm are too large: the line of the spine is {:.0f} mm long", edge_, spine_.length()));
    theta_ = std::clamp(std::acos(std::min(1.0, spine_.length() / (rows_ * edge_))), spec.theta.lower,
                        spec.theta.upper);
    pitch_ = edge_ * std::cos(theta_);
  }

  RibsLayout run(const TraceRib& trace) {
    RibsLayout out{{rows_, {}}, {}, spine_, {}, 0, {}};
    RibPlanes planes{
        {}, pitch_ + edge_ * (std::sin(theta_) + gap_in_edges) + spec_.size.thickness_mm, pitch_};
    for (const int row : rib_rows(spec_, spine_.length(), pitch_, rows_)) {
      const double arc = std::min((row + 0.5) * pitch_, spine_.length());
      out.spine_and_ribs.ribs.push_back({row, {0, 0}});
      planes.planes.push_back({spine_.at(arc), spine_.direction(arc, span_mm_)});
    }
    for (std::size_t r = 0; r < planes.planes.size(); ++r) {
      out.sections.push_back({trace(planes, r, -1), trace(planes, r, 1)});
      for (const int side : {0, 1})
        out.spine_and_ribs.ribs[r].cells[side] = cells_along(out.sections[r][side]);
    }
    const model::Fishbone fishbone = make_fishbone(out.spine_and_ribs, spec_.size);
    out.start.theta = theta_;
    out.start.spine = spine_tilts(fishbone, spine_, span_mm_, pitch_, theta_, spec_);
    for (std::size_t r = 0; r < planes.planes.size(); ++r)
      out.start.ribs.push_back(tilts_of_rib(fishbone, out, r, planes.planes[r].outward()));
    const double root_arc = (rows_ / 2) * pitch_;
    out.start.turn = {slope_along_spine(spine_, root_arc, span_mm_), 0, 0};
    out.start.place = spine_.at(root_arc) - pitch_ / 2 * Vector3d::UnitX();
    return out;
  }

 private:
  int cells_along(const targets::SpaceCurve& line) const {
    return std::max(0, static_cast<int>(std::floor((line.length() - pitch_ / 2) / pitch_)));
  }

  std::array<std::vector<double>, 2> tilts_of_rib(const model::Fishbone& fishbone, const RibsLayout& out,
                                                  std::size_t r, const Vector3d& outward) const {
    std::array<std::vector<double>, 2> tilts;
    for (const int side : {0, 1})
      tilts[side] = rib_tilts(fishbone, fishbone.ribs[r][side], out.sections[r][side], span_mm_,
                              (side == 0 ? -1 : 1) * Vector3d::UnitX(), outward, pitch_, theta_, spec_);
    return tilts;
  }

  const RibsSpec& spec_;
  const targets::SpaceCurve& spine_;
  double span_mm_, edge_;
  int rows_ = 0;
  double theta_ = 0, pitch_ = 0;
};

}  // namespace

bool RibPlanes::meets_neighbour(std::size_t rib, const Vector3d& p) const {
  const std::size_t next = rib % 2 == 1 ? 1 : 2;
  const bool below = rib >= next && planes[rib - next].beyond(p) < width;
  const bool above = rib + next < planes.size() && -planes[rib + next].beyond(p) < width;
  return below || above;
}

RibsLayout layout_along(const targets::SpaceCurve& spine, double span_mm, const RibsSpec& spec,
                        const TraceRib& trace) {
  return Planner(spine, span_mm, spec).run(trace);
}

}  // namespace kinetix::optim
