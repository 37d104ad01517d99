#include "app/sweep/plan/sweep_plan.hpp"
#include "tests/fuzz/input_folder.hpp"

using namespace kinetix;

/// Reads a doe.yaml with its base.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::input_folder().write("input.yaml", data, size);
  fuzz::read_or_refuse([&] {
    if (app::make_sweep_plan(file, {}).size() < 1) fuzz::fail("a sweep of nothing");
  });
  return 0;
}
