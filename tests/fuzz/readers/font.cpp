#include "targets/display/glyph_goal.hpp"
#include "tests/fuzz/input_folder.hpp"

using namespace kinetix;

/// Reads a font and draws a letter of two parts.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::input_folder().write("input.ttf", data, size);
  for (const char* text : {"\xc3\x84", "A."})
    fuzz::read_or_refuse([&] { targets::glyph_picture(text, {"input", file, 0}); });
  return 0;
}
