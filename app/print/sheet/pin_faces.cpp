#include "app/print/sheet/pin_faces.hpp"

#include <algorithm>

namespace kinetix::app {

namespace {

/// Between inclined faces, or between flat ones where the process prints none.
double axial_clearance_mm(double clearance_mm, const model::Process& process) {
  const double flat = std::max(clearance_mm, process.upright_clearance_mm);
  if (!process.filament) return flat;
  return std::max(flat, model::cone_rise * clearance_mm + process.filament->layer_mm);
}

}  // namespace

model::HingePrint with_faces(model::HingePrint pin, const model::Process& process) {
  const double clearance = pin.made.clearance_mm;
  pin.axial_clearance_mm = std::max(clearance, process.upright_clearance_mm);
  if (!process.filament || pin.loose) return pin;
  pin.rim_mm = process.filament->line_mm;
  pin.axial_clearance_mm = axial_clearance_mm(clearance, process);
  return pin;
}

double least_pin_height_mm(double clearance_mm, const model::Process& process) {
  return 4 * axial_clearance_mm(clearance_mm, process);
}

}  // namespace kinetix::app
