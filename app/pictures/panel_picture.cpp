#include "app/pictures/panel_picture.hpp"

#include <cairo-svg.h>
#include <cairo.h>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "model/opening/cell_opening.hpp"

namespace kinetix::app {
namespace {

/// Largest side of an image, px: half of cairo's limit of 32767. A square image of this size takes a gigabyte.
inline constexpr double max_picture_pixels = 16'000;

/// Part of the plane that a picture shows, mm.
struct PictureFrame {
  Eigen::Vector2d low, high;
  Eigen::Vector2d size() const { return high - low; }
};

struct DestroyCairo {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, DestroyCairo>;
using CairoPen = std::unique_ptr<cairo_t, DestroyCairo>;

/// Image that is black at first.
class CairoImage {
 public:
  CairoImage(const PictureFrame& frame, double pixels_per_mm);

  cairo_t* pen() const { return pen_.get(); }
  /// Returns the grey values, 0 to 1, in rows from the top.
  Eigen::ArrayXXd grey();
  std::string png();

 private:
  CairoSurface surface_;
  CairoPen pen_;
};

using Eigen::Vector2d;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

int pixels(double length) {
  if (!(length <= max_picture_pixels)) throw std::runtime_error("the picture would have too many pixels");
  return std::max(1, static_cast<int>(std::ceil(length)));
}

/// Appends data to a std::string; callback for cairo's streams.
cairo_status_t append_to_text(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

std::string png_of(cairo_surface_t* surface) {
  std::string text;
  check(cairo_surface_write_to_png_stream(surface, append_to_text, &text));
  return text;
}

/// Returns the frame around all bodies, with a margin. @throws std::runtime_error for a state that is not finite
PictureFrame picture_frame(const model::State& state, double margin_mm) {
  if (!is_finite(state)) throw std::runtime_error("a state that is not finite has no picture");
  PictureFrame frame{state.front().p.head<2>(), state.front().p.head<2>()};
  for (const model::Pose& pose : state) {
    frame.low = frame.low.cwiseMin(pose.p.head<2>());
    frame.high = frame.high.cwiseMax(pose.p.head<2>());
  }
  frame.low.array() -= margin_mm;
  frame.high.array() += margin_mm;
  return frame;
}

/// Returns a pen that draws in mm, with y up. @param scale units of the surface per mm
CairoPen pen_on(cairo_surface_t* surface, const PictureFrame& frame, double scale) {
  CairoPen pen(cairo_create(surface));
  cairo_scale(pen.get(), scale, -scale);
  cairo_translate(pen.get(), -frame.low.x(), -frame.high.y());
  return pen;
}

CairoImage::CairoImage(const PictureFrame& frame, double pixels_per_mm)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(pixels_per_mm * frame.size().x()),
                                          pixels(pixels_per_mm * frame.size().y()))),
      pen_(pen_on(surface_.get(), frame, pixels_per_mm)) {}

Eigen::ArrayXXd CairoImage::grey() {
  check(cairo_status(pen()));
  cairo_surface_flush(surface_.get());
  const int columns = cairo_image_surface_get_width(surface_.get()),
            rows = cairo_image_surface_get_height(surface_.get()),
            stride = cairo_image_surface_get_stride(surface_.get());
  const unsigned char* data = cairo_image_surface_get_data(surface_.get());
  Eigen::ArrayXXd out(rows, columns);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) out(r, c) = data[r * stride + 4 * c] / 255.0;
  return out;
}

std::string CairoImage::png() {
  check(cairo_status(pen()));
  return png_of(surface_.get());
}

/// Returns a PNG of grey values, 0 to 1, in rows from the top. @throws std::runtime_error if it is too large
std::string grey_png(const Eigen::ArrayXXd& picture) {
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                        pixels(static_cast<double>(picture.cols())),
                                                        pixels(static_cast<double>(picture.rows()))));
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (Eigen::Index r = 0; r < picture.rows(); ++r)
    for (Eigen::Index c = 0; c < picture.cols(); ++c)
      for (int k = 0; k < 3; ++k)
        data[r * stride + 4 * c + k] = static_cast<unsigned char>(std::lround(255 * picture(r, c)));
  cairo_surface_mark_dirty(surface.get());
  return png_of(surface.get());
}

