#pragma once

#include <optional>
#include <string>

#include "app/assembly/assembly_file.hpp"
#include "app/files/design_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// The file that a sweep varies: a design, of a sheet or of general bodies (forward runs), or a target (a search in every sample).
struct SweepBase {
  targets::Node root;
  std::optional<Design> design;             ///< of a sheet
  std::optional<AssemblyFile> bodies = {};  ///< a design of general bodies
  std::optional<Target> target;             ///< where it is no design
};

/// @throws InvalidInput as read_design and read_target
SweepBase read_base(const std::string& file);

}  // namespace kinetix::app
