#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

/// A PLY file as the head that a helmet is made for, as far as `check` goes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::input_folder().write("input.ply", data, size);
  fuzz::read_or_refuse(
      [&] { fuzz::check_target(fuzz::document_of("target: {kind: helmet, mesh: input.ply}")); });
  return 0;
}
