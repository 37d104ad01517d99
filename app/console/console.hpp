#pragma once

#include <string>

#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Progress on stderr: a bar where stderr is a terminal, one line per stage where it is not, nothing when
/// quiet.
class Console {
 public:
  explicit Console(bool quiet);
  ~Console();

  /// @param done share of the stage, 0 to 1 (negative: not known)
  /// @param note stands behind the bar of a terminal, e.g. the time left
  void stage(const std::string& name, double done, const std::string& note = {});
  void error(const std::string& message);
  Progress progress();

 private:
  void clear_line();

  bool quiet_, terminal_;
  int shown_percent_ = -1;
  std::string stage_, note_;
};

}  // namespace kinetix::app
