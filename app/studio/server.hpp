#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string_view>

#include "app/studio/play/page_updates.hpp"

namespace kinetix::app::studio {

/// File that the server offers. It offers no others.
struct WebFile {
  std::string_view path;  ///< starts with "/"
  std::string_view type;  ///< MIME type of the content
  std::string_view content;
};

/// Callbacks for the server's clients, called on the thread of run(). The receiver of a text must call took()
/// later.
struct ConnectionHandlers {
  std::function<void(int client)> on_open;
  std::function<void(int client, std::string text)> on_message;
  std::function<void(int client)> on_close;
};

/// Returns the names that requests may give a server at this port of 127.0.0.1. Browsers omit port 80.
std::set<std::string> host_names(std::uint16_t port);

/// Web server for pages on this machine that know a secret. It serves the files by HTTP, and one WebSocket
/// per page (studio-protocol.md, "Protocol").
///
/// It listens on 127.0.0.1 only. Every request must have one of host_names() as its Host. A WebSocket's
/// Origin must also be one of them, if it has an Origin. This rejects a foreign page whose name resolves to
/// this machine.
/// At most eight pages with the secret are accepted, and messages of at most 768 KiB. Other clients are
/// disconnected.
/// Queues are limited in bytes. A page with many waiting commands is not read until some are done. It
/// receives only the newest message of each type that describes the present. The oldest connections without a
/// page are closed first.
class Server {
 public:
  /// Opens a port. @param port 0: any   @throws InvalidInput on failure
  Server(std::span<const WebFile> files, std::string token, std::uint16_t port, ConnectionHandlers handlers);
  ~Server();

  std::uint16_t port() const;

  /// Runs until stop() or an interrupt. A second interrupt ends the program at once, and so does one before
  /// run().
  void run();
  void stop();  ///< from any thread

  /// Sends a text to a client, or to all of them (-1); from any thread.
  void send_message(int client, Text text);
  /// Reports that a text of the client, with this size, no longer waits; from any thread.
  void took(int client, std::size_t bytes);
  /// Sends the newest frame to all clients, from any thread. A client with two unacknowledged frames gets the
  /// newest one later.
  void show(std::shared_ptr<const Frame> frame);

  struct Engine;

 private:
  std::unique_ptr<Engine> engine_;
};

}  // namespace kinetix::app::studio
