#include "app/studio/server.hpp"

#include <gtest/gtest.h>

#include "app/studio/messages/templates.hpp"
#include "tests/app/studio/client.hpp"
#include "tests/app/studio/studio.hpp"

namespace kinetix::testing {
namespace {

using Manners = Client::Manners;

class StudioServer : public ::testing::Test {
 protected:
  std::string here() const { return "127.0.0.1:" + std::to_string(studio.port()); }
  /// Checks that the server still serves a page.
  void expect_alive() {
    Client client(studio.port());
    ASSERT_TRUE(client.open(studio.token));
    EXPECT_EQ(client.text("hello")["name"], "strip");
  }

  OpenStudio studio{app::studio::template_design("strip")};
};

TEST_F(StudioServer, HandsOutItsOwnFilesAndNoOthers) {
  EXPECT_EQ(fetch(studio.port(), "/", here()), std::pair(200, std::string("<!DOCTYPE html>")));
  EXPECT_EQ(fetch(studio.port(), "/?query", here()).first, 200);
  for (const char* path : {"/etc/passwd", "/../design.yaml", "/design.yaml", "//", "/%2e%2e/"})
    EXPECT_EQ(fetch(studio.port(), path, here()).first, 404) << path;
  EXPECT_EQ(fetch(studio.port(), "/", here(), "POST").first, 405);
}

TEST_F(StudioServer, AnswersToItsOwnNameAlone) {
  const std::string port = ":" + std::to_string(studio.port());
  for (const std::string& host :
       {"evil.example" + port, std::string("127.0.0.1"), "127.0.0.1.evil.example" + port,
        std::string("127.0.0.1:1"), std::string("")})
    EXPECT_EQ(fetch(studio.port(), "/", host).first, 403) << host;
  EXPECT_EQ(fetch(studio.port(), "/", "localhost" + port).first, 200);
}

TEST_F(StudioServer, LetsInWhoKnowsTheToken) {
  for (const Manners& manners :
       {Manners{.protocol = studio.token}, Manners{.target = "/session/" + studio.token},
        Manners{.target = "/session?token=" + studio.token},
        Manners{.origin = "http://" + here(), .protocol = studio.token}}) {
    Client client(studio.port());
    ASSERT_TRUE(client.open(manners));
    EXPECT_EQ(client.text("hello")["name"], "strip");
  }
  Client client(studio.port());
  ASSERT_TRUE(client.open(Manners{}));
  client.send(studio.token);
  EXPECT_EQ(client.text("hello")["name"], "strip");
}

TEST_F(StudioServer, RefusesWrongTokensHostsAndOrigins) {
  const std::string wrong = "0123456789abcdef0123456789abcdee";
  for (const Manners& manners : {Manners{.protocol = wrong}, Manners{.target = "/session/" + wrong},
                                 Manners{.host = "evil.example", .protocol = studio.token},
                                 Manners{.origin = "http://evil.example", .protocol = studio.token},
                                 Manners{.origin = "null", .protocol = studio.token},
                                 Manners{.host = "evil.example:" + std::to_string(studio.port()),
                                 .origin = "http://evil.example:" + std::to_string(studio.port()),
                                 .protocol = studio.token}}) {
    Client client(studio.port());
    EXPECT_FALSE(client.open(manners));
    EXPECT_EQ(refusal(studio.port(), manners), 403);
  }
  Client client(studio.port());
  ASSERT_TRUE(client.open(Manners{}));
  client.send(wrong);
  EXPECT_TRUE(client.is_shown_out());
  expect_alive();
}

TEST_F(StudioServer, HasRoomForEightPages) {
  std::vector<std::unique_ptr<Client>> clients;
  for (int k = 0; k < 8; ++k) {
    clients.push_back(std::make_unique<Client>(studio.port()));
    ASSERT_TRUE(clients.back()->open(studio.token));
  }
  Client ninth(studio.port());
  EXPECT_FALSE(ninth.open(studio.token));
  EXPECT_EQ(refusal(studio.port(), {.protocol = studio.token}), 503);
  EXPECT_EQ(clients[0]->text("hello")["name"], "strip");
}

TEST_F(StudioServer, SurvivesWhateverIsSaid) {
  Client client(studio.port());
  ASSERT_TRUE(client.open(studio.token));
  const char* said[] = {"",
                        "{",
                        "[]",
                        "null",
                        "nonsense",
                        R"({"type": 5})",
                        R"({"type": "fly"})",
                        R"({"type": "theta", "deg": NaN})",
                        R"({"type": "theta", "deg": 1e999})",
                        R"({"type": "theta", "deg": "20"})",
                        R"({"type": "theta"})",
                        R"({"type": "drag", "body": 9999, "to": [0, 0, 0]})",
                        R"({"type": "drag", "body": -1, "to": [0, 0, 0]})",
                        R"({"type": "drag", "body": 1.5, "to": [0, 0, 0]})",
                        R"({"type": "drag", "body": 1, "to": [0, 0]})",
                        R"({"type": "drag", "body": 1, "to": [0, 0, 1e300]})",
                        R"({"type": "hinge", "index": 100000, "t": 0.5})",
                        R"({"type": "hinge", "index": 0, "t": 0})",
                        R"({"type": "sheet", "columns": 1000000})",
                        R"({"type": "made", "kind": "glue"})",
                        R"({"type": "open", "yaml": "a: &x [*x]"})",
                        R"({"type": "search", "target": "kinetix: 1"})",
                        R"({"type": "search", "target": "", "files": {"../x": ""}})",
                        R"({"type": "export", "formats": ["doc"]})",
                        R"({"type": "speed", "factor": 0})",
                        R"({"id": -1, "type": "reset"})",
                        "\xff\xfe"};
  for (const char* text : said) {
    client.send(text);
    if (std::string(text) == "\xff\xfe") break;
    EXPECT_TRUE(client.text("error").contains("message")) << text;
  }
  EXPECT_TRUE(client.is_shown_out());
  expect_alive();
}

TEST_F(StudioServer, ShowsOutWhoSendsTooMuch) {
  Client client(studio.port());
  ASSERT_TRUE(client.open(studio.token));
  client.send(std::string(1'000'000, ' '));
  EXPECT_TRUE(client.is_shown_out());
  Client binary(studio.port());
  ASSERT_TRUE(binary.open(studio.token));
  binary.send_binary("garbage");
  EXPECT_TRUE(binary.text("error").contains("message"));
  expect_alive();
}

TEST_F(StudioServer, SendsTwoFramesAndThenWaits) {
  Client client(studio.port());
  ASSERT_TRUE(client.open(studio.token));
  client.text("state");
  for (int k = 0; k < 50; ++k)
    client.send(nlohmann::json{{"type", "theta"}, {"deg", k / 2.0}, {"id", k + 1}}.dump());
  std::vector<Received> frames;
  for (Received next; !(next = client.receive(std::chrono::milliseconds(700))).closed;)
    if (!next.frame.empty()) frames.push_back(next);
  EXPECT_LE(frames.size(), 2u);
}

}  // namespace
}  // namespace kinetix::testing
