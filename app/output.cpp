#include "app/output.hpp"

#include <filesystem>

#include "app/atomic_file.hpp"
#include "app/design_file.hpp"
#include "app/display_json.hpp"
#include "app/report/report.hpp"
#include "app/result_json.hpp"
#include "app/stopwatch.hpp"

namespace kinetix {
namespace {

constexpr int indent = 1;

DesignFile design_of(const Run& run) {
  DesignFile design;
  design.name = run.name;
  design.structure = run.structure;
  design.theta = run.equilibrium ? run.equilibrium->drive.theta() : run.theta;
  design.physics = run.physics;
  design.hinge = run.hinge;
  design.drive = run.drive;
  design.side = run.side;
  return design;
}

void write_pictures(const Run& run, const std::string& folder) {
  std::filesystem::create_directories(folder + "/frames");
  for (const auto& [name, content] : display_pictures(run)) write_file(folder + "/" + name, content);
}

}  // namespace

nlohmann::ordered_json write_results(Run& run, const std::string& folder) {
  Stopwatch watch;
  write_file(folder + "/design.yaml", design_text(design_of(run)));
  nlohmann::ordered_json shown = result_json(run);
  shown["timing_s"].erase("write");
  if (run.display) write_pictures(run, folder);
  write_file(folder + "/report.html", report_html(shown.dump()));
  run.timings.write = watch.lap();
  nlohmann::ordered_json json = result_json(run);
  write_file(folder + "/result.json", json.dump(indent) + "\n");
  return json;
}

}  // namespace kinetix
