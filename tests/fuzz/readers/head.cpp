#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

/// Reads a PLY file as the head for a helmet, as `check` does.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::input_folder().write("input.ply", data, size);
  fuzz::read_or_refuse(
      [&] { fuzz::check_target(fuzz::document_of("target: {kind: helmet, mesh: input.ply}")); });
  return 0;
}
