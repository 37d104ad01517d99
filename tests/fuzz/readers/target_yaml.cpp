#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

/// Reads a target.yaml.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::input_folder().write("input.yaml", data, size);
  fuzz::read_or_refuse([&] { fuzz::check_target(targets::read_document(file)); });
  return 0;
}
