#pragma once

namespace kinetix::model {

/// Where it is tried whether a motion keeps what it should, rad of theta, near flat, halfway and far on: what
/// fits at one of them by chance does not fit at all three.
inline constexpr double probe_thetas[] = {0.2, 0.5, 0.9};

}  // namespace kinetix::model
