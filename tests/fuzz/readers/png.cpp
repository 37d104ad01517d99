#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

namespace {

std::size_t number_at(const std::string& bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t k = at; k < at + 4; ++k) number = number << 8 | static_cast<unsigned char>(bytes[k]);
  return number;
}

/// Computes the checksum of a PNG chunk (W3C 2003, annex D).
std::uint32_t sum_of(std::string_view bytes) {
  constexpr std::uint32_t polynomial = 0xedb88320;  // CRC-32 polynomial, lowest power first
  std::uint32_t sum = 0xffffffff;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? polynomial : 0);
  }
  return ~sum;
}

/// Returns the bytes with the correct checksum in each chunk. libpng skips chunks with wrong checksums.
std::string with_right_sums(std::string bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = number_at(bytes, at), end = at + 8 + length;
    if (end + 4 > bytes.size()) break;
    const std::uint32_t sum = sum_of(std::string_view(bytes).substr(at + 4, 4 + length));
    for (int k = 0; k < 4; ++k) bytes[end + k] = static_cast<char>(sum >> (24 - 8 * k) & 0xff);
    at = end + 4;
  }
  return bytes;
}

}  // namespace

/// Reads a picture as the goal of a display. Its content decides the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string given(reinterpret_cast<const char*>(data), size);
  fuzz::input_folder().write("input.png", given.starts_with("\x89PNG") ? with_right_sums(given) : given);
  fuzz::read_or_refuse(
      [&] { fuzz::check_target(fuzz::document_of("target: {kind: display, image: input.png}")); });
  return 0;
}
