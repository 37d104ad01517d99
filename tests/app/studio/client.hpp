#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace kinetix::testing {

/// A text or a frame that a page receives.
struct Received {
  bool closed = false;        ///< true: the connection is closed, or nothing came in time
  nlohmann::json text;        ///< content of a text
  std::vector<double> frame;  ///< numbers of a frame

  double head(int k) const { return frame.at(k); }
  std::vector<double> pose(int body) const {
    return {frame.begin() + 10 + 7 * body, frame.begin() + 17 + 7 * body};
  }
};

/// A page that is not a browser: one blocking WebSocket with timeouts.
class Client {
 public:
  struct Manners {
    std::string host = {}, origin = {}, protocol = {}, target = "/session";
  };

  explicit Client(std::uint16_t port);
  ~Client();

  /// @return whether the handshake succeeds
  bool open(const Manners& manners);
  bool open(const std::string& token) { return open(Manners{.protocol = token}); }

  void send(const std::string& text);
  void send_binary(const std::string& bytes);
  void acknowledge(const Received& received);
  Received receive(std::chrono::milliseconds patience = std::chrono::seconds(20));

  /// Checks whether the server closes the connection, after any other messages.
  bool is_shown_out();
  /// Returns the next text of a type. Acknowledges frames that come before it.
  nlohmann::json text(const std::string& type);
  /// Sends a command and waits for the frame that shows its effect, or for its error.
  Received ask(nlohmann::json command);

 private:
  struct Socket;

  std::unique_ptr<Socket> socket_;
  double id_ = 0;
};

/// Requests a page.
/// @return the status and the body of the answer
std::pair<int, std::string> fetch(std::uint16_t port, const std::string& target, const std::string& host,
                                  const std::string& verb = "GET");

/// Returns the status with which the server refuses a handshake.
int refusal(std::uint16_t port, const Client::Manners& manners);

}  // namespace kinetix::testing
