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
#include "app/studio/play/frame.hpp"

namespace kinetix::app::studio {

inline constexpr int everybody = -1;  ///< in the place of a client's number: all of them

/// Where a session speaks to its pages. Calls come from several threads.
struct Outlet {
  std::function<void(int client, std::string text)> tell;
  std::function<void(std::shared_ptr<const Frame> frame)> show;
};

/// What pages speak to, whatever it shows. All pages see the same. Everything happens on the thread of run(), one command
/// after the other, but for long work, whose results come back to it by enqueue().
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
  void enqueue(std::function<void()> work);
  /// A message for a client, or for everybody; from any thread.
  void tell_json(const nlohmann::ordered_json& message, int client = everybody) const;
  void note_heard(int client, double id);

  int client_ = everybody;  ///< whose command is being done
  double id_ = 0;           ///< of that command; 0 once somebody else answers it
  bool changed_ = true;     ///< there is something new to see

 private:
  virtual void welcome(int client) = 0;           ///< tells a page that came everything
  virtual void forget(int client) = 0;            ///< that went
  virtual void obey(const Message& message) = 0;  ///< @throws InvalidInput for what is refused
  virtual bool moves() const = 0;                 ///< whether the engine has anything to do
  virtual bool play() = 0;                        ///< goes on in the engine; says whether it did
  virtual Frame frame() const = 0;                ///< without hearers
  virtual void stop_jobs() = 0;

  bool plays() const { return !heard_.empty() && moves(); }  ///< not while nobody looks
  void wait_for_work(const std::stop_token& stop);
  void do_queued();
  void obey(int client, const std::string& text);
  void show();

  const Outlet outlet_;
  std::map<int, double> heard_;  ///< by client that is there: id of its last command whose effect can be seen
  std::mutex mutex_;             ///< of the queue
  std::condition_variable_any arrived_;
  std::deque<std::function<void()>> queue_;
};

}  // namespace kinetix::app::studio
