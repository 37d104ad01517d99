#pragma once

#include <nlohmann/json.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Writer of files next to result.json.
struct Exporter {
  std::string_view name;
  std::vector<std::string_view> extensions;  ///< file extensions, without the dot
  bool of_every_run;  ///< every run writes these files; files of other exporters are removed by a later run
  /// Returns the files of a run, none if it has nothing of the kind. @param result the run's result.json
  std::vector<NamedContent> (*write)(const Run& run, const nlohmann::ordered_json& result);
};

/// Exporter of design.yaml, which verify and simulate read, and of the meshes of imported bodies.
extern const Exporter design_export;
/// Exporter of report.html, one page that shows the result and needs no other file.
extern const Exporter report_export;

/// Lists all exporters in order: design, creases as a FOLD file (sheets that fold as a crease pattern), pictures of the
/// goal, report.
const std::vector<const Exporter*>& exporters();

/// Adds an exporter, for programs that link this library. Not thread-safe against readers of the list.
/// @param exporter must outlive all use; no other one writes files of its names
void add_exporter(const Exporter& exporter);

struct WrittenResults {
  nlohmann::ordered_json result;  ///< result.json
  std::string kept_design;  ///< new name of a design.yaml that was changed since a run wrote it; else empty
};

/// Writes result.json and the files of all exporters into the folder, or none of them. Removes files that only an
/// earlier run wrote. Keeps a changed design.yaml under a new name.
/// @throws InvalidInput if the folder cannot be written
WrittenResults write_results(const Run& run, const std::string& folder);

}  // namespace kinetix::app
