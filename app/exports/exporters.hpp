#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
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

/// design.yaml, as verify and simulate read it, and the meshes of imported bodies.
extern const Exporter design_export;
/// report.html: one page that shows the result and needs no other file.
extern const Exporter report_export;

/// Lists what every run writes, in order: these two, the creases of sheets of other lattices than squares as a FOLD file, and the pictures of
/// the goal.
const std::vector<const Exporter*>& exporters();

/// Adds an exporter, for programs that link this library. Not while others read the list.
/// @param exporter must outlive all use; no other one writes files of its names
void add_exporter(const Exporter& exporter);

struct WrittenResults {
  nlohmann::ordered_json result;  ///< result.json
  std::string kept_design;  ///< new name of a design.yaml that was changed since a run wrote it; else empty
};

/// Writes DIR/result.json and the files of all exporters (app/exports/exporters.hpp), or none of them. Removes files that only an
/// earlier run had. Renames a changed design.yaml. @throws InvalidInput if the folder cannot be written
WrittenResults write_results(const Run& run, const std::string& folder);

}  // namespace kinetix::app
