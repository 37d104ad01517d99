#include "app/studio/server.hpp"

#include <utility>

// Boost.Asio of 1.74 lacks this include of <utility>.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <csignal>
#include <deque>
#include <nlohmann/json.hpp>

#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {
namespace {

constexpr int max_clients = 8;                      // pages: more than one person opens
constexpr std::size_t max_connections = 64;         // a browser needs several while it loads
constexpr std::size_t largest_message = 768 << 10;  // bytes: a picture or a scan in base64
constexpr std::size_t largest_request = 8 << 10;    // bytes of an HTTP header
constexpr std::size_t longest_ack = 100;            // bytes of a text that may be an acknowledgement
constexpr int max_in_flight = 2;                    // frames not yet acknowledged by a page
constexpr std::size_t max_bytes_waiting = 1 << 20;  // answers to a page that does not read
constexpr std::size_t max_commands = 64;            // waiting; a page at this limit is not read
constexpr std::size_t max_command_bytes = 2 << 20;  // bytes of those commands
constexpr std::chrono::seconds patience{5};         // for a request, and for a first message

constexpr std::string_view policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: "
    "blob:; "
    "media-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Compares in constant time.
bool is_equal_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char differs = 0;
  for (std::size_t k = 0; k < a.size(); ++k) differs |= static_cast<unsigned char>(a[k] ^ b[k]);
  return differs == 0;
}

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using tcp = asio::ip::tcp;

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

class Page;
class Connection;

}  // namespace

struct Server::Engine {
  std::span<const WebFile> files;
  std::string token;
  ConnectionHandlers handlers;
  std::list<Connection*>
      connections;  ///< without a page yet; oldest first. Must outlive the connections in io.
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  std::map<int, std::shared_ptr<Page>> pages;
  std::set<std::string> hosts;  ///< names of this server
  int next_client = 1;
  std::int64_t next_frame = 1;
  std::shared_ptr<const Frame> newest;

  void listen(std::uint16_t port);
  void accept();
  void take(tcp::socket socket);
  bool has_room() const;
  void close_oldest_unknown();
  /// Calls `work` for a page, or for all of them (-1).
  void with_pages(int client, const std::function<void(Page&)>& work);
  bool knows_host(std::string_view host) const { return hosts.count(std::string(host)) > 0; }
  bool knows_origin(std::string_view origin) const {
    constexpr std::string_view scheme = "http://";
    return origin.substr(0, scheme.size()) == scheme && knows_host(origin.substr(scheme.size()));
  }
};

namespace {

using Engine = Server::Engine;

/// WebSocket of a page.
class Page : public std::enable_shared_from_this<Page> {
 public:
  /// @param invited whether the request had the token
  Page(Engine& engine, tcp::socket socket, int client, bool invited)
      : engine_(engine), socket_(std::move(socket)), client_(client), timer_(engine.io), invited_(invited) {}

  bool invited() const { return invited_; }

