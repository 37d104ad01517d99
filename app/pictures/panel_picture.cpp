#include "app/pictures/panel_picture.hpp"

#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/pictures/cairo_page.hpp"

namespace kinetix::app {
namespace {

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
  CairoImage image(frame, std::min(options.pixels_per_mm, options.most_pixels / frame.size().maxCoeff()));
  draw(panel, state, options.hinges, image.pen());
  return image.png();
}

}  // namespace kinetix::app
