#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <memory>
#include <string>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// px a side: half of 32767, at which cairo's images end; a whole image of this size takes a gigabyte.
inline constexpr double most_picture_pixels = 16'000;

/// What a picture shows of the plane, mm.
struct PictureFrame {
  Eigen::Vector2d low, high;
  Eigen::Vector2d size() const { return high - low; }
};

/// All bodies with a margin. @throws std::runtime_error for a state that is not finite
PictureFrame picture_frame(const model::State& state, double margin_mm);

struct DestroyCairo {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, DestroyCairo>;
using CairoPen = std::unique_ptr<cairo_t, DestroyCairo>;

/// A pen that draws in mm, y up. @param scale units of the surface a mm
CairoPen pen_on(cairo_surface_t* surface, const PictureFrame& frame, double scale);

/// For cairo's streams: appends to a std::string.
cairo_status_t append_to_text(void* text, const unsigned char* data, unsigned int length);

/// An image that starts black.
class CairoImage {
 public:
  CairoImage(const PictureFrame& frame, double pixels_per_mm);

  cairo_t* pen() const { return pen_.get(); }
  /// Rows of pixels from the top, 0 to 1.
  Eigen::ArrayXXd grey();
  std::string png();

 private:
  CairoSurface surface_;
  CairoPen pen_;
};

/// A picture of grey values, 0 to 1, row by row from the top. @throws std::runtime_error where it is too
/// large
std::string grey_png(const Eigen::ArrayXXd& picture);

/// All in one stroke: where two overlap, such as the wall tips of a hinge, no pixel of their rims is
/// covered twice.
/// @param grey 0 black, 1 white
void draw_walls(const model::Linkage& panel, const model::State& state, double grey, cairo_t* pen);

}  // namespace kinetix::app
