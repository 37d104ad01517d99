#include "app/exports/write_results.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/exports/exporters.hpp"
#include "app/io/atomic_file.hpp"
#include "app/io/file_record.hpp"
#include "app/result/result_json.hpp"
#include "app/run/stopwatch.hpp"

namespace kinetix::app {
namespace {

constexpr int indent = 1;  // spaces: small, and still one number a line

constexpr const char* design_name = "design.yaml";  // which users change by hand

void add_files(const Run& run, const nlohmann::ordered_json& result, FileSet& files, FileRecord& record) {
  for (const Exporter* exporter : exporters())
    for (const auto& [name, content] : exporter->write(run, result)) {
      files.add(name, content);
      if (!exporter->of_every_run || name == design_name) record.add(name, content);
    }
}

/// The first that is free in the folder.
std::string name_for_changed_design(const std::string& folder) {
  std::string name = "design_changed.yaml";
  for (int k = 2; std::filesystem::exists(std::filesystem::path(folder) / name); ++k)
    name = fmt::format("design_changed_{}.yaml", k);
  return name;
}

/// @return under which name
std::string keep_changed_design(const std::string& folder, const FileRecord& record, FileSet& files) {
  const auto changed = record.changed(design_name);
  if (!changed) return "";
  const std::string name = name_for_changed_design(folder);
  files.add(name, *changed);
  return name;
}

}  // namespace

WrittenResults write_results(const Run& run, const std::string& folder) {
  Stopwatch watch;
  WrittenResults out{result_json(run), ""};
  FileSet files(folder);
  FileRecord record(folder);
  add_files(run, out.result, files, record);
  out.kept_design = keep_changed_design(folder, record, files);
  files.add(FileRecord::name, record.text());
  out.result["timing_s"]["write"] = watch.lap();
  files.add("result.json", out.result.dump(indent) + "\n");
  files.commit();
  record.remove_what_is_left_over();
  return out;
}

}  // namespace kinetix::app
