#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "app/studio/play/frame.hpp"

namespace kinetix::app::studio {

/// A file that the server hands out: the only ones that there are.
struct WebFile {
  std::string_view path;  ///< "/" and so on
  std::string_view type;  ///< of its content
  std::string_view content;
};

/// What the server tells of its clients; calls come from the thread of run().
struct Visitors {
  std::function<void(int client)> come;
  std::function<void(int client, std::string text)> say;
  std::function<void(int client)> go;
};

/// A web server for pages on this machine that know a secret: HTTP for the files, one WebSocket a page
/// (docs/studio.md, "Protocol").
///
/// It listens on 127.0.0.1 alone. Every request must name the server as its Host by a literal address, a WebSocket's
/// Origin, where there is one, likewise: a foreign page that had its own name resolved to this machine has neither.
/// At most eight pages, messages of at most 768 KiB; who says anything else is shown out, and the rest goes on.
class Server {
 public:
  /// Opens a port. @param port 0: any   @throws InvalidInput where it cannot
  Server(std::span<const WebFile> files, std::string token, std::uint16_t port, Visitors visitors);
  ~Server();

  std::uint16_t port() const;

  /// Until stop(), or an interrupt.
  void run();
  void stop();  ///< from any thread

  /// A text for a client, or for all of them (-1); from any thread.
  void tell(int client, std::string text);
  /// The newest frame, for all; a client that has two on the way gets the newest one later; from any thread.
  void show(std::shared_ptr<const Frame> frame);

  struct Engine;

 private:
  std::unique_ptr<Engine> engine_;
};

}  // namespace kinetix::app::studio
