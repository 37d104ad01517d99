#pragma once

namespace kinetix::app {

constexpr double metres_per_mm = 1e-3;  // m/mm: glTF and MuJoCo count in metres
constexpr double mm3_per_cm3 = 1e3;     // mm^3/cm^3: people buy material by cm^3, slicers tell it so

}  // namespace kinetix::app
