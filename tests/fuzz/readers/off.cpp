#include "tests/fuzz/mesh_of.hpp"

using namespace kinetix;

/// Reads an OFF file as a mesh and as a model.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::input_folder().write("input.off", data, size);
  fuzz::read_as_mesh(file);
  fuzz::read_as_model(file);
  return 0;
}
