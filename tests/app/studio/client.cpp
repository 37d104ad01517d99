#include "tests/app/studio/client.hpp"

// Boost.Asio 1.74 does not include <utility>; the header above does.
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstring>

namespace kinetix::testing {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;

/// Sends a request.
/// @return the status and the body of the answer
std::pair<int, std::string> answer(std::uint16_t port, const http::request<http::empty_body>& request) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), port});
  http::write(socket, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(socket, buffer, response);
  return {static_cast<int>(response.result_int()), response.body()};
}

std::string address(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

}  // namespace

struct Client::Socket {
  explicit Socket(std::uint16_t to) : port(to), stream(io) {}

  asio::io_context io;
  std::uint16_t port;
  beast::websocket::stream<tcp::socket> stream;
  beast::flat_buffer buffer;
  boost::system::error_code read;
  bool reads = false;  // true: a pending read waits for its message
};

Client::Client(std::uint16_t port) : socket_(std::make_unique<Socket>(port)) {}
Client::~Client() = default;

bool Client::open(const Manners& manners) {
  auto& stream = socket_->stream;
  beast::get_lowest_layer(stream).connect({asio::ip::address_v4::loopback(), socket_->port});
  stream.set_option(beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
    if (!manners.origin.empty()) request.set(http::field::origin, manners.origin);
    if (!manners.protocol.empty()) request.set(http::field::sec_websocket_protocol, manners.protocol);
  }));
  boost::system::error_code error;
  stream.handshake(manners.host.empty() ? address(socket_->port) : manners.host, manners.target, error);
  return !error;
}

void Client::send(const std::string& text) {
  boost::system::error_code ignored;
  socket_->stream.text(true);
  socket_->stream.write(asio::buffer(text), ignored);
}

void Client::send_binary(const std::string& bytes) {
  boost::system::error_code ignored;
  socket_->stream.binary(true);
  socket_->stream.write(asio::buffer(bytes), ignored);
}

void Client::acknowledge(const Received& received) {
  send(nlohmann::json{{"type", "ack"}, {"frame", static_cast<long long>(received.head(1))}}.dump());
}

Received Client::receive(std::chrono::milliseconds patience) {
  Socket& s = *socket_;
  Received out;
  if (!s.reads)
    s.stream.async_read(s.buffer, [&s](boost::system::error_code error, std::size_t) {
      s.read = error;
      s.reads = false;
    });
  s.reads = true;
  s.io.restart();
  s.io.run_for(patience);
  out.closed = s.reads || s.read;
  if (out.closed) return out;
  const std::string bytes = beast::buffers_to_string(s.buffer.data());
  s.buffer.consume(s.buffer.size());
  if (s.stream.got_text()) {
    out.text = nlohmann::json::parse(bytes);
  } else {
    out.frame.resize(bytes.size() / sizeof(double));
    std::memcpy(out.frame.data(), bytes.data(), bytes.size());
  }
  return out;
}

bool Client::is_shown_out() {
  for (int k = 0; k < 100; ++k)
    if (receive().closed) return true;
  return false;
}

nlohmann::json Client::text(const std::string& type) {
  for (;;) {
    Received next = receive();
    if (next.closed) return {};
    if (!next.frame.empty()) acknowledge(next);
    if (next.text.is_object() && next.text["type"] == type) return next.text;
  }
}

Received Client::ask(nlohmann::json command) {
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

std::pair<int, std::string> fetch(std::uint16_t port, const std::string& target, const std::string& host,
                                  const std::string& verb) {
  http::request<http::empty_body> request(http::string_to_verb(verb), target, 11);
  request.set(http::field::host, host);
  return answer(port, request);
}

int refusal(std::uint16_t port, const Client::Manners& manners) {
  http::request<http::empty_body> request(http::verb::get, manners.target, 11);
  request.set(http::field::host, manners.host.empty() ? address(port) : manners.host);
  request.set(http::field::connection, "upgrade");
  request.set(http::field::upgrade, "websocket");
  request.set(http::field::sec_websocket_version, "13");
  request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
  if (!manners.origin.empty()) request.set(http::field::origin, manners.origin);
  if (!manners.protocol.empty()) request.set(http::field::sec_websocket_protocol, manners.protocol);
  return answer(port, request).first;
}

}  // namespace kinetix::testing
