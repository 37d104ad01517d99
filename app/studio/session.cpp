#include "app/studio/session.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "app/exports/design_export.hpp"
#include "app/exports/write_results.hpp"
#include "app/goals/read_target.hpp"
#include "app/io/atomic_file.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/export_command.hpp"
#include "app/result/result_json.hpp"
#include "app/studio/base64.hpp"
#include "app/studio/design_edits.hpp"
#include "app/studio/design_message.hpp"
#include "app/studio/sheet_equilibria.hpp"
#include "app/studio/templates.hpp"
#include "model/elastic/path/stable_states.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using SteadyClock = std::chrono::steady_clock;

constexpr double steepest_deg = 89;  // theta, as --theta-deg has it
constexpr std::chrono::milliseconds between_plays{
    8};  // while the engine runs: twice as often as frames are seen
constexpr std::chrono::milliseconds between_words{
    500};                                // of a search, on screen: as often as a person reads them
constexpr std::size_t most_senders = 8;  // pages whose parts of files are kept
constexpr double largest_push_N = 1000;  // more than a person pushes with

double seconds_since(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

Json error_message(const std::string& what, double id) {
  Json out = {{"type", "error"}, {"message", what}};
  if (id > 0) out["id"] = id;
  return out;
}

/// @param done 0 to 1; negative: not known
Json progress_message(const char* job, const std::string& stage, double done, const std::string& so_far) {
  Json out = {{"type", "progress"},
              {"job", job},
              {"text", so_far.empty() ? stage : stage + ": " + so_far},
              {"done", nullptr},
              {"left_s", nullptr}};
  if (done >= 0) out["done"] = done;
  return out;
}

/// What the page draws of a way.
Json path_rows(const KnownWay& way, const SheetEquilibria& equilibria) {
  Json rows = Json::array();
  for (const model::DrivenState& at : way.states)
    rows.push_back({{"theta_rad", at.step.theta},
                    {"force_N", equilibria.force_N(at.step.theta, at.step.load)},
                    {"energy_Nmm", at.step.energy},
                    {"stable", at.step.stable}});
  return rows;
}

/// A folder that goes with its last owner.
std::shared_ptr<fs::path> temporary_folder() {
  std::string name = (fs::temp_directory_path() / "kinetix-studio-XXXXXX").string();
  if (!mkdtemp(name.data())) throw InvalidInput(name + ": cannot be made");
  return {new fs::path(name), [](fs::path* path) {
            std::error_code ignored;
            fs::remove_all(*path, ignored);
            delete path;
          }};
}

/// A name without a way out of its folder.
std::string plain_name(const std::string& name) {
  const bool plain = !name.empty() && name.size() < 100 && name[0] != '.' &&
                     name.find_first_of("/\\") == std::string::npos && name.find('\0') == std::string::npos;
  if (!plain) throw InvalidInput("files: a name must be a plain file name");
  return name;
}

}  // namespace

Session::Session(Opened opened, Outlet outlet)
    : opened_(std::move(opened)),
      outlet_(std::move(outlet)),
      history_(opened_.design),
      player_(opened_.design),
      told_(opened_.result) {
  if (!opened_.target_file.empty()) enqueue([this] { search_for(opened_.target_file, nullptr); });
}

void Session::post(int client, std::string text) {
  enqueue([this, client, text = std::move(text)] { obey(client, text); });
}

void Session::greet(int client) {
  enqueue([this, client] {
    heard_[client] = 0;
    tell(hello_message(history_.current().name), client);
    Json design = design_message(history_.current(), player_.moving());
    tell(std::move(design), client);
    tell_state(client);
    if (!told_.is_null()) tell(told_, client);
    changed_ = true;
  });
}

void Session::enqueue(std::function<void()> work) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(work));
  }
  arrived_.notify_one();
}

void Session::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    do_queued();
    if (player_.plays())
      if (const std::unique_lock alone(engine_, std::try_to_lock); alone) {
        player_.play();
        changed_ = true;
      }
    if (changed_) show();
    wait_for_work(stop);
  }
  tracer_.ask_to_stop();
  searcher_.ask_to_stop();
  exporter_.ask_to_stop();
}

void Session::wait_for_work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const auto ready = [this] { return !queue_.empty(); };
  if (player_.plays())
    arrived_.wait_for(lock, stop, between_plays, ready);
  else
    arrived_.wait(lock, stop, ready);
}

void Session::do_queued() {
  std::deque<std::function<void()>> work;
  {
    const std::lock_guard lock(mutex_);
    work.swap(queue_);
  }
  for (const auto& task : work) task();
}

