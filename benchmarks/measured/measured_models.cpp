#include "benchmarks/measured/measured_models.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "app/files/design_file.hpp"
#include "app/run/design_hinges.hpp"
#include "model/base/geometry.hpp"
#include "model/contact/certified_range.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::bench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double theta_limit_deg = 50;  // degrees: walls touch before it
constexpr int curve_points =
    2001;  // of the curve of stretches: 0.05 degrees apart, which is 1e-7 off a chord

constexpr int pins_per_step = 2;   // between neighbouring cells with markers: one at a tip, one at a centre
constexpr int bores_per_step = 3;  // whose places add up in a spacing: both centres and a tip

app::Design shipped(const std::string& name) {
  return app::read_design(std::string(KINETIX_SHAPES "/") + name + ".yaml");
}

/// Returns the body at a place of the flat sheet, mm.
int body_at(const model::Lattice& sheet, const Vector3d& place) {
  for (int b = 0; b < sheet.bodies(); ++b)
    if ((sheet.rest_position(b) - place).norm() < 1e-9 * sheet.size().edge_mm) return b;
  throw std::runtime_error("the sheet has no body there");
}

/// Returns the number of cells between the first and the last body along an axis.
int cells_along(const model::Lattice& sheet, model::Axis axis) {
  double most = 0;
  for (int b = 0; b < sheet.bodies(); ++b) most = std::max(most, sheet.rest_position(b)[component(axis)]);
  return static_cast<int>(std::lround(most / sheet.size().edge_mm));
}

struct CurvePoint {
  double theta;  // rad
  Vector2d stretch;
};

std::vector<CurvePoint> stretch_curve(const model::Lattice& sheet) {
  const model::ExactMotion motion = exact_motion(sheet);
  if (!motion) throw std::runtime_error("the sheet has no exact motion");
  const double limit = theta_limit_deg * radians_per_degree;
  std::vector<CurvePoint> curve;
  for (int k = 0; k < curve_points; ++k) {
    const double theta = limit * (2.0 * k / (curve_points - 1) - 1);
    curve.push_back({theta, bulk_stretch(sheet, motion.at(theta))});
  }
  return curve;
}

/// Nearest point of a curve.
struct Nearest {
  double theta = 0, distance = INFINITY;  // rad, ratio
};

Nearest nearest_on(const std::vector<CurvePoint>& curve, const Vector2d& stretch) {
  constexpr double tie = 1e-12;  // ratio: of two equally near states, the one with the larger theta counts
  Nearest best;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const Vector2d along = curve[k].stretch - curve[k - 1].stretch, to = stretch - curve[k - 1].stretch;
    const double part = std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (to - part * along).norm();
    if (distance < best.distance + tie)
      best = {std::lerp(curve[k - 1].theta, curve[k].theta, part), distance};
  }
  return best;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Returns the spacing of neighbouring bodies in a state of exact motion, mm.
double exact_spacing(const PinLattice& lattice, double theta) {
  const model::State state = exact_motion(lattice.sheet).at(theta);
  const int first = body_at(lattice.sheet, Vector3d::Zero()),
            next = body_at(lattice.sheet, lattice.sheet.size().edge_mm * Vector3d::UnitX());
  return (state[next].p - state[first].p).norm();
}

}  // namespace

Vector2d bulk_stretch(const model::Lattice& sheet, const model::State& state) {
  Vector2d stretch;
  const Vector3d& origin = state[body_at(sheet, Vector3d::Zero())].p;
  for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
    const int cells = cells_along(sheet, axis) / 2 * 2;  // the pattern of hinges repeats after two cells
    const double length = cells * sheet.size().edge_mm;
    const Vector3d& end = state[body_at(sheet, length * edge_direction(axis))].p;
    stretch[component(axis)] = (end - origin).norm() / length;
  }
  return stretch;
}

StretchDeviation compare_stretch(const StretchSample& sample) {
  const std::vector<CurvePoint> curve = stretch_curve(shipped(sample.design).structure);
  StretchDeviation out{.theta_min = INFINITY, .theta_max = -INFINITY};
  std::vector<double> distances;
  for (const auto& run : sample.runs)
    for (const Vector2d& size : run) {
      const Nearest nearest = nearest_on(curve, size / sample.reference_mm);
      distances.push_back(nearest.distance);
      out.theta_min = std::min(out.theta_min, nearest.theta);
      out.theta_max = std::max(out.theta_max, nearest.theta);
    }
  out.points = static_cast<int>(distances.size());
  out.rms = root_mean_square(distances);
  out.max = *std::ranges::max_element(distances);
  return out;
}

PinLattice read_pin_lattice() {
  const app::Design design = shipped("pin_lattice");
  return {design.structure, app::loosest_pin(design).value(), design.process.sd};
}

SpacingDeviation compare_spacings(const PinLattice& lattice, const MarkerRow& row) {
  const double count = static_cast<double>(row.spacing_mm.size());
  const double mean = std::accumulate(row.spacing_mm.begin(), row.spacing_mm.end(), 0.0) / count;
  SpacingDeviation out{.theta = std::acos(mean / exact_spacing(lattice, 0))};
  double sum = 0;
  for (const double spacing : row.spacing_mm) sum += std::pow(spacing - exact_spacing(lattice, out.theta), 2);
  out.rms = std::sqrt(sum / (count - 1));
  return out;
}

double spacing_scatter_mm(const PinLattice& lattice) {
  const double place = clearance_scatter(lattice.pin, lattice.sd).place_mm;
  return std::sqrt(pins_per_step * place * place + bores_per_step * lattice.sd.t_mm * lattice.sd.t_mm);
}

double max_spacing_mm(const PinLattice& lattice) {
  return exact_spacing(lattice, 0) + pins_per_step * play_mm(lattice.pin);
}

double min_spacing_mm(const PinLattice& lattice) {
  const model::ContactRange range =
      certified_range(model::Linkage(lattice.sheet), exact_motion(lattice.sheet), turn_laws(lattice.sheet));
  return exact_spacing(lattice, range.positive.theta) - pins_per_step * play_mm(lattice.pin);
}

double two_clearances_sd_mm(const PinLattice& lattice) {
  return std::sqrt(double{pins_per_step}) * lattice.sd.clearance_mm;
}

double bend_scatter_deg(const PinLattice& lattice) {
  return to_degrees(std::sqrt(double{pins_per_step}) * clearance_scatter(lattice.pin, lattice.sd).tilt);
}

double max_bend_deg(const PinLattice& lattice, double more_mm) {
  model::ManufacturedHinge pin = lattice.pin;
  pin.clearance_mm += more_mm;
  return pins_per_step * to_degrees(clearance_tilt(pin));
}

double rms_bend_deg(const MarkerRow& row) { return root_mean_square(row.bend_deg); }

double dome_bend_deg(const MarkerRow& row) {
  double most = 0;
  for (std::size_t k = 2; k < row.bend_deg.size(); ++k)
    most = std::max(most, -(row.bend_deg[k - 2] + row.bend_deg[k - 1] + row.bend_deg[k]) / 3);
  return most;
}

}  // namespace kinetix::bench
