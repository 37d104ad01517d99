#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

namespace kinetix::app::studio {

inline constexpr int most_clients = 8;                      // pages: more than one person opens
inline constexpr std::size_t most_connections = 64;         // a browser needs several while it loads
inline constexpr std::size_t largest_message = 768 << 10;   // bytes: a picture or a scan in base64
inline constexpr std::size_t largest_request = 8 << 10;     // bytes of an HTTP header
inline constexpr std::size_t longest_ack = 100;             // bytes of a text that may be an acknowledgement
inline constexpr int most_in_flight = 2;                    // frames not yet acknowledged by a page
inline constexpr std::size_t most_bytes_waiting = 1 << 20;  // answers to a page that does not read
inline constexpr std::size_t most_commands = 64;            // waiting; a page at this limit is not read
inline constexpr std::size_t most_command_bytes = 2 << 20;  // bytes of those commands
inline constexpr std::chrono::seconds patience{5};          // for a request, and for a first message

inline constexpr std::string_view policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: "
    "blob:; "
    "media-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Compares in constant time.
inline bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char differs = 0;
  for (std::size_t k = 0; k < a.size(); ++k) differs |= static_cast<unsigned char>(a[k] ^ b[k]);
  return differs == 0;
}

}  // namespace kinetix::app::studio
