#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "app/studio/messages/message.hpp"
#include "app/studio/play/page_updates.hpp"

namespace kinetix::app::studio {

/// Long work of a session, one task at a time, on a separate thread. start() does not wait. It asks the
/// running task to stop; the newest task begins after that.
class Job {
 public:
  using Work = std::function<void(const std::stop_token& stop)>;

  Job() = default;
  ~Job() {
    {
      const std::lock_guard lock(mutex_);
      next_.reset();
      stop_.request_stop();
    }
    if (thread_.joinable()) thread_.join();
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// @param work reports its errors itself   @param dropped called if newer work replaced this before it
  /// began
  void start(
      Work work, std::function<void()> dropped = [] {}) {
    std::optional<Next> older;
    {
      const std::lock_guard lock(mutex_);
      stop_.request_stop();
      stop_ = {};
      older = std::exchange(next_, Next{std::move(work), std::move(dropped), stop_.get_token()});
      if (!runs_) begin();
    }
    if (older) older->dropped();
  }

  void stop_current() {
    const std::lock_guard lock(mutex_);
    stop_.request_stop();
  }

 private:
  struct Next {
    Work work;
    std::function<void()> dropped;
    std::stop_token stop;
  };

  /// @pre locked, nothing runs
  void begin() {
    if (thread_.joinable()) thread_.join();
    try {
      thread_ = std::thread([this] { run(); });
      runs_ = true;
    } catch (...) {
      next_.reset();
      throw;
    }
  }

  void run() {
    for (;;) {
      std::optional<Next> now;
      {
        const std::lock_guard lock(mutex_);
        now = std::exchange(next_, std::nullopt);
        runs_ = now.has_value();
      }
      if (!now) return;
      try {
        now->work(now->stop);
      } catch (...) {
        // Even the error report failed, for lack of memory.
      }
    }
  }

  std::mutex mutex_;
  std::stop_source stop_;
  std::optional<Next> next_;
  bool runs_ = false;
  std::thread thread_;
};

inline constexpr int all_clients = -1;  ///< in place of a client's number: all clients

/// Connection from a session to its pages. Calls come from several threads.
struct MessageSink {
  std::function<void(int client, Text text)> send_message;
  std::function<void(std::shared_ptr<const Frame> frame)> show;
  /// Reports that a command of this size no longer waits.
  std::function<void(int client, std::size_t bytes)> took = [](int, std::size_t) {};
};

/// Base of the studio's sessions: one event loop shared by all connected pages, which all show the same.
/// Everything runs on the thread of run(): one command after the other, in turn from each page. Long work
/// runs on other threads and returns its results by enqueue().
/// A command that fails causes an error message; the loop continues.
class SessionLoop {
 public:
  explicit SessionLoop(MessageSink outlet) : outlet_(std::move(outlet)) {}
  virtual ~SessionLoop() = default;
  SessionLoop(const SessionLoop&) = delete;
  SessionLoop& operator=(const SessionLoop&) = delete;

  /// Queues a command of a page; from any thread.
  void post(int client, std::string text);
  /// Adds a page and sends it everything; from any thread.
  void add_client(int client);
  /// Removes a page; from any thread. The engine rests while there is none.
  void remove_client(int client);
  /// Runs until a stop is requested.
  void run(const std::stop_token& stop);

 protected:
  using Task = std::function<void()>;

  void enqueue(Task work) { enqueue(all_clients, std::move(work)); }
  /// Sends a message to a client, or to everybody; from any thread.
  void send_message(const nlohmann::ordered_json& message, int client = all_clients) const;
  void send_text(Text text, int client = all_clients) const { outlet_.send_message(client, std::move(text)); }
  /// Returns the message as text that can be sent repeatedly.
  static Text text_of(const nlohmann::ordered_json& message);
  void note_processed(int client, double id);

  int client_ = all_clients;  ///< sender of the present command
  double id_ = 0;             ///< of that command; 0 if the answer comes later
  std::string type_;          ///< of that command
  bool changed_ = true;       ///< a new frame must be shown

 private:
  virtual void welcome(int client) = 0;              ///< sends everything to a new page
  virtual void forget(int client) = 0;               ///< removes the data of a page that left
  virtual void execute(const Message& message) = 0;  ///< @throws InvalidInput for a refused command
  virtual bool moves() const = 0;                    ///< whether the engine has work to do
  virtual bool play() = 0;                           ///< advances the engine; returns whether it did
  virtual void halt() = 0;                           ///< stops the engine after a failure
  virtual Frame frame() const = 0;                   ///< without `heard`
  virtual void stop_jobs() = 0;

  bool plays() const { return !processed_.empty() && moves(); }  ///< false without pages
  void enqueue(int client, Task work);
  void wait_for_work(const std::stop_token& stop);
  std::deque<Task> next_tasks();
  void do_queued();
  void execute(int client, const std::string& text);
  void play_on();
  void show();
  bool attempt(const Task& work) const;

  const MessageSink outlet_;
  std::map<int, double>
      processed_;     ///< per connected client: largest id of its commands whose effect is visible
  std::mutex mutex_;  ///< guards the queues
  std::condition_variable_any arrived_;
  std::map<int, std::deque<Task>>
      queues_;  ///< per client; results of long work under everybody. None is empty.
};

}  // namespace kinetix::app::studio
