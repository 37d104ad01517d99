#pragma once

#include <vector>

#include "model/sheet/sheet.hpp"
#include "model/tolerance/observed_points.hpp"
#include "targets/curve/curve.hpp"

namespace kinetix::app {

/// Each column of bodies against the curve as it is laid over their midline. mm
/// @param state anywhere in space; points are in its frame   @param upright what it is turned to first, with the
/// strip's width along y
std::vector<model::ObservedPoint> curve_points(const targets::Curve& curve, const model::Sheet& sheet,
                                               const model::State& state, const model::State& upright);

}  // namespace kinetix::app
