#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

/// Reads a crease pattern as the lattice of a design.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::input_folder().write("input.fold", data, size);
  fuzz::read_or_refuse([&] {
    fuzz::check_design(fuzz::document_of(
        "structure: {lattice: graph, origami: input.fold, tilt_deg: 50}\ndesign: {theta_deg: 25}"));
  });
  return 0;
}