  /// @param protocol named in the answer; may be empty
  void start(const Request& request, const std::string& protocol) {
    socket_.read_message_max(largest_message);
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& response) {
      if (!protocol.empty()) response.set(http::field::sec_websocket_protocol, protocol);
    }));
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      self->attempt([&] {
        if (error) return self->leave();
        if (self->invited_) self->welcome();
        if (!self->invited_) self->wait_for_token();
        self->read();
      });
    });
  }

  /// Closes only this page after an error, such as lack of memory. The page connects again.
  void attempt(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::exception&) {
      close();
    }
  }

  void send_message(Text text) {
    if (!known_) return;
    texts_.add(std::move(text));
    if (texts_.counted_bytes() > max_bytes_waiting) return close();
    write();
  }

  void took(std::size_t bytes) {
    --commands_;
    command_bytes_ -= bytes;
    if (rests_ && !closed_ && !is_full()) read();
  }

  void show() {
    if (!known_) return;
    unseen_ = true;
    write();
  }

  void close() {
    if (closed_) return;
    closed_ = true;
    error_code ignored;
    beast::get_lowest_layer(socket_).close(ignored);
    leave();
  }

 private:
  void wait_for_token() {
    timer_.expires_after(patience);
    timer_.async_wait([self = shared_from_this()](error_code error) {
      if (!error && !self->known_) self->close();
    });
  }

  void welcome() {
    known_ = invited_ = true;
    timer_.cancel();
    engine_.handlers.on_open(client_);
    if (engine_.newest) show();
  }

  bool is_full() const { return commands_ >= max_commands || command_bytes_ >= max_command_bytes; }

  void read() {
    rests_ = false;
    socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      self->attempt([&] {
        if (error) return self->leave();
        self->receive_next();
      });
    });
  }

  void receive_next() {
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (!known_ && !(is_equal_constant_time(text, engine_.token) && engine_.has_room())) return close();
    if (!known_)
      welcome();
    else if (!socket_.got_text())
      send_message({"error", std::make_shared<const std::string>(
                                 R"({"type": "error", "message": "commands are texts"})")});
    else if (!acknowledges(text))
      pass_on(text);
    rests_ = !closed_ && is_full();
    if (!closed_ && !rests_) read();
  }

  void pass_on(const std::string& text) {
    ++commands_;
    command_bytes_ += text.size();
    engine_.handlers.on_message(client_, text);
  }

  /// Handles acknowledgements of frames here, since they are frequent. @return whether the text is one
  bool acknowledges(const std::string& text) {
    if (text.size() > longest_ack) return false;
    const auto message = nlohmann::json::parse(text, nullptr, false);
    if (!message.is_object() || message.value("type", nlohmann::json()) != "ack") return false;
    const auto frame = message.value("frame", nlohmann::json());
    if (!frame.is_number()) return false;
    while (!flying_.empty() && static_cast<double>(flying_.front()) <= frame.get<double>())
      flying_.pop_front();
    write();
    return true;
  }

  void write() {
    if (writing_ || closed_) return;
    if (!texts_.empty()) {
      out_ = texts_.take().bytes;
      socket_.text(true);
    } else if (unseen_ && flying_.size() < max_in_flight) {
      out_ = std::make_shared<const std::string>(frame_bytes(*engine_.newest, engine_.next_frame, client_));
      unseen_ = false;
      flying_.push_back(engine_.next_frame++);
      socket_.binary(true);
    } else {
      return;
    }
    writing_ = true;
    socket_.async_write(asio::buffer(*out_), [self = shared_from_this()](error_code error, std::size_t) {
      self->attempt([&] {
        self->writing_ = false;
        self->out_.reset();
        if (error) return self->leave();
        self->write();
      });
    });
  }

  void leave() {
    closed_ = true;
    timer_.cancel();
    if (std::exchange(known_, false)) engine_.handlers.on_close(client_);
    engine_.pages.erase(client_);
  }

  Engine& engine_;
  websocket::stream<tcp::socket> socket_;
  const int client_;
  asio::steady_timer timer_;
  bool invited_;        ///< has sent the token
  bool known_ = false;  ///< has also completed the handshake
  bool closed_ = false, writing_ = false;
  bool rests_ = false;                            ///< is not read, because many of its commands wait
  std::size_t commands_ = 0, command_bytes_ = 0;  ///< commands that wait
  beast::flat_buffer buffer_;
  std::shared_ptr<const std::string> out_;  ///< is being sent
  WaitingTexts texts_;
  bool unseen_ = false;              ///< the newest frame waits
  std::deque<std::int64_t> flying_;  ///< frames sent and not acknowledged
};

