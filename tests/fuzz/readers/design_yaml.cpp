#include "app/files/bodies_section.hpp"
#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

namespace {

/// Checks that a design and its written text have the same content.
void expect_round_trip(const app::Design& design) {
  const std::string text = design_text(design), file = fuzz::input_folder().path("again.yaml");
  try {
    if (design_text(app::read_design(targets::parse_document(text, file))) != text)
      fuzz::fail("another design is read back than was written:\n" + text);
  } catch (const InvalidInput& e) {
    fuzz::fail(std::string("our own text is refused: ") + e.what() + "\n" + text);
  }
}

void read(const std::string& file) {
  const targets::Node root = targets::read_document(file, app::max_design_bytes);
  if (app::lists_bodies(root)) return void(design_files(app::read_design(root)));
  expect_round_trip(app::read_design(root));
  fuzz::check_design(root);
}

}  // namespace

/// Reads a design.yaml of a sheet or of general bodies.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::input_folder().write("input.yaml", data, size);
  fuzz::read_or_refuse([&] { read(file); });
  return 0;
}
