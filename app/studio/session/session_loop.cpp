#include "app/studio/session/session_loop.hpp"

namespace kinetix::app::studio {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_plays{8};   // while the engine runs: twice per visible frame
constexpr std::chrono::milliseconds between_shows{30};  // while commands wait: as often as people see frames

}  // namespace

void SessionLoop::post(int client, std::string text) {
  enqueue(client, [this, client, text = std::move(text)] {
    execute(client, text);
    outlet_.took(client, text.size());
  });
}

void SessionLoop::add_client(int client) {
  enqueue(client, [this, client] {
    processed_[client] = 0;
    welcome(client);
    changed_ = true;
  });
}

void SessionLoop::remove_client(int client) {
  enqueue(client, [this, client] {
    processed_.erase(client);
    forget(client);
  });
}

void SessionLoop::note_processed(int client, double id) {
  const auto page = processed_.find(client);
  if (page != processed_.end()) page->second = std::max(page->second, id);
}

void SessionLoop::enqueue(int client, Task work) {
  {
    const std::lock_guard lock(mutex_);
    queues_[client].push_back(std::move(work));
  }
  arrived_.notify_one();
}

void SessionLoop::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    do_queued();
    play_on();
    if (changed_) attempt([this] { show(); });
    wait_for_work(stop);
  }
  stop_jobs();
}

void SessionLoop::wait_for_work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const auto ready = [this] { return !queues_.empty(); };
  if (plays())
    arrived_.wait_for(lock, stop, between_plays, ready);
  else
    arrived_.wait(lock, stop, ready);
}

/// Takes all tasks of long work, and the first of each client.
std::deque<SessionLoop::Task> SessionLoop::next_tasks() {
  const std::lock_guard lock(mutex_);
  std::deque<Task> tasks;
  for (auto& [client, queue] : queues_) do {
      tasks.push_back(std::move(queue.front()));
      queue.pop_front();
    } while (client == all_clients && !queue.empty());
  std::erase_if(queues_, [](const auto& queue) { return queue.second.empty(); });
  return tasks;
}

void SessionLoop::do_queued() {
  const SteadyClock::time_point end = SteadyClock::now() + between_shows;
  do {
    const std::deque<Task> tasks = next_tasks();
    if (tasks.empty()) return;
    for (const Task& task : tasks) attempt(task);
  } while (SteadyClock::now() < end);
}

void SessionLoop::execute(int client, const std::string& text) {
  client_ = client;
  id_ = 0;
  type_.clear();
  double id = 0;
  try {
    const Message message(text);
    id = id_ = message.id();
    type_ = message.type();
    execute(message);
    note_processed(client, id_);
    changed_ = true;
  } catch (const std::exception& e) {
    attempt([&] { send_message(error_message(failure_message(e), id, type_), client); });
  }
  client_ = all_clients;
}

void SessionLoop::play_on() {
  const bool goes_on = attempt([this] {
    if (plays() && play()) changed_ = true;
  });
  if (!goes_on) attempt([this] { halt(); });
}

void SessionLoop::show() {
  auto shown = std::make_shared<Frame>(frame());
  shown->processed = processed_;
  outlet_.show(std::move(shown));
  changed_ = false;
}

/// Runs the work and reports an error to everybody, if memory allows. @return whether it succeeded
bool SessionLoop::attempt(const Task& work) const {
  try {
    work();
    return true;
  } catch (const std::exception& e) {
    try {
      send_message(error_message(failure_message(e), 0, ""));
    } catch (const std::exception&) {
      // Even the error report failed, for lack of memory.
    }
    return false;
  }
}

Text SessionLoop::text_of(const nlohmann::ordered_json& message) {
  return {message.at("type").get<std::string>(),
          std::make_shared<const std::string>(
              message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))};
}

void SessionLoop::send_message(const nlohmann::ordered_json& message, int client) const {
  send_text(text_of(message), client);
}

}  // namespace kinetix::app::studio
