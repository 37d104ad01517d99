#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace kinetix::app {

// Messages between processes of one machine: values as they are in memory.

template <class Value>
void put(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
void append_all(std::string& bytes, const Value* values, std::size_t count) {
  put(bytes, count);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

/// Reader of what put() and append_all() wrote. Lengths are checked before anything is allocated: the sender may have
/// crashed.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  /// @throws std::runtime_error if the message ends early
  template <class Value>
  Value get() {
    Value value;
    std::memcpy(static_cast<void*>(&value), take(sizeof value), sizeof value);
    return value;
  }

  /// Reads a vector or a string. @throws std::runtime_error if the message ends early
  template <class Container>
  Container extract_all() {
    using Value = typename Container::value_type;
    const auto count = get<std::size_t>();
    if (count > bytes_.size() / sizeof(Value)) cut_short();
    Container values;
    values.resize(count);
    if (const char* from = take(count * sizeof(Value)); count > 0)
      std::memcpy(static_cast<void*>(values.data()), from, count * sizeof(Value));
    return values;
  }

 private:
  [[noreturn]] static void cut_short() {
    throw std::runtime_error("a message between processes was cut short");
  }

  const char* take(std::size_t size) {
    if (size > bytes_.size()) cut_short();
    const char* at = bytes_.data();
    bytes_.remove_prefix(size);
    return at;
  }

  std::string_view bytes_;
};

/// Decodes base64. @throws InvalidInput for text that is not base64 with its padding
std::string from_base64(std::string_view text);
/// Encodes base64 with its padding.
std::string to_base64(std::string_view bytes);

/// Returns SHA-256 (FIPS 180-4) in hexadecimal, as `sha256sum` prints it.
std::string sha256(std::string_view bytes);

}  // namespace kinetix::app
