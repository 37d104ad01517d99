#pragma once

namespace kinetix::model {

/// Values of theta, rad, at which a motion is tested for the properties it should keep: near flat, halfway
/// and far. A fit at one of them by chance is not a fit at all three.
inline constexpr double probe_thetas[] = {0.2, 0.5, 0.9};

}  // namespace kinetix::model
