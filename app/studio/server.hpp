#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "app/studio/messages/waiting_texts.hpp"
#include "app/studio/play/frame.hpp"

namespace kinetix::app::studio {

/// A file that the server hands out: the only ones that there are.
struct WebFile {
  std::string_view path;  ///< "/" and so on
  std::string_view type;  ///< of its content
  std::string_view content;
};

/// What the server tells of its clients; calls come from the thread of run(). Whoever hears a text says took() of it later.
struct Visitors {
  std::function<void(int client)> come;
  std::function<void(int client, std::string text)> say;
  std::function<void(int client)> go;
};

/// What a server at that port of 127.0.0.1 may be called in requests; browsers leave out port 80.
std::set<std::string> host_names(std::uint16_t port);

/// A web server for pages on this machine that know a secret: HTTP for the files, one WebSocket a page
/// (docs/studio.md, "Protocol").
///
/// It listens on 127.0.0.1 alone. Every request must name the server as its Host by a literal address, a WebSocket's
/// Origin, where there is one, likewise: a foreign page that had its own name resolved to this machine has neither.
/// At most eight pages that know the secret, messages of at most 768 KiB; who says anything else is shown out, and the rest goes on.
/// What waits is limited in bytes both ways: a page with many commands that wait is not read from until some were done, and is
/// sent the newest alone of what describes the present. Of connections that have not said anything yet the oldest give way.
class Server {
 public:
  /// Opens a port. @param port 0: any   @throws InvalidInput where it cannot
  Server(std::span<const WebFile> files, std::string token, std::uint16_t port, Visitors visitors);
  ~Server();

  std::uint16_t port() const;

  /// Until stop(), or an interrupt, which ends the program at once before and a second time.
  void run();
  void stop();  ///< from any thread

  /// A text for a client, or for all of them (-1); from any thread.
  void tell(int client, Text text);
  /// A text of the client, of so many bytes, no longer waits; from any thread.
  void took(int client, std::size_t bytes);
  /// The newest frame, for all; a client that has two on the way gets the newest one later; from any thread.
  void show(std::shared_ptr<const Frame> frame);

  struct Engine;

 private:
  std::unique_ptr<Engine> engine_;
};

}  // namespace kinetix::app::studio
