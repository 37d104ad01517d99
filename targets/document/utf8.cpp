#include "targets/document/utf8.hpp"

namespace kinetix::targets {

std::size_t character_length(std::string_view text, std::size_t start) {
  const auto byte = [&](std::size_t k) {
    return start + k < text.size() ? static_cast<unsigned char>(text[start + k]) : 0u;
  };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  const bool overlong = first < 0xC2 || (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = first > 0xF4 || (first == 0xF4 && second > 0x8F) || (first == 0xED && second > 0x9F);
  if (overlong || beyond) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  return length;
}

}  // namespace kinetix::targets
