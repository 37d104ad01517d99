#pragma once

#include <optional>
#include <string>

#include "app/files/design_file.hpp"
#include "app/run/goal.hpp"

namespace kinetix::app {

/// File that a sweep varies: a design (forward runs) or a target (a search in every sample).
struct SweepBase {
  targets::Node root;
  std::optional<Design> design;
  std::optional<Target> target;  ///< empty if the file is a design

  /// Returns whether the base is a design of imported bodies.
  bool has_bodies() const { return design && design->structure.assembly(); }
};

/// @throws InvalidInput as read_design and read_target
SweepBase read_base(const std::string& file);

}  // namespace kinetix::app