void Session::obey(int client, const std::string& text) {
  client_ = client;
  id_ = 0;
  try {
    const Message message(text);
    id_ = message.id();
    const auto command = commands().find(message.type());
    if (command == commands().end()) throw InvalidInput("type: unknown command '" + message.type() + "'");
    command->second(*this, message);
    if (id_ > 0) heard_[client] = id_;
    changed_ = true;
  } catch (const InvalidInput& e) {
    tell(error_message(e.what(), id_), client);
  }
  client_ = everybody;
}

const std::map<std::string, Session::Command>& Session::commands() {
  using S = Session;
  using M = Message;
  static const std::map<std::string, Command> all = {
      {"mode", [](S& s, const M& m) { s.set_mode(m); }},
      {"theta",
       [](S& s, const M& m) {
         s.fold_to(m.number("deg", -steepest_deg, steepest_deg) * radians_per_degree);
       }},
      {"drag", [](S& s, const M& m) { s.drag(m); }},
      {"release",
       [](S& s, const M&) {
         s.player_.release();
         s.tell_state();
       }},
      {"fix",
       [](S& s, const M& m) {
         s.player_.fix(s.body_of(m), m.boolean("fixed"));
         s.tell_state();
       }},
      {"push",
       [](S& s, const M& m) {
         s.player_.push(s.body_of(m), m.point("at"), m.number("force_N", -largest_push_N, largest_push_N));
       }},
      {"gravity",
       [](S& s, const M& m) {
         s.player_.set_gravity(m.boolean("on"));
         s.tell_state();
       }},
      {"pause",
       [](S& s, const M& m) {
         s.player_.set_paused(m.boolean("on"));
         s.tell_state();
       }},
      {"step", [](S& s, const M&) { s.player_.step(); }},
      {"speed",
       [](S& s, const M& m) {
         s.player_.set_speed(m.number("factor", 0.05, 1));
         s.tell_state();
       }},
      {"springs",
       [](S& s, const M& m) {
         s.player_.set_springs(m.boolean("on"));
         s.tell_state();
       }},
      {"reset",
       [](S& s, const M&) {
         s.tracer_.ask_to_stop();
         s.player_.reset();
         s.tell_state();
       }},
      {"snap", [](S& s, const M&) { s.snap(); }},
      {"hinge", [](S& s, const M& m) { s.take(with_hinges(s.history_.current(), m)); }},
      {"paint", [](S& s, const M& m) { s.take(with_cell(s.history_.current(), m)); }},
      {"sheet", [](S& s, const M& m) { s.take(with_sheet(s.history_.current(), m)); }},
      {"made", [](S& s, const M& m) { s.take(with_made_hinges(s.history_.current(), m)); }},
      {"nearest", [](S& s, const M&) { s.take_nearest(); }},
      {"undo",
       [](S& s, const M&) {
         s.history_.undo();
         s.design_changed();
       }},
      {"redo",
       [](S& s, const M&) {
         s.history_.redo();
         s.design_changed();
       }},
      {"open", [](S& s, const M& m) { s.open(m); }},
      {"save", [](S& s, const M&) { s.save(); }},
      {"search", [](S& s, const M& m) { s.search(m); }},
      {"part", [](S& s, const M& m) { s.take_part(m); }},
      {"stop", [](S& s, const M&) { s.searcher_.ask_to_stop(); }},
      {"export", [](S& s, const M& m) { s.export_files(m); }},
  };
  return all;
}

int Session::body_of(const Message& message) const {
  return message.integer("body", 0, history_.current().structure.bodies() - 1);
}

void Session::set_mode(const Message& message) {
  const std::string name = message.text("mode");
  if (name != "exact" && name != "equilibrium" && name != "bullet")
    throw InvalidInput("mode: must be exact, equilibrium or bullet");
  tracer_.ask_to_stop();
  player_.enter(name == "exact" ? Mode::exact : name == "bullet" ? Mode::bullet : Mode::equilibrium);
  tell_state();
  if (player_.mode() == Mode::equilibrium) trace(player_.theta());
}

void Session::fold_to(double theta) {
  player_.fold_to(theta);
  if (player_.mode() == Mode::equilibrium) trace(theta);
  if (player_.mode() == Mode::bullet) tell_state();
}

void Session::drag(const Message& message) {
  const int body = body_of(message);
  const Eigen::Vector3d rest = history_.current().structure.rest_position(body);
  player_.drag(body, message.has("at") ? message.point("at") : rest, message.point("to"));
  if (player_.mode() == Mode::equilibrium) trace(player_.theta());
}

