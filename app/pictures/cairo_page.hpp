#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <memory>
#include <string>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// Largest side of an image, px: half of cairo's limit of 32767. A square image of this size takes a gigabyte.
inline constexpr double most_picture_pixels = 16'000;

/// Part of the plane that a picture shows, mm.
struct PictureFrame {
  Eigen::Vector2d low, high;
  Eigen::Vector2d size() const { return high - low; }
};

/// Returns the frame around all bodies, with a margin. @throws std::runtime_error for a state that is not finite
PictureFrame picture_frame(const model::State& state, double margin_mm);

struct DestroyCairo {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, DestroyCairo>;
using CairoPen = std::unique_ptr<cairo_t, DestroyCairo>;

/// Returns a pen that draws in mm, with y up. @param scale units of the surface per mm
CairoPen pen_on(cairo_surface_t* surface, const PictureFrame& frame, double scale);

/// Appends data to a std::string; callback for cairo's streams.
cairo_status_t append_to_text(void* text, const unsigned char* data, unsigned int length);

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

/// Returns a PNG of grey values, 0 to 1, in rows from the top. @throws std::runtime_error if it is too large
std::string grey_png(const Eigen::ArrayXXd& picture);

/// Draws all walls in one stroke. Where walls overlap, such as at hinges, edge pixels are not blended twice.
/// @param grey 0 black, 1 white
void draw_walls(const model::Linkage& panel, const model::State& state, double grey, cairo_t* pen);

}  // namespace kinetix::app
