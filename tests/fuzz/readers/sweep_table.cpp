#include <nlohmann/json.hpp>

#include "app/sweep/table/sweep_table.hpp"
#include "tests/fuzz/input_folder.hpp"

using namespace kinetix;

namespace {

const app::SweepPlan& plan() {
  static const app::SweepPlan plan = app::make_sweep_plan(fuzz::input_folder().path("eq3_area.yaml"), {});
  return plan;
}

/// An identity that is shorter than that of a run, and the same for every version of the program.
const app::SweepIdentity identity = {{"schema", "kinetix-sweep/1"}};

/// Reads a complete table as `sweep --resume` does.
void resume(const std::string& folder) {
  const app::SweepTable table(folder, plan(), identity, true);
  sweep_json(plan(), identity, table).dump();
  write_csv(folder, table, plan(), identity);
}

}  // namespace

/// Reads a sweep.sqlite that is to be resumed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string folder = fuzz::input_folder().path("out");
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  fuzz::input_folder().write("out/sweep.sqlite", data, size);
  fuzz::read_or_refuse([&] { resume(folder); });
  return 0;
}
