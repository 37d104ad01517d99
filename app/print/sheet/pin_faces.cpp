#include "app/print/sheet/pin_faces.hpp"

#include <algorithm>

namespace kinetix::app {
namespace {

constexpr double fdm_line_mm = 0.4, fdm_layer_mm = 0.2;  // mm: of FDM with a usual nozzle

}  // namespace

model::HingePrint with_faces(model::HingePrint pin, const model::Process& process) {
  const double clearance = pin.made.clearance_mm;
  pin.axial_clearance_mm = std::max(clearance, process.upright_clearance_mm);
  if (process.name != "fdm" || pin.loose) return pin;
  pin.rim_mm = fdm_line_mm;
  pin.axial_clearance_mm = std::max(pin.axial_clearance_mm, model::cone_rise * clearance + fdm_layer_mm);
  return pin;
}

}  // namespace kinetix::app
