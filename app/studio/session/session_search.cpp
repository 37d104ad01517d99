#include "app/studio/session/session.hpp"

#include <filesystem>

#include "app/console/time_left.hpp"
#include "app/goals/registry.hpp"
#include "app/io/atomic_file.hpp"
#include "app/io/bytes.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "app/result/result_json.hpp"
#include "app/result/verdict.hpp"
#include "app/studio/messages/design_message.hpp"
#include "app/studio/messages/message.hpp"
#include "app/studio/session/temporary_folder.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_words{
    500};                                // of a search, on screen: as often as people read them
constexpr std::size_t most_senders = 8;  // pages whose parts of files are kept

double seconds_since(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// Returns the name if it is a plain file name, which cannot leave its folder.
std::string plain_name(const std::string& name) {
  const bool plain = !name.empty() && name.size() < 100 && name[0] != '.' &&
                     name.find_first_of("/\\") == std::string::npos && name.find('\0') == std::string::npos;
  if (!plain) throw InvalidInput("files: a name must be a plain file name");
  return name;
}

}  // namespace

void Session::take_part(const Message& message) {
  if (parts_.count(client_) == 0 && parts_.size() >= most_senders) parts_.erase(parts_.begin());
  constexpr double farthest = 1e15;  // largest whole number allowed here; Parts has a separate limit
  parts_[client_].add(plain_name(message.text("name")),
                      static_cast<std::int64_t>(message.number("at", 0, farthest)),
                      from_base64(message.text("content")));
}

void Session::search(const Message& message) {
  if (searching_) throw InvalidInput("search: one is going on; stop it first");
  const auto folder = make_temporary_folder();
  Parts parts = std::exchange(parts_[client_], {});
  if (message.has("files"))
    for (const auto& [name, content] : message.named_texts("files"))
      parts.add(plain_name(name), 0, from_base64(content));
  for (const auto& [name, content] : parts.files()) write_file((*folder / name).string(), content);
  const std::string file = (*folder / "target.yaml").string();
  write_file(file, message.text("target"));
  read_target(file);
  search_for(file, folder);
}

/// @param keeps objects that must live until the search ends
void Session::search_for(const std::string& file, std::shared_ptr<const void> keeps) {
  searcher_.start([this, file, keeps](const std::stop_token& stop) {
    std::string stage_shown;
    TimeLeft left;
    std::mutex words;
    const auto start = SteadyClock::now();
    SteadyClock::time_point stage_start = start, next = start;
    const auto progress = [&](const std::string& stage, double done, const std::string& so_far) {
      const std::lock_guard lock(words);
      if (stage != stage_shown) {
        stage_shown = stage;
        stage_start = next = SteadyClock::now();
        left = {};
      }
      left.update(seconds_since(stage_start), done);
      if (SteadyClock::now() < next) return;
      next = SteadyClock::now() + between_words;
      Json out = progress_message("search", stage, done, so_far);
      if (const auto seconds = left.at(seconds_since(stage_start)); seconds && done < 1)
        out["left_s"] = *seconds;
      tell(out);
    };
    try {
      const Target target = read_target(file);
      RunOptions options;
      options.threads = opened_.threads;
      options.seed = opened_.seed;
      options.progress = progress;
      options.stop = stop;
      options.engine = &engine_;
      options.printable = answer_of_export;
      auto run = std::make_shared<Run>(run_goal(*target.goal, options));
      enqueue([this, run] { found(run); });
    } catch (const std::exception& e) {
      enqueue([this, what = failure_message(e)] {
        searching_ = false;
        tell(error_message(what, 0, "search"));
        send_state();
      });
    }
  });
  searching_ = true;
  send_state();
}

void Session::found(std::shared_ptr<Run> run) {
  searching_ = false;
  Design design = written_design(*run);
  const bool is_other = design.name != history_.current().name;
  Finding finding{run,
                  {{"type", "result"},
                   {"result", result_json(*run)},
                   {"summary", summary(*run)},
                   {"met", verdict_of(*run).met.value_or(false)},
                   {"stopped", run->stopped}},
                  design.theta};
  if (is_other)
    take_other(std::move(design), std::move(finding));
  else
    take(std::move(design), std::move(finding));
  fold_to(run->theta);
  send_state();
  changed_ = true;
}

}  // namespace kinetix::app::studio
