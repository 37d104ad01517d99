#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Something that a run leaves beside result.json.
struct Exporter {
  std::string_view name;
  std::vector<std::string_view> extensions;  ///< of its files, without the point
  bool of_every_run;  ///< one run's replace another's; else those of an earlier run in the folder go
  /// Returns the files of a run, none if it has nothing of the kind. @param result the run's result.json
  std::vector<NamedContent> (*write)(const Run& run, const nlohmann::ordered_json& result);
};

}  // namespace kinetix::app
