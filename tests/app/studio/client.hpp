#pragma once

#include <utility>

// Boost.Asio of 1.74 forgets <utility>.
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace kinetix::testing {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;

/// What a page receives.
struct Received {
  bool closed = false;        ///< or nothing came in time
  nlohmann::json text;        ///< of a text
  std::vector<double> frame;  ///< of a frame

  double head(int k) const { return frame.at(k); }
  std::vector<double> pose(int body) const {
    return {frame.begin() + 10 + 7 * body, frame.begin() + 17 + 7 * body};
  }
};

/// A page that is no browser: one WebSocket, blocking, with patience.
class Client {
 public:
  struct Manners {
    std::string host = {}, origin = {}, protocol = {}, target = "/session";
  };

  explicit Client(std::uint16_t port) : port_(port), socket_(io_) {}

  /// @return whether the handshake succeeds
  bool open(const Manners& manners) {
    beast::get_lowest_layer(socket_).connect({asio::ip::address_v4::loopback(), port_});
    socket_.set_option(beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
      if (!manners.origin.empty()) request.set(http::field::origin, manners.origin);
      if (!manners.protocol.empty()) request.set(http::field::sec_websocket_protocol, manners.protocol);
    }));
    boost::system::error_code error;
    socket_.handshake(manners.host.empty() ? "127.0.0.1:" + std::to_string(port_) : manners.host,
                      manners.target, error);
    return !error;
  }
  bool open(const std::string& token) { return open(Manners{.protocol = token}); }

  void send(const std::string& text) {
    boost::system::error_code ignored;
    socket_.text(true);
    socket_.write(asio::buffer(text), ignored);
  }
  void send_binary(const std::string& bytes) {
    boost::system::error_code ignored;
    socket_.binary(true);
    socket_.write(asio::buffer(bytes), ignored);
  }
  void acknowledge(const Received& received) {
    send(nlohmann::json{{"type", "ack"}, {"frame", static_cast<long long>(received.head(1))}}.dump());
  }

  Received receive(std::chrono::milliseconds patience = std::chrono::seconds(20)) {
    Received out;
    if (!reads_)
      socket_.async_read(buffer_, [this](boost::system::error_code error, std::size_t) {
        read_ = error;
        reads_ = false;
      });
    reads_ = true;
    io_.restart();
    io_.run_for(patience);
    out.closed = reads_ || read_;
    if (out.closed) return out;
    const std::string bytes = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (socket_.got_text()) {
      out.text = nlohmann::json::parse(bytes);
    } else {
      out.frame.resize(bytes.size() / sizeof(double));
      std::memcpy(out.frame.data(), bytes.data(), bytes.size());
    }
    return out;
  }

  /// Whether the server shows it out, whatever it had been saying.
  bool is_shown_out() {
    for (int k = 0; k < 100; ++k)
      if (receive().closed) return true;
    return false;
  }

  /// The next text of a type; frames that come before it are acknowledged.
  nlohmann::json text(const std::string& type) {
    for (;;) {
      Received next = receive();
      if (next.closed) return {};
      if (!next.frame.empty()) acknowledge(next);
      if (next.text.is_object() && next.text["type"] == type) return next.text;
    }
  }

  /// Sends a command and waits for the frame that shows its effect, or for its error.
  Received ask(nlohmann::json command) {
    command["id"] = ++id_;
    send(command.dump());
    for (;;) {
      Received next = receive();
      if (next.closed) return next;
      if (!next.frame.empty()) acknowledge(next);
      if (!next.frame.empty() && next.head(5) >= id_) return next;
      if (next.text.is_object() && next.text["type"] == "error" && next.text.value("id", 0.0) == id_)
        return next;
    }
  }

 private:
  asio::io_context io_;
  std::uint16_t port_;
  beast::websocket::stream<tcp::socket> socket_;
  beast::flat_buffer buffer_;
  boost::system::error_code read_;
  bool reads_ = false;  ///< a read waits for its message
  double id_ = 0;
};

/// What answers a request. @return the status and the body
inline std::pair<int, std::string> answer(std::uint16_t port,
                                          const http::request<http::empty_body>& request) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), port});
  http::write(socket, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(socket, buffer, response);
  return {static_cast<int>(response.result_int()), response.body()};
}

inline std::pair<int, std::string> fetch(std::uint16_t port, const std::string& target,
                                         const std::string& host, http::verb verb = http::verb::get) {
  http::request<http::empty_body> request(verb, target, 11);
  request.set(http::field::host, host);
  return answer(port, request);
}

/// The status that answers a handshake which is refused.
inline int refusal(std::uint16_t port, const Client::Manners& manners) {
  http::request<http::empty_body> request(http::verb::get, manners.target, 11);
  request.set(http::field::host, manners.host.empty() ? "127.0.0.1:" + std::to_string(port) : manners.host);
  request.set(http::field::connection, "upgrade");
  request.set(http::field::upgrade, "websocket");
  request.set(http::field::sec_websocket_version, "13");
  request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
  if (!manners.origin.empty()) request.set(http::field::origin, manners.origin);
  if (!manners.protocol.empty()) request.set(http::field::sec_websocket_protocol, manners.protocol);
  return answer(port, request).first;
}

}  // namespace kinetix::testing
