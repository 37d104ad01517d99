#pragma once

#include "targets/document/keys.hpp"
#include "targets/helmet/head_pose.hpp"

namespace kinetix::targets {

/// The units of a mesh, as files name them.
inline constexpr Word<LengthUnit> length_units[] = {
    {"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}, {"in", LengthUnit::inch}};

}  // namespace kinetix::targets
