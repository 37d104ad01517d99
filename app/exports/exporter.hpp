#pragma once

#include <string_view>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Something that a run leaves beside result.json.
struct Exporter {
  std::string_view name;
  std::vector<std::string_view> extensions;  ///< of its files, without the point
  bool of_every_run;  ///< one run's replace another's; else those of an earlier run in the folder go
  /// None where the run has nothing of the kind.
  std::vector<NamedContent> (*write)(const Run& run);
};

}  // namespace kinetix::app
