#include "optim/surface/free_height.hpp"

#include "model/contact/wall_contact.hpp"

namespace kinetix::optim {
namespace {

constexpr int states = 40;                  // of the motion: a body turns by less than a degree between two
constexpr double least = 0.02;              // cell edges: lower walls are threads
constexpr double height_tolerance = 0.005;  // cell edges: finer than a layer of a print

bool is_free_at(model::OrigamiSheet sheet, double theta, double height) {
  sheet.structure.size.height_mm = height * sheet.structure.size.edge_mm;
  model::WallContact contact(sheet.structure);
  for (int k = states; k >= 1; --k)
    if (!contact.overlapping(fold(sheet, theta * k / states)).empty()) return false;
  return true;
}

}  // namespace

bool is_free(const model::OrigamiSheet& sheet, double theta) {
  return is_free_at(sheet, theta, sheet.structure.size.height_mm / sheet.structure.size.edge_mm);
}

double free_height(const model::OrigamiSheet& sheet, double theta, double most) {
  if (!is_free_at(sheet, theta, least)) return 0;
  if (is_free_at(sheet, theta, most)) return most;
  double low = least, high = most;
  while (high - low > height_tolerance) {
    const double middle = (low + high) / 2;
    (is_free_at(sheet, theta, middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace kinetix::optim
