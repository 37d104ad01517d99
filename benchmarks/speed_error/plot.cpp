#include "benchmarks/speed_error/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/speed_error/log_axis.hpp"
#include "benchmarks/speed_error/pareto.hpp"
#include "benchmarks/speed_error/series_style.hpp"

namespace kinetix::bench {
namespace {

constexpr int panels_per_row = 3;  // panels: what a page shows side by side at a legible size.
// px: a panel, and the gaps between two. Between rows there is room for a title and tick labels.
constexpr double panel_width = 288, panel_height = 232, gap_x = 22, gap_y = 44;
// px around the panels: labels of the axes to the left and below, title and legend above.
constexpr double left = 70, top = 116, bottom = 56, right = 18;
// Ends of the axes, s and cell edges, beyond all measured points; others are drawn at the end. The error at which
// times are compared is 0.1 % of a cell edge.
constexpr double fastest = 3e-7, slowest = 60, finest = 1e-17, coarsest = 20, shown_error = 1e-3;
// Colours of text and of grid lines.
constexpr const char* grey = "#57606a";
constexpr const char* pale = "#eaeef2";

struct Panel {
  double x0, y0;
  LogAxis x, y;

  Panel(int row, int column)
      : x0(left + column * (panel_width + gap_x)), y0(top + row * (panel_height + gap_y)) {
    x = {fastest, slowest, x0, x0 + panel_width};
    y = {finest, coarsest, y0 + panel_height, y0};
  }
};

std::string text(double x, double y, const char* anchor, const std::string& words, const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     words);
}

std::string line(double x1, double y1, double x2, double y2, const char* colour, const char* more = "") {
  return fmt::format("<path d=\"M{:.1f},{:.1f}L{:.1f},{:.1f}\" stroke=\"{}\" fill=\"none\"{}/>\n", x1, y1, x2,
                     y2, colour, more);
}

std::string grid(const Panel& p) {
  std::string svg;
  for (const double t : p.x.ticks()) svg += line(p.x.place(t), p.y0, p.x.place(t), p.y0 + panel_height, pale);
  for (const double e : p.y.ticks(2)) svg += line(p.x0, p.y.place(e), p.x0 + panel_width, p.y.place(e), pale);
  return svg;
}

std::string required_error_lines(const Panel& p) {
  std::string svg;
  for (const auto& [error, words] : {std::pair{1e-2, "1 %"}, {1e-3, "0.1 %"}, {1e-4, "0.01 %"}}) {
    const double y = p.y.place(error);
    svg += line(p.x0, y, p.x0 + panel_width, y, "#afb8c1", " stroke-dasharray=\"2 3\"");
    svg += text(p.x0 + 4, y - 2.5, "start", words, " font-size=\"8.5\"");
  }
  return svg;
}

std::string tick_labels(const Panel& p, bool at_left, bool at_bottom) {
  std::string svg;
  for (const double e : p.y.ticks(4))
    if (at_left) svg += text(p.x0 - 7, p.y.place(e) + 4, "end", power_label(e));
  for (const double t : p.x.ticks(2))
    if (at_bottom) svg += text(p.x.place(t), p.y0 + panel_height + 18, "middle", power_label(t));
  return svg;
}

std::string front(const Panel& p, const MeasuredPoints& points, const SeriesStyle& style) {
  MeasuredPoints best = pareto_front(points);
  std::erase_if(best, [](const MeasuredPoint& point) { return point.error > 1; });
  if (best.size() < 2) return "";
  std::string path;
  for (const MeasuredPoint& point : best)
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", p.x.place(point.seconds),
                        p.y.place(point.error));
  return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"1.4\" fill=\"none\" opacity=\"0.75\"{}/>\n",
                     path, style.colour, style.is_dashed ? " stroke-dasharray=\"4 2.5\"" : "");
}

std::string markers(const Panel& p, const MeasuredPoints& points, const SeriesStyle& style) {
  std::string svg;
  for (const MeasuredPoint& point : points)
    if (std::isfinite(point.error))
      svg += svg_marker(style, p.x.place(point.seconds), p.y.place(point.error), point.is_result ? 0.9 : 0.3);
  return svg;
}