/// Connection before it is a WebSocket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Engine& engine, tcp::socket socket)
      : engine_(engine),
        stream_(std::move(socket)),
        place_(engine.connections.insert(engine.connections.end(), this)) {}
  ~Connection() { close(); }

  void close() {
    if (!is_listed_) return;
    is_listed_ = false;
    engine_.connections.erase(place_);
    stream_.close();
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(largest_request);
    parser_->body_limit(0);
    stream_.expires_after(patience);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return;
      try {
        self->answer(self->parser_->release());
      } catch (const std::exception&) {
        self->close();
      }
    });
  }

 private:
  void answer(const Request& request) {
    if (!engine_.knows_host(view(request[http::field::host])))
      return respond(request, http::status::forbidden, "this server has another name\n");
    if (websocket::is_upgrade(request)) return upgrade(request);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return respond(request, http::status::method_not_allowed, "GET and HEAD only\n");
    const std::string_view path = view(request.target()).substr(0, request.target().find('?'));
    for (const WebFile& file : engine_.files)
      if (file.path == path) return respond(request, http::status::ok, file.content, file.type);
    respond(request, http::status::not_found, "there is no such file\n");
  }

  void upgrade(const Request& request) {
    const std::string_view target = view(request.target()), token = engine_.token;
    const auto origin = request.find(http::field::origin);
    if (origin != request.end() && !engine_.knows_origin(view(origin->value())))
      return respond(request, http::status::forbidden, "pages of other servers are not let in\n");
    constexpr std::string_view place = "/session";
    if (target.substr(0, place.size()) != place)
      return respond(request, http::status::not_found, "the WebSocket is /session\n");
    std::string_view given = target.substr(place.size());
    if (given.substr(0, 1) == "/") given.remove_prefix(1);
    if (given.substr(0, 7) == "?token=") given.remove_prefix(7);
    const std::string protocol(view(request[http::field::sec_websocket_protocol]));
    const bool by_protocol = is_equal_constant_time(protocol, token),
               by_address = is_equal_constant_time(given, token);
    if (!by_protocol && !by_address && !(given.empty() && protocol.empty()))
      return respond(request, http::status::forbidden, "the token is another one\n");
    const bool invited = by_protocol || by_address;
    if (!engine_.has_room())
      return respond(request, http::status::service_unavailable, "eight pages are open already\n");
    if (!invited) engine_.close_oldest_unknown();
    stream_.expires_never();
    const int client = engine_.next_client++;
    const auto page = std::make_shared<Page>(engine_, stream_.release_socket(), client, invited);
    engine_.pages[client] = page;
    page->start(request, by_protocol ? protocol : "");
  }

  void respond(const Request& request, http::status status, std::string_view content,
               std::string_view type = "text/plain; charset=utf-8") {
    response_ = Response(status, request.version());
    response_.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    response_.set(http::field::cache_control, "no-store");
    response_.set("Content-Security-Policy", beast::string_view(policy.data(), policy.size()));
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.body() = request.method() == http::verb::head ? "" : std::string(content);
    response_.content_length(content.size());
    response_.keep_alive(request.keep_alive() && status == http::status::ok);
    http::async_write(stream_, response_, [self = shared_from_this()](error_code error, std::size_t) {
      if (!error && self->response_.keep_alive()) return self->read();
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Engine& engine_;
  beast::tcp_stream stream_;
  const std::list<Connection*>::iterator place_;
  bool is_listed_ = true;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  Response response_;
};

}  // namespace

void Server::Engine::listen(std::uint16_t port) {
  error_code error;
  const tcp::endpoint here(asio::ip::address_v4::loopback(), port);
  acceptor.open(here.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(here, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) throw InvalidInput("port " + std::to_string(port) + " of 127.0.0.1: " + error.message());
  hosts = host_names(acceptor.local_endpoint().port());
}

void Server::Engine::accept() {
  acceptor.async_accept([this](error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    try {
      if (!error) take(std::move(socket));
    } catch (const std::exception&) {
      // A connection that finds no memory is dropped.
    }
    accept();
  });
}

void Server::Engine::take(tcp::socket socket) {
  if (connections.size() >= max_connections) connections.front()->close();
  error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  std::make_shared<Connection>(*this, std::move(socket))->read();
}

/// Returns whether one more page with the token may connect.
bool Server::Engine::has_room() const {
  return std::count_if(pages.begin(), pages.end(), [](const auto& page) { return page.second->invited(); }) <
         max_clients;
}

void Server::Engine::close_oldest_unknown() {
  std::vector<std::shared_ptr<Page>> strangers;
  for (const auto& [client, page] : pages)
    if (!page->invited()) strangers.push_back(page);
  if (std::ssize(strangers) >= max_clients) strangers.front()->close();
}

void Server::Engine::with_pages(int client, const std::function<void(Page&)>& work) {
  const auto all = pages;
  for (const auto& [number, page] : all)
    if (client < 0 || client == number) page->attempt([&, to = page.get()] { work(*to); });
}

std::set<std::string> host_names(std::uint16_t port) {
  const std::string at = ":" + std::to_string(port);
  std::set<std::string> names = {"127.0.0.1" + at, "localhost" + at};
  if (port == 80) names.insert({"127.0.0.1", "localhost"});
  return names;
}

Server::Server(std::span<const WebFile> files, std::string token, std::uint16_t port,
               ConnectionHandlers handlers)
    : engine_(std::make_unique<Engine>()) {
  engine_->files = files;
  engine_->token = std::move(token);
  engine_->handlers = std::move(handlers);
  engine_->listen(port);
}

Server::~Server() = default;

std::uint16_t Server::port() const { return engine_->acceptor.local_endpoint().port(); }

void Server::run() {
  asio::signal_set signals(engine_->io, SIGINT, SIGTERM);
  signals.async_wait([this, &signals](error_code error, int) {
    if (error) return;
    signals.clear();  // the next signal ends the program at once, even with work running
    engine_->io.stop();
  });
  engine_->accept();
  while (!engine_->io.stopped()) try {
      engine_->io.run();
    } catch (const std::exception&) {
      // A posted task ran out of memory; the others continue.
    }
}

void Server::stop() { engine_->io.stop(); }

void Server::send_message(int client, Text text) {
  asio::post(engine_->io, [this, client, text = std::move(text)] {
    engine_->with_pages(client, [&](Page& page) { page.send_message(text); });
  });
}

void Server::took(int client, std::size_t bytes) {
  asio::post(engine_->io,
             [this, client, bytes] { engine_->with_pages(client, [&](Page& page) { page.took(bytes); }); });
}

void Server::show(std::shared_ptr<const Frame> frame) {
  asio::post(engine_->io, [this, frame = std::move(frame)] {
    engine_->newest = frame;
    engine_->with_pages(-1, [](Page& page) { page.show(); });
  });
}

}  // namespace kinetix::app::studio
