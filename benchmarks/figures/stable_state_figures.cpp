#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "benchmarks/figure.hpp"
#include "model/elastic/path/stable_states.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/unit_laws.hpp"

namespace kinetix::bench {
namespace {

// Degrees: in-plane angles of the twist unit that are tried; at 90 it does not twist and has no barrier.
// Every fifth is listed.
constexpr int first_alpha = 30, last_alpha = 85, alpha_step = 5;
// N mm/rad: next to nothing beside k_point, so that barriers are those of stretch alone.
const model::Elasticity loose{.k_turn = 1e-5};

model::Structure twist_unit(double alpha) {
  model::Structure s = make_structure(model::rectangle(1, 1), {});
  const model::CellTuple unit{.A_in = {pi / 2, alpha, pi / 2, alpha}};
  apply_pattern(s, unit, unit, model::SharedWalls::must_agree);
  return s;
}

model::StableStates states_of(const model::Structure& s) {
  model::StableStateOptions options;
  options.path.contact = false;
  return find_stable_states(driven(s, search_drives(s, pi / 3)), loose, options);
}

double twist_error(const model::State& state, double alpha) {
  const Eigen::Vector3d up = state[0].R.col(2), other = state[1].R.col(2);
  return std::abs(std::atan2(up.cross(other).norm(), up.dot(other)) -
                  std::abs(pi - model::twist_angle(alpha)));
}

/// A point of the plot: alpha, deg, and barrier, N mm.
struct BarrierPoint {
  double alpha, energy;
};

std::vector<BarrierPoint> barriers() {
  std::vector<BarrierPoint> points;
  for (int alpha = first_alpha; alpha <= last_alpha; ++alpha) {
    const model::StableStates found = states_of(twist_unit(alpha * radians_per_degree));
    for (const model::EnergyBarrier& b : found.barriers)
      points.push_back({static_cast<double>(alpha), b.energy});
  }
  return points;
}

// px: where the axes of the plot are; outside is room for labels, to the left for energies of three digits.
constexpr double left = 70, right = 620, top = 30, bottom = 330;
// N mm, the upper end of the axis: room for the highest barrier, at 30 deg.
constexpr double max_energy = 800;

double plot_x(double alpha) { return left + (alpha - first_alpha) / (90.0 - first_alpha) * (right - left); }
double plot_y(double energy) { return bottom - energy / max_energy * (bottom - top); }

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

std::string line(double x1, double y1, double x2, double y2, const char* colour) {
  return fmt::format("<path d=\"M{:.1f},{:.1f}L{:.1f},{:.1f}\" stroke=\"{}\" fill=\"none\"/>\n", x1, y1, x2,
                     y2, colour);
}

std::string axes() {
  std::string svg;
  for (int energy = 0; energy <= max_energy; energy += 200) {
    svg += line(left, plot_y(energy), right, plot_y(energy), energy == 0 ? "#57606a" : "#d8dde2");
    svg += label(left - 8, plot_y(energy) + 4, "end", fmt::format("{}", energy));
  }
  for (int alpha = first_alpha; alpha <= 90; alpha += 10) {
    svg += line(plot_x(alpha), bottom, plot_x(alpha), bottom + 5, "#57606a");
    svg += label(plot_x(alpha), bottom + 20, "middle", fmt::format("{}", alpha));
  }
  svg += label(8, 16, "start", "energy barrier between flat and twisted, N mm");
  return svg + label(right, bottom + 42, "end", "in-plane hinge angle alpha, degrees");
}

}  // namespace

std::vector<Figure> stable_state_figures() {
  double worst = 0;
  bool both = true;
  for (int degrees = first_alpha; degrees <= last_alpha; degrees += alpha_step) {
    const double alpha = degrees * radians_per_degree;
    const model::StableStates found = states_of(twist_unit(alpha));
    both = both && found.states.size() == 2 && found.barriers.size() == 1;
    worst = std::max(worst, found.states.size() < 2 ? pi : twist_error(found.states[1].state, alpha));
  }
  return {
      {fmt::format("twist unit, alpha {} to {} deg in steps of {}: both stable states, twist of the second "
                   "against Eq. 6",
                   first_alpha, last_alpha, alpha_step),
       "both, <= 1e-6 rad", fmt::format("{}, {:.1e} rad", both ? "both" : "not both", worst),
       both && worst <= 1e-6}};
}

std::string barrier_plot() {
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"640\" height=\"380\" viewBox=\"0 0 640 380\" "
      "font-family=\"sans-serif\" font-size=\"12\" fill=\"#57606a\">\n"
      "<rect width=\"640\" height=\"380\" fill=\"#ffffff\"/>\n";
  svg += axes();
  std::string curve, dots;
  for (const auto& [alpha, energy] : barriers()) {
    curve += fmt::format("{}{:.1f},{:.1f}", curve.empty() ? "M" : "L", plot_x(alpha), plot_y(energy));
    if (static_cast<int>(alpha) % alpha_step == 0)
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#0969da\"/>\n", plot_x(alpha),
                          plot_y(energy));
  }
  svg += fmt::format("<path d=\"{}\" stroke=\"#0969da\" stroke-width=\"2\" fill=\"none\"/>\n", curve);
  return svg + dots + "</svg>\n";
}

}  // namespace kinetix::bench
