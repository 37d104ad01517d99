#pragma once

#include <string>
#include <vector>

namespace kinetix::bench {

/// One way to compute a folded state, with what it costs and how good it is.
struct MeasuredPoint {
  std::string method = {};     ///< as the legend names it
  std::string settings = {};   ///< in words
  std::string precision = {};  ///< of its floating-point numbers: double or single
  double seconds = 0;          ///< of one run, median over repeats
  double spread = 0;        ///< of the repeats: longest less shortest, over the median; 0 where it ran once
  double error = 0;         ///< rms of body positions after rigid alignment, cell edges; NaN without a state
  std::string status = {};  ///< in the method's own words
  bool is_result = false;   ///< what the method itself calls a result (settled, reached)
};

using MeasuredPoints = std::vector<MeasuredPoint>;

/// Legend entry that a point belongs to.
inline std::string series_of(const MeasuredPoint& point) {
  return point.precision == "single" ? point.method + ", single precision" : point.method;
}

}  // namespace kinetix::bench
