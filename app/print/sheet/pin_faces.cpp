#include "app/print/sheet/pin_faces.hpp"

#include <algorithm>

namespace kinetix::app {

model::HingePrint with_faces(model::HingePrint pin, const model::Process& process) {
  const double clearance = pin.made.clearance_mm;
  pin.axial_clearance_mm = std::max(clearance, process.upright_clearance_mm);
  if (!process.filament || pin.loose) return pin;
  pin.rim_mm = process.filament->line_mm;
  pin.axial_clearance_mm =
      std::max(pin.axial_clearance_mm, model::cone_rise * clearance + process.filament->layer_mm);
  return pin;
}

}  // namespace kinetix::app
