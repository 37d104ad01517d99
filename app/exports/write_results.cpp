#include "app/exports/write_results.hpp"

#include <nlohmann/json.hpp>

#include "app/exports/registry.hpp"
#include "app/io/atomic_file.hpp"
#include "app/io/file_record.hpp"
#include "app/result/result_json.hpp"
#include "app/run/stopwatch.hpp"

namespace kinetix::app {
namespace {

constexpr int indent = 1;  // spaces: small, and still one number a line

/// @return whether there is anything to remember
bool add_files(const Run& run, FileSet& files, FileRecord& record) {
  bool remembers = false;
  for (const Exporter* exporter : exporters())
    for (const auto& [name, content] : exporter->write(run)) {
      files.add(name, content);
      if (exporter->of_every_run) continue;
      record.add(name, content);
      remembers = true;
    }
  return remembers;
}

}  // namespace

nlohmann::ordered_json write_results(Run& run, const std::string& folder) {
  Stopwatch watch;
  FileSet files(folder);
  FileRecord record(folder);
  if (add_files(run, files, record)) files.add(FileRecord::name, record.text());
  run.timings.write = watch.lap();
  nlohmann::ordered_json json = result_json(run);
  files.add("result.json", json.dump(indent) + "\n");
  files.commit();
  record.remove_what_is_left_over();
  return json;
}

}  // namespace kinetix::app
