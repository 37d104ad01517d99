#include "app/io/sha256.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/sha.h>

#include <array>
#include <new>

namespace kinetix::app {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  if (SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data()) == nullptr)
    throw std::bad_alloc();  // the only failure of a hash that the library has
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace kinetix::app
