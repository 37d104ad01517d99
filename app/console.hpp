#pragma once

#include <string>

#include "app/run_curve.hpp"

namespace kinetix {

/// Progress on stderr: a bar where stderr is a terminal, one line per stage where it is not, nothing when
/// quiet.
class Console {
 public:
  explicit Console(bool quiet);
  ~Console();

  void stage(const std::string& name, double done);
  void error(const std::string& message);
  Progress progress();

 private:
  void clear_line();

  bool quiet_, terminal_;
  int shown_percent_ = -1;
  std::string stage_;
};

}  // namespace kinetix
