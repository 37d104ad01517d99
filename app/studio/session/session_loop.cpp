#include "app/studio/session/session_loop.hpp"

#include <chrono>

#include "app/studio/messages/design_message.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {
namespace {

constexpr std::chrono::milliseconds between_plays{
    8};  // while the engine runs: twice as often as frames are seen

}  // namespace

void SessionLoop::post(int client, std::string text) {
  enqueue([this, client, text = std::move(text)] { obey(client, text); });
}

void SessionLoop::greet(int client) {
  enqueue([this, client] {
    heard_[client] = 0;
    welcome(client);
    changed_ = true;
  });
}

void SessionLoop::dismiss(int client) {
  enqueue([this, client] {
    heard_.erase(client);
    forget(client);
  });
}

void SessionLoop::note_heard(int client, double id) {
  const auto page = heard_.find(client);
  if (id > 0 && page != heard_.end()) page->second = id;
}

void SessionLoop::enqueue(std::function<void()> work) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(work));
  }
  arrived_.notify_one();
}

void SessionLoop::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    do_queued();
    if (plays() && play()) changed_ = true;
    if (changed_) show();
    wait_for_work(stop);
  }
  stop_jobs();
}

void SessionLoop::wait_for_work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const auto ready = [this] { return !queue_.empty(); };
  if (plays())
    arrived_.wait_for(lock, stop, between_plays, ready);
  else
    arrived_.wait(lock, stop, ready);
}

void SessionLoop::do_queued() {
  std::deque<std::function<void()>> work;
  {
    const std::lock_guard lock(mutex_);
    work.swap(queue_);
  }
  for (const auto& task : work) task();
}

void SessionLoop::obey(int client, const std::string& text) {
  client_ = client;
  id_ = 0;
  try {
    const Message message(text);
    id_ = message.id();
    obey(message);
    note_heard(client, id_);
    changed_ = true;
  } catch (const InvalidInput& e) {
    tell_json(error_message(e.what(), id_), client);
  }
  client_ = everybody;
}

void SessionLoop::show() {
  auto shown = std::make_shared<Frame>(frame());
  shown->heard = heard_;
  outlet_.show(std::move(shown));
  changed_ = false;
}

void SessionLoop::tell_json(const nlohmann::ordered_json& message, int client) const {
  outlet_.tell(client, message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace kinetix::app::studio
