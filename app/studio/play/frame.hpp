#pragma once

#include <limits>
#include <map>
#include <string>

#include "model/linkage/state.hpp"

namespace kinetix::app::studio {

/// How a shape is computed; the numbers stand in frames.
enum class Mode { exact = 0, equilibrium = 1, bullet = 2 };

/// One shape of the thing, as the page shows it (docs/studio.md, "Frames").
struct Frame {
  int revision = 0;  ///< of the design that it belongs to
  Mode mode = Mode::exact;
  double theta = std::numeric_limits<double>::quiet_NaN();  ///< rad; NaN here and below: there is none
  double seconds = 0;                                       ///< s, simulated
  double force_N = std::numeric_limits<double>::quiet_NaN();
  double energy_Nmm = std::numeric_limits<double>::quiet_NaN();  ///< N mm
  model::State state;                                            ///< mm
  std::map<int, double> heard;  ///< by client: the number of its last command whose effect this shows
};

/// The message of a frame, little-endian. @param number of the frame, which the client acknowledges
std::string frame_bytes(const Frame& frame, std::int64_t number, int client);

}  // namespace kinetix::app::studio
