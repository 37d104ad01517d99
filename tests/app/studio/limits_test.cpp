#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdlib>
#include <filesystem>
#include <latch>

#include "app/studio/session/uploads.hpp"
#include "tests/app/studio/studio.hpp"

namespace kinetix::testing {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A page that reads late receives only the newest design.
TEST_F(Studio, SendsAPageThatSleptTheNewestDesignAlone) {
  client.ask({{"type", "sheet"}, {"columns", 40}, {"rows", 40}});
  Client sleeping(studio.port()), awake(studio.port());
  ASSERT_TRUE(sleeping.open(studio.token));
  ASSERT_TRUE(awake.open(studio.token));
  for (int k = 0; k < 24; ++k) client.ask({{"type", "hinge"}, {"index", k}, {"t", 0.3}});
  EXPECT_EQ(awake.ask({{"type", "release"}}).head(5), 1) << "others are served";
  int designs = 0, newest = 0;
  for (Received next; !(next = sleeping.receive(std::chrono::milliseconds(500))).closed;)
    if (next.text.is_object() && next.text["type"] == "design")
      ++designs, newest = next.text["revision"].get<int>();
  EXPECT_EQ(newest, 26);
  EXPECT_LT(designs, 12) << "but for those that the system's own buffers took";
}

/// A session that waits for permission to continue, and counts the messages that it receives.
class Waiting : public app::studio::SessionLoop {
 public:
  explicit Waiting(app::studio::MessageSink outlet) : SessionLoop(std::move(outlet)) {}

  std::latch goes_on{1};
  std::atomic<int> came = 0, done = 0;

