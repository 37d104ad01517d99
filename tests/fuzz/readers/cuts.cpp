#include "app/files/bodies_section.hpp"
#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

/// Reads a drawing as the cuts of a sheet, and writes the design: SVG if the input has an element, otherwise DXF.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bool is_svg = std::string(reinterpret_cast<const char*>(data), size).find('<') != std::string::npos;
  const std::string name = is_svg ? "input.svg" : "input.dxf";
  fuzz::input_folder().write(name, data, size);
  fuzz::read_or_refuse(
      [&] { design_files(app::read_design(fuzz::document_of("structure: {cuts: " + name + "}"))); });
  return 0;
}
