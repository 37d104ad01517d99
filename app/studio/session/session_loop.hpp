#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>

#include "app/studio/messages/message.hpp"
#include "app/studio/messages/waiting_texts.hpp"
#include "app/studio/play/frame.hpp"

namespace kinetix::app::studio {

inline constexpr int everybody = -1;  ///< in the place of a client's number: all of them

/// Where a session speaks to its pages. Calls come from several threads.
struct Outlet {
  std::function<void(int client, Text text)> tell;
  std::function<void(std::shared_ptr<const Frame> frame)> show;
  /// A command of so many bytes no longer waits.
  std::function<void(int client, std::size_t bytes)> took = [](int, std::size_t) {};
};

/// What pages speak to, whatever it shows. All pages see the same. Everything happens on the thread of run(), one command
/// after the other, in turn from each page, but for long work, whose results come back to it by enqueue().
/// A command that fails, for whatever reason, is a message; the rest goes on.
class SessionLoop {
 public:
  explicit SessionLoop(Outlet outlet) : outlet_(std::move(outlet)) {}
  virtual ~SessionLoop() = default;
  SessionLoop(const SessionLoop&) = delete;
  SessionLoop& operator=(const SessionLoop&) = delete;

  /// A command as the page sent it; from any thread.
  void post(int client, std::string text);
  /// A page came, and is told everything; from any thread.
  void greet(int client);
  /// A page went; from any thread. The engine rests while there is none.
  void dismiss(int client);
  /// Until asked to stop.
  void run(const std::stop_token& stop);

 protected:
  using Task = std::function<void()>;

  void enqueue(Task work) { enqueue(everybody, std::move(work)); }
  /// A message for a client, or for everybody; from any thread.
  void tell(const nlohmann::ordered_json& message, int client = everybody) const;
  void tell_text(Text text, int client = everybody) const { outlet_.tell(client, std::move(text)); }
  /// @return the message, to be told as often as it is wanted
  static Text text_of(const nlohmann::ordered_json& message);
  void note_heard(int client, double id);

  int client_ = everybody;  ///< whose command is being done
  double id_ = 0;           ///< of that command; 0 once somebody else answers it
  std::string type_;        ///< of that command
  bool changed_ = true;     ///< there is something new to see

 private:
  virtual void welcome(int client) = 0;           ///< tells a page that came everything
  virtual void forget(int client) = 0;            ///< that went
  virtual void obey(const Message& message) = 0;  ///< @throws InvalidInput for what is refused
  virtual bool moves() const = 0;                 ///< whether the engine has anything to do
  virtual bool play() = 0;                        ///< goes on in the engine; says whether it did
  virtual void halt() = 0;                        ///< the engine, which failed
  virtual Frame frame() const = 0;                ///< without hearers
  virtual void stop_jobs() = 0;

  bool plays() const { return !heard_.empty() && moves(); }  ///< not while nobody looks
  void enqueue(int client, Task work);
  void wait_for_work(const std::stop_token& stop);
  std::deque<Task> next_tasks();
  void do_queued();
  void obey(int client, const std::string& text);
  void play_on();
  void show();
  bool attempt(const Task& work) const;

  const Outlet outlet_;
  std::map<int, double>
      heard_;         ///< by client that is there: largest id of its commands whose effect can be seen
  std::mutex mutex_;  ///< of the queues
  std::condition_variable_any arrived_;
  std::map<int, std::deque<Task>>
      queues_;  ///< by client; of everybody: what long work has to say. None is empty.
};

}  // namespace kinetix::app::studio
