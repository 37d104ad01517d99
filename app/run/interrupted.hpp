#pragma once

#include <stdexcept>

namespace kinetix::app {

/// A run was told to stop before there was anything to keep. The program says what() and ends with exit code 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kinetix::app
