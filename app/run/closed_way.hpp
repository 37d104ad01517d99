#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::app {

/// How imported bodies went along their drive with all hinges closed.
struct ClosedWay {
  bool reached = false;  ///< its end
  model::State last;     ///< mm
  /// Of bodies that are pulled: distance of the last state from where they are pulled to, cell edges.
  std::optional<model::StateDistance> off = {};
  std::string words;                     ///< how far it goes, in a sentence
  std::vector<std::string> missed = {};  ///< why it does not come to what the drive asks for
};

}  // namespace kinetix::app
