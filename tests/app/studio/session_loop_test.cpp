#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <future>
#include <new>
#include <thread>

#include "app/studio/session/session_loop.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/app/studio/studio.hpp"

namespace kinetix::testing {
namespace {

using app::studio::Frame;
using app::studio::Message;
using app::studio::MessageSink;
using app::studio::SessionLoop;
using app::studio::Text;
using nlohmann::json;

/// A session that fails on request and records its steps.
class Failing : public SessionLoop {
 public:
  explicit Failing(MessageSink outlet) : SessionLoop(std::move(outlet)) {}

  std::vector<std::string> done;
  std::string fails_in;
  bool halted = false;

 private:
  void fail(const std::string& place) {
    if (fails_in == place) throw std::bad_alloc();
  }
  void welcome(int) override { fail("welcome"); }
  void forget(int) override { fail("forget"); }
  void execute(const Message& message) override {
    const std::string type = message.type();
    if (type == "memory") throw std::bad_alloc();
    if (type == "file")
      throw std::filesystem::filesystem_error("library words", "/gone",
                                              std::make_error_code(std::errc::no_such_file_or_directory));
    if (type == "folder")
      throw std::filesystem::filesystem_error("library words",
                                              std::make_error_code(std::errc::no_such_file_or_directory));
    if (type == "thread")
      throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
    if (type == "bug") throw std::logic_error("a bug");
    if (type == "bad") throw InvalidInput("bad input");
    if (type == "later") enqueue([] { throw std::bad_alloc(); });
    if (type == "fails_in") fails_in = message.text("place");
    if (fails_in == "welcome") add_client(7);
    if (fails_in == "forget") remove_client(7);
    done.push_back(type);
  }
  bool moves() const override { return !halted && fails_in == "play"; }
  bool play() override {
    fail("play");
    return true;
  }
  void halt() override { halted = true; }
  Frame frame() const override {
    if (fails_in == "frame") throw std::bad_alloc();
    return {};
  }
  void stop_jobs() override {}
};

struct Reported {
  std::vector<json> texts;
  std::vector<double> processed;  ///< counters of client 1's commands, in frames
  std::vector<std::string> done;
  bool halted = false;
};

using Commands = std::vector<std::pair<int, json>>;

/// Collects the replies to clients 1 and 2, which send all their commands at once.
Reported report_of(const Commands& commands) {
  Reported reported;
  std::stop_source stop;
  std::size_t left = commands.size();
  Failing session({[&](int, const Text& text) { reported.texts.push_back(json::parse(*text.bytes)); },
                   [&](const std::shared_ptr<const Frame>& frame) {
                     if (frame->processed.count(1)) reported.processed.push_back(frame->processed.at(1));
                   },
                   [&](int, std::size_t) {
                     if (--left == 0) stop.request_stop();
                   }});
  for (const int client : {1, 2}) session.add_client(client);
  for (const auto& [client, command] : commands) session.post(client, command.dump());
  session.run(stop.get_token());
  reported.done = session.done;
  reported.halted = session.halted;
  return reported;
}

TEST(SessionLoop, TellsOfACommandThatFailsForWhateverReasonAndGoesOn) {
  const std::pair<const char*, const char*> failures[] = {
      {"memory", "There is not enough memory for this."},
      {"file", "/gone: No such file or directory. Check"},
      {"folder", "the folder that the studio was started in: No such file"},
      {"thread", "No further thread"},
      {"bug", "a bug"},
      {"bad", "bad input"}};
  Commands commands;
  for (const auto& [type, words] : failures)
    commands.push_back({1, {{"type", type}, {"id", commands.size() + 1}}});
  commands.push_back({1, {{"type", "fine"}, {"id", 100}}});
  const Reported reported = report_of(commands);
  ASSERT_EQ(reported.texts.size(), std::size(failures));
  for (std::size_t k = 0; k < std::size(failures); ++k) {
    EXPECT_THAT(reported.texts[k]["message"].get<std::string>(), ::testing::HasSubstr(failures[k].second));
    EXPECT_THAT(reported.texts[k]["message"].get<std::string>(),
                ::testing::Not(::testing::HasSubstr("library")));
    EXPECT_EQ(reported.texts[k]["id"], k + 1);
    EXPECT_EQ(reported.texts[k]["about"], failures[k].first);
  }
  EXPECT_EQ(reported.done, std::vector<std::string>{"fine"});
}

TEST(SessionLoop, GoesOnWhateverElseFails) {
  for (const char* place : {"welcome", "forget", "play", "frame", "later"}) {
    SCOPED_TRACE(place);
    const Reported reported = report_of(
        {{1, {{"type", "fails_in"}, {"place", place}}}, {1, {{"type", "later"}}}, {1, {{"type", "fine"}}}});
    EXPECT_EQ(reported.done.back(), "fine");
    EXPECT_GE(reported.texts.size(), place == std::string("later") ? 1u : 2u);
    EXPECT_THAT(reported.texts.back()["message"].get<std::string>(), ::testing::HasSubstr("memory"));
    EXPECT_EQ(reported.halted, place == std::string("play"));
  }
}

/// An equilibrium that is found late answers an older command.
TEST(SessionLoop, NeverGoesBackInTheCommandsThatItHasHeard) {
  Reported reported;
  for (const auto& ids : {std::vector{5, 3}, std::vector{1, 2, 7, 4, 6}, std::vector{2, 2, 1}}) {
    Commands commands;
    for (const int id : ids) commands.push_back({1, {{"type", "fine"}, {"id", id}}});
    reported = report_of(commands);
    ASSERT_FALSE(reported.processed.empty());
    EXPECT_TRUE(std::is_sorted(reported.processed.begin(), reported.processed.end()));
    EXPECT_EQ(reported.processed.back(), *std::max_element(ids.begin(), ids.end()));
  }
}

TEST(SessionLoop, TakesCommandsFromEachPageInTurn) {
  Commands commands;
  for (int k = 0; k < 500; ++k) commands.push_back({1, {{"type", "many"}}});
  commands.push_back({2, {{"type", "one"}}});
  commands.push_back({2, {{"type", "two"}}});
  const std::vector<std::string> done = report_of(commands).done;
  ASSERT_EQ(done.size(), 502u);
  EXPECT_EQ((std::vector(done.begin(), done.begin() + 5)),
            (std::vector<std::string>{"many", "one", "many", "two", "many"}));
}

/// The newest of many waiting starts is run. The others are dropped and notified.
TEST(Job, RunsOneAfterTheOtherAndTheNewestOfThoseThatWait) {
  std::vector<int> ran, dropped;
  std::atomic<int> at_once = 0, most = 0;
  std::promise<void> begun, goes_on, ended;
  {
    app::studio::Job job;
    for (int k = 0; k < 10; ++k) {
      job.start(
          [&, k](const std::stop_token&) {
            most = std::max<int>(most, ++at_once);
            if (k == 0) begun.set_value(), goes_on.get_future().wait();
            ran.push_back(k);
            --at_once;
            if (k == 9) ended.set_value();
          },
          [&, k] { dropped.push_back(k); });
      if (k == 0) begun.get_future().wait();
    }
    goes_on.set_value();
    ended.get_future().wait();
  }
  EXPECT_EQ(ran, (std::vector{0, 9}));
  EXPECT_EQ(dropped, (std::vector{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(most, 1);
}

TEST(Job, OutlivesWorkThatThrows) {
  app::studio::Job job;
  std::promise<void> done;
  job.start([](const std::stop_token&) { throw 5; });
  job.start([&](const std::stop_token&) { done.set_value(); }, [&] { done.set_value(); });
  done.get_future().wait();
}

}  // namespace
}  // namespace kinetix::testing
