#pragma once

#include <limits>
#include <optional>
#include <string>

namespace kinetix::app {

/// How long a stage still takes, by the time that its part took which is done. What is told never goes up: it counts down
/// between two shares, and where later ones come slower it stands, or gives way to words.
class TimeLeft {
 public:
  /// @param seconds since the stage began   @param done share of it, 0 to 1 (negative: not known)
  void update(double seconds, double done);
  /// s; nothing where too little is done to tell, and where it takes longer than was told
  std::optional<double> at(double seconds);
  /// "about 41 s left", "takes longer than it seemed", or nothing
  std::string words(double seconds);

 private:
  bool is_known() const { return total_ < std::numeric_limits<double>::infinity(); }

  double began_ = -1, before_ = 0;                          ///< s and share at the first word of it
  double done_ = -1;                                        ///< the latest share
  double total_ = std::numeric_limits<double>::infinity();  ///< s, of the stage by that share
  double told_ = std::numeric_limits<double>::infinity();   ///< s left: the least that was said
};

/// "2.3 s", "41 s", "4 min 10 s", "3 h 20 min"
std::string duration_text(double seconds);

}  // namespace kinetix::app
