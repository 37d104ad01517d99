#pragma once

#include <limits>
#include <optional>
#include <string>

namespace kinetix::app {

/// Time left of a stage, extrapolated from the part that is done. The displayed time never increases. If the stage
/// slows down, the time stays the same or gives way to words.
class TimeLeft {
 public:
  /// Updates the estimate. @param seconds since the stage began   @param done share of it, 0 to 1; negative: unknown
  void update(double seconds, double done);
  /// Returns the time left, s. Empty if too little is done for an estimate, or if it takes longer than displayed.
  std::optional<double> at(double seconds);
  /// Returns "about 41 s left", "takes longer than it seemed", or an empty text.
  std::string words(double seconds);

 private:
  bool is_known() const { return total_ < std::numeric_limits<double>::infinity(); }

  double began_ = -1, before_ = 0;                          ///< s and share at the first update
  double done_ = -1;                                        ///< the latest share
  double total_ = std::numeric_limits<double>::infinity();  ///< s, whole stage, extrapolated from that share
  double told_ = std::numeric_limits<double>::infinity();   ///< s left: the least displayed so far
};

/// Formats a duration: "2.3 s", "41 s", "4 min 10 s", "3 h 20 min".
std::string duration_text(double seconds);

}  // namespace kinetix::app
