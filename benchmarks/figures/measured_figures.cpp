#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "benchmarks/figure.hpp"
#include "benchmarks/measured/crossed_lattice.hpp"
#include "benchmarks/measured/measured_models.hpp"
#include "model/base/geometry.hpp"

namespace kinetix::bench {
namespace {

using Eigen::Vector2d;

constexpr double max_stretch_rms = 0.012,
                 max_stretch = 0.025;  // ratio: readings in mm, prints, hinges and hands
// Ratio of the standard deviation of ten numbers to the true one that 95 % of samples stay below: sqrt(16.92 / 9) by the
// chi-squared distribution.
constexpr double ten_readings = 1.37;
constexpr double pull_force = 0.1;  // N: stretches pins by less than 0.001 mm

Figure stretch_figure(const StretchSample& sample) {
  const StretchDeviation d = compare_stretch(sample);
  return {
      fmt::format("printed sheet {}, {} measured widths and heights: stretch off the exact motion of {}.yaml",
                  sample.name, d.points, sample.design),
      fmt::format("rms <= {:g}, largest <= {:g}", max_stretch_rms, max_stretch),
      fmt::format("rms {:.4f} ({:.2f} mm of {:g}), largest {:.4f}, theta {:.1f} to {:.1f} deg", d.rms,
                  d.rms * sample.reference_mm, sample.reference_mm, d.max, to_degrees(d.theta_min),
                  to_degrees(d.theta_max)),
      d.rms <= max_stretch_rms && d.max <= max_stretch};
}

Figure flat_spacing_figure(const PinLattice& lattice, const MarkerRow& row) {
  const SpacingDeviation d = compare_spacings(lattice, row);
  const double expected = spacing_scatter_mm(lattice);
  return {fmt::format("pin lattice at rest, capture {}: spacing of cells off the exact motion", row.name),
          fmt::format("rms <= {:.2f} mm: {:.2f} by the print tolerance of fdm, for ten readings",
                      ten_readings * expected, expected),
          fmt::format("rms {:.2f} mm at theta {:.1f} deg", d.rms, to_degrees(d.theta)),
          d.rms <= ten_readings * expected};
}

Figure flat_bend_figure(const PinLattice& lattice, const MarkerRow& row) {
  const double rms = rms_bend_deg(row), expected = bend_scatter_deg(lattice);
  return {fmt::format("the same, capture {}: bend per cell", row.name),
          fmt::format("rms <= {:.1f} deg: two pins that lean at random", expected),
          fmt::format("rms {:.1f} deg", rms), rms <= expected};
}

/// Returns "NAME value" of every dome, and the largest value.
std::pair<std::string, double> each_dome(const char* format,
                                         const std::function<double(const MarkerRow&)>& value) {
  std::string text;
  double most = 0;
  for (const MarkerRow& row : dome_rows()) {
    text += (text.empty() ? "" : ", ") + row.name + " " + fmt::format(fmt::runtime(format), value(row));
    most = std::max(most, value(row));
  }
  return {text, most};
}

Figure dome_spacing_figure(const PinLattice& lattice) {
  const double play = max_spacing_mm(lattice) - 2 * lattice.arm_mm();
  const auto [text, most] =
      each_dome("{:.1f}", [&](const MarkerRow& row) { return compare_spacings(lattice, row).rms; });
  return {
      fmt::format("pin lattice as a dome, {} captures: spacing of cells off the exact motion with one theta",
                  dome_rows().size()),
      fmt::format("rms <= {:.1f} mm: play of two pins per step", play), text + " mm", most <= play};
}

Figure dome_bend_figure(const PinLattice& lattice) {
  const double nominal = max_bend_deg(lattice), loose = max_bend_deg(lattice, lattice.sd.clearance_mm);
  const auto [text, most] = each_dome("{:.1f}", dome_bend_deg);
  return {"the same captures: largest mean bend of three cells",
          fmt::format("<= {:.1f} deg: two pins lean to the end of their play, {:g} mm and one sd", loose,
                      play_mm(lattice.pin)),
          fmt::format("{} deg; by {:g} mm alone {:.1f}", text, play_mm(lattice.pin), nominal), most <= loose};
}

Figure spacing_range_figure(const PinLattice& lattice) {
  double least = INFINITY, most = 0;
  std::size_t count = 0;
  for (const auto& rows : {flat_rows(), dome_rows()})
    for (const MarkerRow& row : rows)
      for (const double spacing : row.spacing_mm) {
        least = std::min(least, spacing);
        most = std::max(most, spacing);
        ++count;
      }
  const double low = min_spacing_mm(lattice), high = max_spacing_mm(lattice),
               sd = two_clearances_sd_mm(lattice);
  return {fmt::format("pin lattice, all captures: least and largest of {} spacings", count),
          fmt::format("{:.2f} to {:.2f} mm, +- {:.2f}: range free of contact, and play of two pins", low,
                      high, sd),
          fmt::format("{:.2f} to {:.2f} mm", least, most), least >= low - sd && most <= high + sd};
}

/// Ratio of a measured displacement to the limit of the play in its direction.
struct PullRatio {
  double measured_mm = 0, limit_mm = 0, ratio = 0;
  bool converged = false;
};

PullRatio pull_ratio(const PinLattice& lattice, int i, int j) {
  const Vector2d moved = pull_spacing_mm * (pulled_cells()[pulled_side * i + j] - Vector2d(i, j)),
                 direction = moved.normalized();
  const CrossedLattice crosses{.side = pulled_side,
                               .arm_mm = lattice.arm_mm(),
                               .spacing_mm = pull_spacing_mm,
                               .play_mm = play_mm(lattice.pin)};
  const PulledLattice pulled = pull(crosses, i, j, pull_force * direction);
  const double limit = pulled.moved_mm[pulled_side * i + j].dot(direction);
  return {moved.norm(), limit, moved.norm() / limit, pulled.converged};
}

std::vector<Figure> pull_figures(const PinLattice& lattice) {
  const PullRatio corner = pull_ratio(lattice, pulled_side - 1, pulled_side - 1);
  double most = 0;
  int beyond = 0, failed = 0;
  for (int k = 1; k < pulled_side * pulled_side; ++k) {
    const PullRatio here = pull_ratio(lattice, k / pulled_side, k % pulled_side);
    most = std::max(most, here.ratio);
    beyond += here.ratio > 1;
    failed += !here.converged;
  }
  const char* const limit = "<= 1 of what play allows in that direction";
  return {
      {"pin lattice of 5 x 5 cells pulled at a corner, the opposite cell locked: way of the corner", limit,
       fmt::format("{:.2f} of it: {:.1f} of {:.1f} mm", corner.ratio, corner.measured_mm, corner.limit_mm),
       corner.converged && corner.ratio <= 1},
      {"the same, all 24 cells that are free", limit,
       fmt::format("{} cells beyond, up to {:.1f} times{}", beyond, most,
                   failed ? fmt::format("; {} pulls did not converge", failed) : ""),
       beyond == 0 && failed == 0}};
}

}  // namespace

std::vector<Figure> measured_figures() {
  std::vector<Figure> figures;
  for (const StretchSample& sample : stretch_samples()) figures.push_back(stretch_figure(sample));
  const PinLattice lattice = read_pin_lattice();
  for (const MarkerRow& row : flat_rows()) {
    figures.push_back(flat_spacing_figure(lattice, row));
    figures.push_back(flat_bend_figure(lattice, row));
  }
  figures.push_back(dome_spacing_figure(lattice));
  figures.push_back(dome_bend_figure(lattice));
  figures.push_back(spacing_range_figure(lattice));
  for (Figure& figure : pull_figures(lattice)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace kinetix::bench