std::string drawn_points(const Panel& p, const MeasuredPoints& points) {
  std::string lines, dots;
  const std::vector<std::string> series = series_in(points);
  for (auto name = series.rbegin(); name != series.rend(); ++name) {
    lines += front(p, of_series(points, *name), style_of(*name));
    dots += markers(p, of_series(points, *name), style_of(*name));
  }
  return lines + dots;
}

std::string comparison(const MeasuredScene& scene) {
  const auto model = fastest_at(without_bullet(scene.points), shown_error);
  const auto bullet = fastest_at(of_bullet(scene.points), shown_error);
  if (!model || !bullet) return "0.1 % not reached";
  return fmt::format("at 0.1 %: {} \u00d7", count_label(bullet->seconds / model->seconds));
}

std::string exact_time(const Panel& p, const MeasuredPoints& points) {
  const MeasuredPoints exact = of_series(points, "exact");
  if (exact.empty())
    return text(p.x0 + 6, p.y0 + panel_height - 8, "start", "against the finest equilibrium");
  std::string words = time_label(exact[0].seconds);
  if (const auto micro = words.find('u'); micro != std::string::npos) words.replace(micro, 1, "\u00b5");
  return text(p.x.place(exact[0].seconds) + 8, p.y.place(exact[0].error) + 4, "start", words);
}

std::string drawn_panel(const MeasuredScene& scene, int k, int count) {
  const Panel p(k / panels_per_row, k % panels_per_row);
  std::string svg = grid(p) + required_error_lines(p);
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#8c959f\"/>\n", p.x0,
      p.y0, panel_width, panel_height);
  svg += text(p.x0, p.y0 - 9, "start", scene.name, " font-size=\"13\" font-weight=\"600\" fill=\"#1f2328\"");
  svg += text(p.x0 + panel_width, p.y0 - 9, "end", comparison(scene));
  svg += tick_labels(p, k % panels_per_row == 0, k + panels_per_row >= count);
  return svg + drawn_points(p, scene.points) + exact_time(p, scene.points);
}

std::string legend(const std::vector<MeasuredScene>& scenes) {
  MeasuredPoints all;
  for (const MeasuredScene& scene : scenes) all.insert(all.end(), scene.points.begin(), scene.points.end());
  std::string svg;
  double x = left + 4;
  for (const std::string& series : series_in(all)) {
    const SeriesStyle style = style_of(series);
    svg +=
        line(x - 9, 72, x + 9, 72, style.colour.c_str(),
             style.is_dashed ? " stroke-width=\"1.4\" stroke-dasharray=\"4 2.5\"" : " stroke-width=\"1.4\"");
    svg += svg_marker(style, x, 72, 1);
    svg += text(x + 14, 76, "start", series);
    x += 46 + 5.6 * static_cast<double>(series.size());
  }
  return svg;
}

}  // namespace

std::string speed_error_plot(const std::vector<MeasuredScene>& scenes) {
  const int count = static_cast<int>(scenes.size()), rows = (count + panels_per_row - 1) / panels_per_row;
  const double width = left + panels_per_row * (panel_width + gap_x) - gap_x + right;
  const double height = top + rows * (panel_height + gap_y) - gap_y + bottom;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"11\" fill=\"{2}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      width, height, grey);
  svg += text(left, 26, "start", "Error of the folded state against the time to compute it",
              " font-size=\"16\" font-weight=\"600\" fill=\"#1f2328\"");
  svg += text(left, 46, "start",
              "Beside each title: time of Bullet's fastest run that comes within 0.1 % of a cell edge, over "
              "that of the "
              "fastest model that does. Pale: not at rest, or hinges open.",
              " font-size=\"11.5\"");
  svg += legend(scenes);
  for (int k = 0; k < count; ++k) svg += drawn_panel(scenes[k], k, count);
  const double middle = top + (height - top - bottom) / 2;
  svg += text(left + (width - left - right) / 2, height - 12, "middle", "time of one state, s",
              " font-size=\"13\"");
  svg += fmt::format(
      "<text transform=\"translate(20 {:.1f}) rotate(-90)\" text-anchor=\"middle\" font-size=\"13\">rms "
      "error of "
      "body positions, cell edges</text>\n",
      middle);
  return svg + "</svg>\n";
}

}  // namespace kinetix::bench