 private:
  void welcome(int client) override { send_message({{"type", "hello"}}, client); }
  void forget(int) override {}
  void execute(const app::studio::Message&) override {
    goes_on.wait();
    ++done;
  }
  bool moves() const override { return false; }
  bool play() override { return false; }
  void halt() override {}
  app::studio::Frame frame() const override { return {}; }
  void stop_jobs() override {}
};

TEST(StudioLimits, ReadsNoMoreFromAPageWhileItsCommandsWait) {
  for (const std::size_t size : {30, 700'000}) {
    Waiting* session = nullptr;
    std::atomic<int> came = 0;
    OpenStudio studio(
        [&](app::studio::MessageSink outlet) {
          auto made = std::make_unique<Waiting>(std::move(outlet));
          session = made.get();
          return made;
        },
        [&] { ++came; });
    Client client(studio.port());
    ASSERT_TRUE(client.open(studio.token));
    client.text("hello");
    const int sent = size > 100 ? 40 : 300;
    std::jthread sender([&] {
      for (int k = 0; k < sent; ++k) client.send(R"({"type": "x", "k": ")" + std::string(size, 'k') + "\"}");
    });
    for (int last = -1; last != came;) {
      last = came;
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    EXPECT_LE(came, size > 100 ? 4 : 65) << "what waits is limited in number and bytes";
    Client other(studio.port());
    EXPECT_TRUE(other.open(studio.token)) << "others are let in";
    session->goes_on.count_down();
    for (int tries = 0; tries < 2000 && session->done < sent; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(session->done, sent) << "nothing is lost";
  }
}

class StudioPlaces : public ::testing::Test {
 protected:
  void expect_served() {
    EXPECT_EQ(fetch(studio.port(), "/", "127.0.0.1:" + std::to_string(studio.port())).first, 200);
    Client client(studio.port());
    ASSERT_TRUE(client.open(studio.token));
    EXPECT_EQ(client.text("hello")["name"], "strip");
  }

  OpenStudio studio{app::studio::template_design("strip")};
};

TEST_F(StudioPlaces, StrangersTakeNone) {
  std::vector<std::unique_ptr<Client>> strangers;
  for (int k = 0; k < 20; ++k) {
    strangers.push_back(std::make_unique<Client>(studio.port()));
    ASSERT_TRUE(strangers.back()->open(Client::Manners{})) << "without a token";
    if (k % 5 == 4) expect_served();
  }
  strangers.back()->send(studio.token);
  EXPECT_EQ(strangers.back()->text("hello")["name"], "strip");
}

TEST_F(StudioPlaces, ConnectionsThatSayNothingTakeNone) {
  namespace asio = boost::asio;
  asio::io_context io;
  std::vector<asio::ip::tcp::socket> idle;
  for (int k = 0; k < 200; ++k) {
    idle.emplace_back(io).connect({asio::ip::address_v4::loopback(), studio.port()});
    if (k % 40 == 39) expect_served();
  }
}

TEST_F(StudioPlaces, StrangersWhoLearnTheTokenAreNoNinthPage) {
  std::vector<std::unique_ptr<Client>> clients;
  Client stranger(studio.port());
  ASSERT_TRUE(stranger.open(Client::Manners{}));
  for (int k = 0; k < 8; ++k) {
    clients.push_back(std::make_unique<Client>(studio.port()));
    ASSERT_TRUE(clients.back()->open(studio.token));
  }
  stranger.send(studio.token);
  EXPECT_TRUE(stranger.is_shown_out());
  EXPECT_EQ(clients.back()->text("hello")["name"], "strip");
}

TEST(StudioHosts, LeaveOutThePortThatBrowsersLeaveOut) {
  const auto names = app::studio::host_names(80);
  for (const char* name : {"127.0.0.1", "localhost", "127.0.0.1:80", "localhost:80"})
    EXPECT_EQ(names.count(name), 1u) << name;
  EXPECT_EQ(app::studio::host_names(8080).count("127.0.0.1"), 0u);
  EXPECT_EQ(app::studio::host_names(8080).count("localhost:8080"), 1u);
}

TEST(Parts, SayTheSameOfAllThatComesAfterTooMuch) {
  app::studio::Parts parts;
  const std::string megabyte(1 << 20, 'x');
  std::string last;
  for (std::int64_t k = 0; k < 100; ++k) try {
      parts.add("scan.obj", k << 20, megabyte);
    } catch (const InvalidInput& e) {
      last = e.what();
      EXPECT_THAT(last, ::testing::HasSubstr("32 MiB in all")) << k;
    }
  EXPECT_THAT(last, ::testing::HasSubstr("32 MiB in all"));
  parts.add("scan.obj", 0, "small");
  EXPECT_EQ(parts.files().at("scan.obj"), "small") << "a file that begins anew is taken";
}

TEST(Parts, AreNoMoreThanAHundredFiles) {
  app::studio::Parts parts;
  for (int k = 0; k < 100; ++k) parts.add(fmt::format("{}.obj", k), 0, "");
  parts.add("5.obj", 0, "again");
  EXPECT_EQ(parts.files().size(), 100u);
  EXPECT_THROW(parts.add("one more.obj", 0, ""), InvalidInput);
}

TEST_F(Studio, RefusesASearchWithThousandsOfFiles) {
  json files = json::object();
  for (int k = 0; k < 20'000; ++k) files[std::to_string(k)] = "";
  client.send(json{{"type", "search"}, {"target", "kinetix: 1"}, {"files", files}}.dump());
  EXPECT_THAT(client.text("error")["message"].get<std::string>(), ::testing::HasSubstr("at most 100 files"));
}

/// Sets an environment variable of the process, so no other thread may run at that time.
class TemporaryPlace {
 public:
  explicit TemporaryPlace(const std::string& path) { setenv("TMPDIR", path.c_str(), 1); }
  ~TemporaryPlace() {
    if (before_.empty())
      unsetenv("TMPDIR");
    else
      setenv("TMPDIR", before_.c_str(), 1);
  }

 private:
  std::string before_ = std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "";
};

TEST_F(Studio, OutlivesASearchWithoutATemporaryFolder) {
  const TemporaryFolder folder;
  const std::string gone = folder.path("gone"), file = folder.write("file", "");
  fs::create_directory(gone);
  for (const std::string& place : {folder.path("never"), file, gone}) {
    fs::remove(gone);
    const TemporaryPlace temporary(place);
    const Received answer =
        client.ask({{"type", "search"}, {"target", "kinetix: 1\ntarget: {kind: display, glyph: T}\n"}});
    ASSERT_TRUE(answer.text.is_object()) << place;
    EXPECT_THAT(answer.text["message"].get<std::string>(), ::testing::HasSubstr(place));
    EXPECT_EQ(answer.text["about"], "search");
    EXPECT_FALSE(client.ask({{"type", "hinge"}, {"index", 0}, {"t", 0.3}}).closed) << "it goes on";
  }
}

TEST_F(Studio, OutlivesASaveIntoAPlaceThatIsGone) {
  const std::string results = studio.folder.path("results");
  client.ask({{"type", "open"}, {"template", "panel"}});
  studio.folder.write("results", "a file");
  for (const json& command : {json{{"type", "save"}}, json{{"type", "export"}, {"formats", {"stl"}}}}) {
    const Received answer = client.ask(command);
    ASSERT_TRUE(answer.text.is_object()) << command;
    EXPECT_THAT(answer.text["message"].get<std::string>(), ::testing::HasSubstr(results));
    EXPECT_THAT(answer.text["message"].get<std::string>(),
                ::testing::Not(::testing::HasSubstr("filesystem")));
  }
  fs::remove(results);
  client.send(R"({"type": "save"})");
  EXPECT_TRUE(fs::exists(client.text("saved")["path"].get<std::string>()));
}

TEST_F(Studio, RefusesASheetThatNoPageCanShow) {
  app::Design large = file;
  large.structure.squares()->bodies.resize(app::studio::max_bodies);
  EXPECT_NO_THROW(app::studio::require_showable(large));
  large.structure.squares()->bodies.resize(app::studio::max_bodies + 1);
  try {
    app::studio::require_showable(large);
    ADD_FAILURE() << "it is opened";
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("300001 bodies"));
  }
}

TEST_F(Studio, ForgetsTheOldestStepsOfLargeSheets) {
  app::studio::DesignHistory history(file);
  for (int k = 0; k < 150; ++k) history.add(file, 0);
  int steps = 0;
  while (history.undo()) ++steps;
  EXPECT_EQ(steps, 99);
  app::Design large = file;
  large.structure = model::make_sheet(200, 200, file.structure.size());
  app::studio::DesignHistory heavy(large);
  for (int k = 0; k < 40; ++k) heavy.add(large, 0);
  for (steps = 0; heavy.undo();) ++steps;
  EXPECT_GE(steps, 10);
  EXPECT_LE(steps, 25);
  EXPECT_FALSE(heavy.is_saved()) << "the one on the disk is no longer among them";
}

}  // namespace
}  // namespace kinetix::testing
