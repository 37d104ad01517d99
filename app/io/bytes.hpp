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
void put_all(std::string& bytes, const Value* values, std::size_t count) {
  put(bytes, count);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

/// Reads what put() and put_all() wrote. Lengths are checked before anything is allocated: the sender may have crashed.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  /// @throws std::runtime_error where the message ends early
  template <class Value>
  Value get() {
    Value value;
    std::memcpy(static_cast<void*>(&value), take(sizeof value), sizeof value);
    return value;
  }

  /// A vector or a string. @throws std::runtime_error where the message ends early
  template <class Container>
  Container get_all() {
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

}  // namespace kinetix::app
