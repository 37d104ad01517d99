#include "app/print/sheet/pin_faces.hpp"

#include <algorithm>

namespace kinetix::app {
namespace {

double axial_clearance_mm(double clearance_mm, const model::Process& process, bool inclined) {
  const double flat = std::max(clearance_mm, process.upright_clearance_mm);
  return inclined ? std::max(flat, model::cone_rise * clearance_mm + process.filament->layer_mm) : flat;
}

}  // namespace

model::HingePrint with_faces(model::HingePrint pin, const model::Process& process) {
  const bool inclined = process.filament && !pin.loose;
  pin.axial_clearance_mm = axial_clearance_mm(pin.made.clearance_mm, process, inclined);
  if (inclined) pin.rim_mm = process.filament->line_mm;
  return pin;
}

double least_pin_height_mm(double clearance_mm, const model::Process& process) {
  return 4 * axial_clearance_mm(clearance_mm, process, process.filament.has_value());
}

}  // namespace kinetix::app