/// Draws all walls in one stroke. Where walls overlap, such as at hinges, edge pixels are not blended twice.
/// @param grey 0 black, 1 white
void draw_walls(const model::Linkage& panel, const model::State& state, double grey, cairo_t* pen) {
  cairo_set_source_rgb(pen, grey, grey, grey);
  cairo_set_line_width(pen, panel.size.thickness_mm);
  cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
  for (const model::Plate& plate : panel.plates) {
    const model::Pose& pose = state[plate.body];
    const Eigen::Vector3d wall_tip = pose.p + panel.size.edge_mm * plate.length * (pose.R * plate.edge);
    cairo_move_to(pen, pose.p.x(), pose.p.y());
    cairo_line_to(pen, wall_tip.x(), wall_tip.y());
  }
  cairo_stroke(pen);
}

// Radius of dots, cell edges: dots are wider than walls of the usual thickness, a tenth of an edge.
constexpr double dot_in_edges = 0.09;
// Distance from the wall's middle at which a dot has its full colour, fraction of the wall: ends of the usual range of
// t, 0.08 and 0.92.
constexpr double most_off_centre = 0.42;
constexpr double pale = 0.75;                // grey of the walls, 0 to 1: dots stand out against it
constexpr double points_per_mm = 72 / 25.4;  // cairo's SVG unit is the point, 72 per inch

/// Draws the hinges: blue towards the wall's lower end, grey in the middle, red towards its upper end.
void draw_hinges(const model::Linkage& panel, const model::State& state, cairo_t* pen) {
  const double L = panel.size.edge_mm;
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) {
    const model::RestHinge& hinge = panel.hinges[h];
    const double lower = panel.plates[2 * h].length, whole = lower + panel.plates[2 * h + 1].length;
    const double off = std::clamp((lower / whole - 0.5) / most_off_centre, -1.0, 1.0);
    const double strong = std::abs(off), low = 0.55 * (1 - strong);
    cairo_set_source_rgb(pen, off > 0 ? low + 0.85 * strong : low, low, off < 0 ? low + 0.85 * strong : low);
    const Eigen::Vector3d at = state[hinge.lower].p + L * (state[hinge.lower].R * hinge.lower_arm);
    cairo_arc(pen, at.x(), at.y(), dot_in_edges * L, 0, 2 * pi);
    cairo_fill(pen);
  }
}

void draw(const model::Linkage& panel, const model::State& state, bool hinges, cairo_t* pen) {
  cairo_set_source_rgb(pen, 1, 1, 1);
  cairo_paint(pen);
  draw_walls(panel, state, hinges ? pale : 0, pen);
  if (hinges) draw_hinges(panel, state, pen);
}

std::string svg(const model::Linkage& panel, const model::State& state, bool hinges,
                const PictureFrame& frame) {
  std::string text;
  const Eigen::Vector2d size = points_per_mm * frame.size();
  const CairoSurface surface(cairo_svg_surface_create_for_stream(append_to_text, &text, size.x(), size.y()));
  {
    const CairoPen pen = pen_on(surface.get(), frame, points_per_mm);
    draw(panel, state, hinges, pen.get());
  }
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(cairo_status_to_string(cairo_surface_status(surface.get())));
  return text;
}

}  // namespace

std::string panel_picture(const model::Linkage& panel, const model::State& state,
                          const PictureOptions& options) {
  const PictureFrame frame = picture_frame(state, panel.size.edge_mm / 2);
  if (options.format == PictureFormat::svg) return svg(panel, state, options.hinges, frame);
  CairoImage image(frame, std::min(options.pixels_per_mm, options.max_pixels / frame.size().maxCoeff()));
  draw(panel, state, options.hinges, image.pen());
  return image.png();
}

namespace {

using Grey = Eigen::ArrayXXd;  ///< pixels by row and column, 0 to 1

// Cell edges: more than three times the usual blur, so the boundary fades out within the picture.
constexpr double margin_in_cells = 2;
// Quantiles of the light that become black and white. Beyond them are single openings, which would leave the rest grey.
constexpr double darkest = 0.02, brightest = 0.98;
// Fractions of the blurred outline: it is a half at the panel's edge. Near 1, the boundary has no effect.
constexpr double inside = 0.5, deep_inside = 0.98;
// Least range of light to stretch, ratio: an eye does not see differences of a fiftieth.
constexpr double min_range = 0.02;
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
  const double low = at(darkest), range = std::max(at(brightest) - low, min_range);
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