void Session::take(DesignFile design) {
  history_.add(std::move(design));
  design_changed();
}

void Session::design_changed() {
  tracer_.ask_to_stop();
  ++revision_;
  result_.reset();
  told_ = nullptr;
  stable_.clear();
  way_.reset();
  ++traces_;  // what is under way is of another design
  player_.load(history_.current());
  tell(design_message(history_.current(), player_.moving()));
  tell_state();
  if (player_.mode() == Mode::equilibrium) trace(player_.theta());
}

void Session::take_nearest() {
  const auto& moving = player_.moving();
  if (moving.exact) throw InvalidInput("nearest: the design moves exactly as it is");
  if (!moving.nearest) throw InvalidInput("nearest: no exact design is known near this one");
  DesignFile design = history_.current();
  design.structure = moving.nearest->sheet;
  take(std::move(design));
}

void Session::open(const Message& message) {
  if (message.has("template")) return take(template_design(message.text("template")));
  take(read_design(targets::parse_document(message.text("yaml"), "design")));
}

void Session::save() {
  const fs::path file = opened_.save_file;
  std::error_code ignored;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
  if (result_ && file.filename() == "design.yaml") {
    Run& run = const_cast<Run&>(*result_);
    write_results(run, file.parent_path().string());
  } else {
    DesignFile design = history_.current();
    design.theta = player_.theta();
    write_file(file.string(), design_text(design));
  }
  history_.mark_saved();
  tell({{"type", "saved"}, {"path", file.string()}});
  tell(design_message(history_.current(), player_.moving()));
}

/// To theta, on its own thread, from what is known of the way; the shapes on it are shown as they come.
void Session::trace(double theta) {
  const int client = client_, number = ++traces_;
  const double id = std::exchange(id_, 0);
  tracer_.start([this, client, number, id, theta, design = history_.current(), known = way_,
                 is_settled = stable_of_ == way_](const std::stop_token& stop) {
    try {
      const SheetEquilibria equilibria(design);
      const auto see = [&](const model::DrivenState& at) {
        const double force = equilibria.force_N(at.step.theta, at.step.load);
        enqueue([this, number, at, force] {
          if (number != traces_) return;
          player_.show_equilibrium(at.state, at.step.theta, force, at.step.energy);
          changed_ = true;
        });
      };
      std::string why;
      const auto way = equilibria.go(theta, known, stop, see, why);
      if (stop.stop_requested()) return dropped(client, id);
      Json rows = path_rows(*way, equilibria);
      enqueue([this, number, client, id, way, why, rows = std::move(rows)] {
        if (id > 0) heard_[client] = id;
        changed_ = true;
        if (number != traces_) return;
        way_ = way;
        tell({{"type", "path"}, {"rows", rows}});
        if (!why.empty()) tell(error_message(why, 0), client);
      });
      if (way == known && is_settled) return;
      auto states = equilibria.stable(*way, stop);
      if (stop.stop_requested()) return;
      enqueue([this, number, way, states = std::move(states)] {
        if (number != traces_) return;
        stable_ = states;
        stable_of_ = way;
      });
    } catch (const std::exception& e) {
      enqueue([this, client, id, what = std::string(e.what())] { tell(error_message(what, id), client); });
    }
  });
}

/// Nobody waits for that command's effect any more.
void Session::dropped(int client, double id) {
  enqueue([this, client, id] {
    if (id > 0) heard_[client] = id;
    changed_ = true;
  });
}

void Session::snap() {
  if (player_.mode() != Mode::equilibrium) throw InvalidInput("snap: needs the mode equilibrium");
  if (stable_.size() < 2)
    throw InvalidInput(
        "snap: no other stable state is known; fold further first, past where it would snap over");
  next_stable_ = (next_stable_ + 1) % stable_.size();
  const model::StableState& state = stable_[next_stable_];
  player_.show_equilibrium(state.state, state.theta, 0, state.energy);
}

void Session::take_part(const Message& message) {
  if (parts_.count(client_) == 0 && parts_.size() >= most_senders) parts_.erase(parts_.begin());
  parts_[client_].add(plain_name(message.text("name")), message.integer("at", 0, most_part_bytes),
                      from_base64(message.text("content")));
}

void Session::search(const Message& message) {
  if (searching_) throw InvalidInput("search: one is going on; stop it first");
  const auto folder = temporary_folder();
  const Parts parts = std::exchange(parts_[client_], {});
  for (const auto& [name, content] : parts.files()) write_file((*folder / name).string(), content);
  if (message.has("files"))
    for (const auto& [name, content] : message.named_texts("files"))
      write_file((*folder / plain_name(name)).string(), from_base64(content));
  const std::string file = (*folder / "target.yaml").string();
  write_file(file, message.text("target"));
  read_target(file);
  search_for(file, folder);
}

