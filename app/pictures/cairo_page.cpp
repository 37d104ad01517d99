#include "app/pictures/cairo_page.hpp"

#include <cmath>
#include <stdexcept>

namespace kinetix::app {
namespace {

using Eigen::Vector2d;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

int pixels(double length) {
  if (!(length <= most_picture_pixels)) throw std::runtime_error("the picture would have too many pixels");
  return std::max(1, static_cast<int>(std::ceil(length)));
}

std::string png_of(cairo_surface_t* surface) {
  std::string text;
  check(cairo_surface_write_to_png_stream(surface, append_to_text, &text));
  return text;
}

}  // namespace

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

CairoPen pen_on(cairo_surface_t* surface, const PictureFrame& frame, double scale) {
  CairoPen pen(cairo_create(surface));
  cairo_scale(pen.get(), scale, -scale);
  cairo_translate(pen.get(), -frame.low.x(), -frame.high.y());
  return pen;
}

cairo_status_t append_to_text(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
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

}  // namespace kinetix::app
