#include "app/io/bytes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/sha.h>
#include <array>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <new>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {

std::string from_base64(std::string_view text) {
  using namespace boost::archive::iterators;
  using Bytes = transform_width<binary_from_base64<const char*>, 8, 6>;
  const InvalidInput wrong("files: must be base64");
  const std::string_view digits = text.substr(0, text.find('='));
  if (text.size() % 4 != 0 || text.size() - digits.size() > 2 ||
      text.find_first_not_of('=', digits.size()) != std::string_view::npos)
    throw wrong;
  try {
    std::string out(Bytes(digits.data()), Bytes(digits.data() + digits.size()));
    out.resize(digits.size() * 3 / 4);
    return out;
  } catch (const dataflow_exception&) {
    throw wrong;
  }
}

std::string to_base64(std::string_view bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<const char*, 6, 8>>;
  std::string out(Digits(bytes.data()), Digits(bytes.data() + bytes.size()));
  out.append((3 - bytes.size() % 3) % 3, '=');
  return out;
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  if (SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data()) == nullptr)
    throw std::bad_alloc();  // the only failure of a hash that the library has
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace kinetix::app
