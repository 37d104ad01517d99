#include "app/panel_picture.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace kinetix {
namespace {

using Eigen::Vector2d;

constexpr double dot_in_edges = 0.09;
constexpr double most_off_centre = 0.42;
constexpr double points_per_mm = 72 / 25.4;
constexpr double most_pixels = 16'000;

struct Frame {
  Vector2d low, high;  ///< mm
  Vector2d size() const { return high - low; }
};

Frame frame_of(const Structure& panel, const State& state) {
  Vector2d low = state.front().p.head<2>(), high = low;
  for (const Pose& pose : state) {
    if (!pose.p.allFinite() || !pose.R.allFinite()) throw std::runtime_error("a state that is not finite has no picture");
    low = low.cwiseMin(pose.p.head<2>());
    high = high.cwiseMax(pose.p.head<2>());
  }
  const Vector2d margin = Vector2d::Constant(panel.size.edge_mm / 2);
  return {low - margin, high + margin};
}

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// Draws in mm, y up, on a page the size of the frame.
class Page {
 public:
  Page(const Frame& frame, const PictureOptions& options) : options_(options) {
    const double scale = is_png() ? pixels_per_mm(frame) : points_per_mm;
    const Vector2d size = scale * frame.size();
    surface_.reset(is_png() ? cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(size.x())),
                                                         static_cast<int>(std::ceil(size.y())))
                            : cairo_svg_surface_create_for_stream(append, &text_, size.x(), size.y()));
    pen_.reset(cairo_create(surface_.get()));
    cairo_set_source_rgb(pen(), 1, 1, 1);
    cairo_paint(pen());
    cairo_scale(pen(), scale, -scale);
    cairo_translate(pen(), -frame.low.x(), -frame.high.y());
  }

  cairo_t* pen() const { return pen_.get(); }

  std::string content() {
    if (is_png()) cairo_surface_write_to_png_stream(surface_.get(), append, &text_);
    const cairo_status_t status = cairo_status(pen());
    pen_.reset();
    cairo_surface_finish(surface_.get());
    surface_.reset();
    if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
    return std::move(text_);
  }

 private:
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* pen) const { cairo_destroy(pen); }
  };

  bool is_png() const { return options_.format == PictureFormat::png; }
  /// Cairo's images end at 32767 pixels a side.
  double pixels_per_mm(const Frame& frame) const {
    return std::min(options_.pixels_per_mm, most_pixels / frame.size().maxCoeff());
  }

  PictureOptions options_;
  std::string text_;
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> pen_;
};

Vector2d hinge_point(const Structure& panel, const State& state, const Hinge& hinge, bool lower) {
  const int body = lower ? hinge.lower : hinge.upper;
  const Eigen::Vector3d arm = panel.hinge_point(hinge) - panel.rest_position(body);
  return (state[body].p + state[body].R * arm).head<2>();
}

void draw_walls(const Structure& panel, const State& state, bool pale, cairo_t* pen) {
  const double grey = pale ? 0.75 : 0;
  cairo_set_source_rgb(pen, grey, grey, grey);
  cairo_set_line_width(pen, panel.size.thickness_mm);
  cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
  for (const Hinge& hinge : panel.hinges)
    for (const bool lower : {true, false}) {
      const Vector2d vertex = state[lower ? hinge.lower : hinge.upper].p.head<2>();
      const Vector2d knee = hinge_point(panel, state, hinge, lower);
      cairo_move_to(pen, vertex.x(), vertex.y());
      cairo_line_to(pen, knee.x(), knee.y());
      cairo_stroke(pen);
    }
}

/// Blue towards the wall's lower end, grey in the middle, red towards its upper end.
void draw_hinges(const Structure& panel, const State& state, cairo_t* pen) {
  for (const Hinge& hinge : panel.hinges) {
    const double off = std::clamp((hinge.parameters.t - 0.5) / most_off_centre, -1.0, 1.0);
    const double strong = std::abs(off), low = 0.55 * (1 - strong);
    cairo_set_source_rgb(pen, off > 0 ? low + 0.85 * strong : low, low, off < 0 ? low + 0.85 * strong : low);
    const Vector2d at = hinge_point(panel, state, hinge, true);
    cairo_arc(pen, at.x(), at.y(), dot_in_edges * panel.size.edge_mm, 0, 2 * pi);
    cairo_fill(pen);
  }
}

}  // namespace

std::string panel_picture(const Structure& panel, const State& state, const PictureOptions& options) {
  Page page(frame_of(panel, state), options);
  draw_walls(panel, state, options.hinges, page.pen());
  if (options.hinges) draw_hinges(panel, state, page.pen());
  return page.content();
}

}  // namespace kinetix
