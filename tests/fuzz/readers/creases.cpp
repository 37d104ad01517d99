#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

/// Reads a crease pattern as the lattice of a design: SVG if the input has an element, otherwise the lines of ORIPA.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bool is_svg = std::string(reinterpret_cast<const char*>(data), size).find('<') != std::string::npos;
  const std::string name = is_svg ? "input.svg" : "input.cp";
  fuzz::input_folder().write(name, data, size);
  fuzz::read_or_refuse([&] {
    fuzz::check_design(fuzz::document_of("structure: {lattice: graph, origami: " + name +
                                         ", tilt_deg: 50}\ndesign: {theta_deg: 25}"));
  });
  return 0;
}
