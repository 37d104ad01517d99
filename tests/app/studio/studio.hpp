#pragma once

#include <gtest/gtest.h>

#include <thread>

#include "app/studio/messages/templates.hpp"
#include "app/studio/server.hpp"
#include "app/studio/session/session.hpp"
#include "tests/app/studio/client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::testing {

/// An open studio with its server and session, as `view` opens it.
class OpenStudio {
 public:
  using Maker = std::function<std::unique_ptr<app::studio::SessionLoop>(app::studio::MessageSink)>;

  explicit OpenStudio(app::Design design, const std::optional<targets::Node>& target = {})
      : OpenStudio([&](app::studio::MessageSink outlet) {
          return std::make_unique<app::studio::Session>(
              app::studio::SessionInput{
                  std::move(design), folder.path("design.yaml"), target, 2, 0, {}, folder.path("results")},
              std::move(outlet));
        }) {}
  explicit OpenStudio(app::studio::SessionInput opened)
      : OpenStudio([&](app::studio::MessageSink outlet) {
          return std::make_unique<app::studio::Session>(std::move(opened), std::move(outlet));
        }) {}
  /// Opens a session.
  /// @param came called for every command that the server passes on
  explicit OpenStudio(
      const Maker& make, const std::function<void()>& came = [] {})
      : server(files(), token, 0,
               {[this](int client) { session->add_client(client); },
                [this, came](int client, std::string text) {
                  came();
                  session->post(client, std::move(text));
                },
                [this](int client) { session->remove_client(client); }}) {
    session =
        make({[this](int client, app::studio::Text text) { server.send_message(client, std::move(text)); },
              [this](std::shared_ptr<const app::studio::Frame> frame) { server.show(std::move(frame)); },
              [this](int client, std::size_t bytes) { server.took(client, bytes); }});
    worker = std::jthread([this](const std::stop_token& stop) { session->run(stop); });
    listener = std::thread([this] { server.run(); });
  }
  ~OpenStudio() {
    server.stop();
    listener.join();
    worker.request_stop();
    worker.join();
    session.reset();
  }
  OpenStudio(const OpenStudio&) = delete;

  std::uint16_t port() const { return server.port(); }

  static std::span<const app::studio::WebFile> files() {
    static const app::studio::WebFile all[] = {{"/", "text/html", "<!DOCTYPE html>"}};
    return all;
  }

  const std::string token = "0123456789abcdef0123456789abcdef";
  TemporaryFolder folder;
  app::studio::Server server;
  std::unique_ptr<app::studio::SessionLoop> session;
  std::jthread worker;
  std::thread listener;
};

/// A test with a page that has opened a strip.
class Studio : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(client.open(studio.token));
    design = client.text("design");
  }

  app::Design file = app::studio::template_design("strip");
  OpenStudio studio{file};
  Client client{studio.port()};
  nlohmann::json design;
};

}  // namespace kinetix::testing
