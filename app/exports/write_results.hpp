#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

struct WrittenResults {
  nlohmann::ordered_json result;  ///< result.json
  std::string kept_design;  ///< new name of a design.yaml that was changed since a run wrote it; else empty
};

/// Writes DIR/result.json and the files of all exporters (app/exports/exporters.hpp), or none of them. Removes files that only an
/// earlier run had. Renames a changed design.yaml. @throws InvalidInput if the folder cannot be written
WrittenResults write_results(const Run& run, const std::string& folder);

}  // namespace kinetix::app