/// @param keeps what must live until the search is through
void Session::search_for(const std::string& file, std::shared_ptr<void> keeps) {
  searching_ = true;
  tell_state();
  searcher_.start([this, file, keeps](const std::stop_token& stop) {
    std::string stage_shown;
    std::mutex words;
    const auto start = SteadyClock::now();
    SteadyClock::time_point stage_start = start, next = start;
    const auto progress = [&](const std::string& stage, double done, const std::string& so_far) {
      const std::lock_guard lock(words);
      if (stage != stage_shown) {
        stage_shown = stage;
        stage_start = next = SteadyClock::now();
      }
      if (SteadyClock::now() < next) return;
      next = SteadyClock::now() + between_words;
      Json out = progress_message("search", stage, done, so_far);
      if (done > 0) out["left_s"] = seconds_since(stage_start) * (1 - done) / done;
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
      auto run = std::make_shared<Run>(run_scene(*target.goal, options));
      enqueue([this, run] { found(run); });
    } catch (const std::exception& e) {
      enqueue([this, what = std::string(e.what())] {
        searching_ = false;
        tell(error_message(what, 0));
        tell_state();
      });
    }
  });
}

void Session::found(std::shared_ptr<Run> run) {
  searching_ = false;
  const std::string text = design_export.write(*run).front().content;
  take(read_design(targets::parse_document(text, "the result")));
  fold_to(run->theta);
  result_ = run;
  told_ = {{"type", "result"},
           {"result", result_json(*run)},
           {"summary", summary(*run)},
           {"met", run->goal && run->goal->met()},
           {"stopped", run->stopped}};
  tell(told_);
  tell_state();
  changed_ = true;
}

void Session::export_files(const Message& message) {
  if (exporting_) throw InvalidInput("export: one is going on; wait for it");
  PrintRequest request;
  request.formats = message.texts("formats");
  if (message.has("process")) request.process = message.text("process");
  if (message.has("hinge")) request.hinge = message.text("hinge");
  if (message.has("clearance_mm")) request.clearance_mm = message.number("clearance_mm", 0.01, 10);
  if (message.has("orient")) request.orient = message.text("orient");
  if (message.has("bed_mm")) request.bed_mm = message.numbers("bed_mm", 1, 1e5);
  if (request.bed_mm.size() % 2 != 0 || request.bed_mm.size() > 2)
    throw InvalidInput("bed_mm: must be [x, y]");
  DesignFile design = history_.current();
  if (std::abs(player_.theta()) > 0) design.theta = player_.theta();
  const fs::path beside = fs::path(opened_.save_file).parent_path();
  const std::string folder = (beside / (design.name + "_print")).string();
  exporting_ = true;
  const int client = client_;
  const double id = std::exchange(id_, 0);
  exporter_.start([this, client, id, design = std::move(design), request, folder](const std::stop_token&) {
    const auto progress = [this](const std::string& stage, double done, const std::string& so_far) {
      const Json out = progress_message("export", stage, done, so_far);
      enqueue([this, out] { tell(out); });
    };
    try {
      const Exported out = export_design(design, request, folder, progress);
      enqueue([this, client, id, out] {
        exporting_ = false;
        if (id > 0) heard_[client] = id;
        changed_ = true;
        tell({{"type", "exported"}, {"folder", out.folder}, {"files", out.files}, {"summary", out.text}});
      });
    } catch (const std::exception& e) {
      enqueue([this, client, id, what = std::string(e.what())] {
        exporting_ = false;
        tell(error_message(what, id), client);
      });
    }
  });
}

void Session::show() {
  auto frame = std::make_shared<Frame>(player_.frame());
  frame->revision = revision_;
  frame->heard = heard_;
  outlet_.show(std::move(frame));
  changed_ = false;
}

void Session::tell(const nlohmann::ordered_json& message, int client) const {
  nlohmann::ordered_json out = message;
  if (out["type"] == "design") {
    out["revision"] = revision_;
    out["undo"] = history_.can_undo();
    out["redo"] = history_.can_redo();
    out["unsaved"] = !history_.is_saved();
  }
  outlet_.tell(client, out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void Session::tell_state(int client) const {
  Json state = state_message(player_);
  state["searching"] = searching_;
  tell(state, client);
}

}  // namespace kinetix::app::studio
