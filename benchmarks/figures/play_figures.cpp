#include <fmt/format.h>
#include <array>
#include <cmath>

#include "benchmarks/figure.hpp"
#include "model/base/geometry.hpp"
#include "tests/support/played_twist_unit.hpp"

namespace kinetix::bench {
namespace {

/// A curve of the plot: in-plane angle, degrees, and colour.
struct Curve {
  double alpha;
  const char* colour;
};
// The paper does not say which angle it printed.
constexpr std::array<Curve, 4> curves{{{60, "#0969da"}, {70, "#1a7f37"}, {75, "#bc4c00"}, {80, "#8250df"}}};
constexpr std::array<double, 5> printed{0.05, 0.1, 0.15, 0.2, 0.25};  // mm, section 5.1 of the paper

constexpr double friction = 0.1;  // N mm: of a pin that turns by a radian (hinges.md section 2)

std::string numbers(const auto& values, const char* format) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : ", ") + fmt::format(fmt::runtime(format), v);
  return text;
}

// px: where the axes of the plot are.
constexpr double left = 60, right = 620, top = 30, bottom = 330;
constexpr double max_energy = 20, max_play = 0.35;  // N mm, mm: the highest barrier, and the largest play
constexpr double play_step = 0.01;                  // mm between points of a curve

double plot_x(double play) { return left + play / max_play * (right - left); }
double plot_y(double energy) { return bottom - energy / max_energy * (bottom - top); }

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<path d=\"M{:.1f},{:.1f}L{:.1f},{:.1f}\" {} fill=\"none\"/>\n", x1, y1, x2, y2, style);
}

std::string axes() {
  std::string svg;
  for (int energy = 0; energy <= max_energy; energy += 5) {
    svg += line(left, plot_y(energy), right, plot_y(energy),
                energy == 0 ? "stroke=\"#57606a\"" : "stroke=\"#d8dde2\"");
    svg += label(left - 8, plot_y(energy) + 4, "end", fmt::format("{}", energy));
  }
  for (int k = 0; k <= 7; ++k) {
    const double play = 0.05 * k;
    svg += line(plot_x(play), bottom, plot_x(play), bottom + 5, "stroke=\"#57606a\"");
    svg += label(plot_x(play), bottom + 20, "middle", fmt::format("{:.2f}", play));
  }
  for (const double play : printed)
    svg += line(plot_x(play), top, plot_x(play), bottom, "stroke=\"#d8dde2\" stroke-dasharray=\"3,3\"");
  svg += label(8, 16, "start",
               "energy barrier between flat and twisted, N mm; circles: the play that the geometry needs");
  return svg +
         label(right, bottom + 42, "end", "play of the pins, mm a side; dashed: as printed in the paper");
}

/// Draws a curve to the clearance at which the barrier is gone.
std::string curve(const Curve& c) {
  const double alpha = c.alpha * radians_per_degree, needed = testing::flip_play(alpha).upper;
  std::string path;
  double play = 0;
  for (int k = 0; play < needed; play = ++k * play_step)
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", plot_x(play),
                        plot_y(testing::flip_barrier(alpha, play)));
  path += fmt::format("L{:.1f},{:.1f}", plot_x(needed), bottom);
  return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"2\" fill=\"none\"/>\n", path, c.colour) +
         fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", plot_x(needed), bottom,
                     c.colour);
}

std::string legend() {
  std::string svg;
  double y = top + 16;
  for (const Curve& c : curves) {
    svg +=
        line(right - 90, y, right - 66, y, fmt::format("stroke=\"{}\" stroke-width=\"2\"", c.colour).c_str());
    svg += label(right - 60, y + 4, "start", fmt::format("alpha {:g}°", c.alpha));
    y += 18;
  }
  return svg;
}

Figure compare_vanishing_play() {
  std::vector<double> needed;
  double worst = 0;
  for (const Curve& c : curves) {
    const double alpha = c.alpha * radians_per_degree, play = testing::flip_play(alpha).upper;
    const double gone = testing::vanishing_play(alpha, 0.4 * play, 0.7 * play);
    const double error = std::abs(gone / play - 1);
    worst = std::isnan(error) ? INFINITY : std::max(worst, error);
    needed.push_back(play);
  }
  return {
      "the paper's twist unit, 30 mm, with play in its pins, alpha 60, 70, 75, 80 deg: play from which its "
      "barrier is gone, against the least that its geometry needs",
      "<= 1 %", fmt::format("{:.2f} %; {} mm a side", 100 * worst, numbers(needed, "{:.3f}")), worst <= 0.01};
}

Figure barriers_of_the_printed_plays() {
  std::vector<double> energies;
  bool falls = true;
  for (const double play : printed) {
    const double energy = testing::flip_barrier(75 * radians_per_degree, play);
    // Beyond the play that the flip needs only the looseness of the model is left, below friction.
    falls = falls && energy <= (energies.empty() ? INFINITY : std::max(energies.back(), friction));
    energies.push_back(energy);
  }
  return {"the same at alpha 75 deg with the plays that the paper printed, 0.05 to 0.25 mm: energy barrier",
          "falls with play, as its resistance did", numbers(energies, "{:.3f}") + " N mm", falls};
}

}  // namespace

std::vector<Figure> play_figures() { return {compare_vanishing_play(), barriers_of_the_printed_plays()}; }

std::string play_plot() {
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"640\" height=\"380\" viewBox=\"0 0 640 380\" "
      "font-family=\"sans-serif\" font-size=\"12\" fill=\"#57606a\">\n"
      "<rect width=\"640\" height=\"380\" fill=\"#ffffff\"/>\n";
  svg += axes();
  for (const Curve& c : curves) svg += curve(c);
  return svg + legend() + "</svg>\n";
}

}  // namespace kinetix::bench
