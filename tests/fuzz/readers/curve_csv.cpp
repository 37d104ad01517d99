#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

/// Reads the points of a curve in the plane, and of a curve in space.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::input_folder().write("input.csv", data, size);
  for (const char* kind : {"curve", "space_curve", "outline"})
    fuzz::read_or_refuse([&] {
      fuzz::check_target(fuzz::document_of("target: {kind: " + std::string(kind) + ", points: input.csv}"));
    });
  return 0;
}
