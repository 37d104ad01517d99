#include "app/pictures/far_view.hpp"

#include <cairo.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "app/pictures/cairo_page.hpp"
#include "model/opening/cell_opening.hpp"

namespace kinetix::app {
namespace {

using Grey = Eigen::ArrayXXd;  ///< pixels by row and column, 0 to 1

// Cell edges: more than three times the usual blur, so the boundary fades out within the picture.
constexpr double margin_in_cells = 2;
// Quantiles of the light that become black and white. Beyond them are single openings, which would leave the rest grey.
constexpr double darkest = 0.02, brightest = 0.98;
// Fractions of the blurred outline: it is a half at the panel's edge. Near 1, the boundary has no effect.
constexpr double inside = 0.5, deep_inside = 0.98;
// Least range of light to stretch, ratio: an eye does not see differences of a fiftieth.
constexpr double least_range = 0.02;
// Least width of white walls, px: avoids black seams between two openings.
constexpr double seam = 2;

/// Draws the light through a panel: white openings on black. @param walls true: walls are black, false: walls are white
Grey drawn(const model::Linkage& panel, const model::State& state, const PictureFrame& frame, double scale,
           bool walls) {
  CairoImage image(frame, scale);
  cairo_t* pen = image.pen();
  cairo_set_source_rgb(pen, 1, 1, 1);
  const double edge = panel.size.edge_mm;
  for (const model::LinkageCell& cell : panel.cells) {
    for (const Eigen::Vector2d& corner : opening(panel, state, cell).outline())
      cairo_line_to(pen, edge * corner.x(), edge * corner.y());
    cairo_close_path(pen);
    cairo_fill(pen);
  }
  model::Linkage drawn_panel = panel;
  if (!walls) drawn_panel.size.thickness_mm = std::max(panel.size.thickness_mm, seam / scale);
  draw_walls(drawn_panel, state, walls ? 0 : 1, pen);
  return image.grey();
}

std::vector<double> gaussian(double deviation) {
  std::vector<double> weights;
  const int reach = static_cast<int>(std::ceil(3 * deviation));
  double sum = 0;
  for (int k = -reach; k <= reach; ++k)
    sum += weights.emplace_back(std::exp(-k * k / (2 * deviation * deviation)));
  for (double& w : weights) w /= sum;
  return weights;
}

/// Blurs the columns of a picture. Pixels outside the picture count as black.
Grey blurred_down(const Grey& picture, const std::vector<double>& weights) {
  const Eigen::Index reach = static_cast<Eigen::Index>(weights.size()) / 2;
  Grey out = Grey::Zero(picture.rows(), picture.cols());
  for (Eigen::Index k = -reach; k <= reach; ++k) {
    const Eigen::Index from = std::max<Eigen::Index>(0, k), to = std::min(picture.rows(), picture.rows() + k);
    if (from < to)
      out.middleRows(from, to - from) += weights[k + reach] * picture.middleRows(from - k, to - from);
  }
  return out;
}

Grey blurred(const Grey& picture, double deviation) {
  const std::vector<double> weights = gaussian(deviation);
  return blurred_down(blurred_down(picture, weights).transpose(), weights).transpose();
}

/// Stretches the light to 0 at its darkest and 1 at its brightest quantile, taken deep inside the outline.
Grey stretched(const Grey& light, const Grey& outline) {
  std::vector<double> values;
  for (Eigen::Index k = 0; k < light.size(); ++k)
    if (outline(k) >= deep_inside) values.push_back(light(k));
  if (values.empty()) return Grey::Zero(light.rows(), light.cols());
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  };
  const double low = at(darkest), range = std::max(at(brightest) - low, least_range);
  return ((light - low) / range).max(0).min(1);
}

/// Returns the sRGB pixel values of a luminance from 0 to 1 (IEC 61966-2-1).
Grey in_srgb(const Grey& luminance) {
  const Grey within = luminance.max(0).min(1);
  return (within <= 0.0031308).select(12.92 * within, 1.055 * within.pow(1 / 2.4) - 0.055);
}

/// Subtracts the mean light around each pixel, taken inside the panel.
Grey against_surroundings(const Grey& light, const Grey& outline, double deviation) {
  const Grey within = (outline >= inside).select(Grey::Ones(light.rows(), light.cols()), 0);
  return light - blurred(light * within, deviation) / blurred(within, deviation).max(1e-6);
}

}  // namespace

std::string far_view(const model::Linkage& panel, const model::State& state, const FarViewOptions& options) {
  const PictureFrame frame = picture_frame(state, margin_in_cells * panel.size.edge_mm);
  const double scale = options.pixels_per_cell / panel.size.edge_mm;
  const double deviation = options.blur_in_cells * options.pixels_per_cell;
  const Grey light = blurred(drawn(panel, state, frame, scale, true), deviation),
             whole = blurred(drawn(panel, state, frame, scale, false), deviation);
  Grey seen = light / whole.max(1e-6);
  if (options.enhanced) {
    if (options.surroundings_in_cells > 0)
      seen = against_surroundings(seen, whole, options.surroundings_in_cells * options.pixels_per_cell);
    seen = stretched(seen, whole);
  } else {
    seen = in_srgb(seen);
  }
  if (options.negative) seen = 1 - seen;
  return grey_png((whole >= inside).select(seen, options.on_white ? 1 : 0));
}

}  // namespace kinetix::app
