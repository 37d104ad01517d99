#include "tests/fuzz/mesh_of.hpp"

using namespace kinetix;

namespace {

std::string word_of(std::size_t number) {
  std::string word;
  for (int k = 0; k < 4; ++k) word += static_cast<char>(number >> (8 * k) & 0xff);
  return word;
}

std::string chunk(const std::string& kind, std::string content, char padding) {
  while (content.size() % 4 != 0) content += padding;
  return word_of(content.size()) + kind + content;
}

/// Returns a file of version 2 with correct lengths: its JSON up to the first byte 0, then its buffer.
std::string glb_of(const std::string& given) {
  const std::size_t end = std::min(given.find('\0'), given.size());
  std::string chunks = chunk("JSON", given.substr(0, end), ' ');
  if (end < given.size()) chunks += chunk(std::string("BIN\0", 4), given.substr(end + 1), '\0');
  return "glTF" + word_of(2) + word_of(12 + chunks.size()) + chunks;
}

}  // namespace

/// Reads a binary glTF file, or its content: JSON, then its buffer. Reads it as a model and as a mesh.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string given(reinterpret_cast<const char*>(data), size);
  const std::string file = given.starts_with('{') ? glb_of(given) : given;
  const std::string path = fuzz::input_folder().write("input.glb", file);
  fuzz::read_as_model(path);
  fuzz::read_as_mesh(path);
  return 0;
}
