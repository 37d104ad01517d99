#include "app/studio/session/session.hpp"

#include <fmt/format.h>

#include "app/exports/exporters.hpp"
#include "app/files/bodies_section.hpp"
#include "app/pipeline/imported_bodies.hpp"
#include "app/studio/messages/templates.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double largest_push_N = 1000;  // N: more than a person pushes with
constexpr double same_fold = 1e-6;       // rad of theta: a smaller change from the search's end is not a move

/// Returns the theta (rad) where the equilibrium of a result ended, which can differ from the requested
/// theta. Empty for other results: their designs are shown as saved.
std::optional<double> theta_of_equilibrium(const Json& result_message) {
  return result_message.is_object() && result_message["result"].contains("equilibrium")
             ? theta_reached(result_message)
             : std::nullopt;
}

/// Creates a folder with a new name. If that fails, writing to the returned name fails later.
fs::path new_folder(const fs::path& inside, const std::string& name) {
  std::error_code failure;
  fs::create_directories(inside, failure);
  fs::path folder = inside / name;
  for (int k = 2; !failure && !fs::create_directory(folder, failure); ++k)
    folder = inside / fmt::format("{}_{}", name, k);
  return folder;
}

}  // namespace

void require_showable(const Design& design) {
  if (design.structure.bodies() <= max_bodies) return;
  throw InvalidInput(fmt::format(
      "structure.cells: {} bodies are more than the {} that a page can show. Take fewer cells, or "
      "use `kinetix-opt check`, `simulate` and `export`.",
      design.structure.bodies(), max_bodies));
}

Session::Session(SessionInput opened, MessageSink outlet)
    : SessionLoop(std::move(outlet)),
      input_(std::move(opened)),
      history_(input_.design),
      save_files_{input_.save_file},
      player_(input_.design) {
  history_.set_design_result({.message = input_.result, .theta = input_.design.theta});
  std::optional<AutosavedDesign> kept;
  if (input_.autosave) kept = input_.autosave->kept();
  if (kept) {
    if (kept->save_file != input_.save_file) save_files_.push_back(kept->save_file);
    history_.add(kept->design, static_cast<int>(save_files_.size()) - 1,
                 {.message = kept->result, .theta = kept->design.theta});
    player_ = Player(kept->design);
    restored_ = revision_;
  }
  meshes_of_ = player_.moving().bodies;
  follow();
  const Json& result = history_.design_result().message;
  if (const auto theta = theta_of_equilibrium(result); theta && player_.mode() == Mode::exact)
    player_.fold_to(*theta);
  if (player_.mode() == Mode::equilibrium) enqueue([this] { trace(player_.theta()); });
  if (input_.target && !kept) enqueue([this] { search_for(*input_.target, nullptr); });
}

void Session::welcome(int client) {
  Json hello = hello_message(history_.current().name);
  if (input_.autosave) hello["autosave"] = input_.autosave->folder().string();
  send_message(hello, client);
  if (meshes_of_) send_message(meshes_message(*meshes_of_->structure.assembly()), client);
  if (design_text_.bytes)
    send_text(design_text_, client);
  else
    send_design(client);
  send_state(client);
  send_last_result(client);
  send_path(client);
}

void Session::execute(const Message& message) {
  const auto command = commands().find(message.type());
  if (command == commands().end()) throw InvalidInput("type: unknown command '" + message.type() + "'");
  if (!is_sent_) send_design();
  command->second(*this, message);
}

bool Session::play() {
  const std::unique_lock alone(engine_, std::try_to_lock);
  if (alone) player_.play();
  return alone.owns_lock();
}

void Session::halt() {
  player_.set_paused(true);
  send_state();
}

Frame Session::frame() const {
  Frame frame = player_.frame();
  frame.revision = revision_;
  return frame;
}

void Session::stop_jobs() {
  for (Job* job : {&tracer_, &searcher_, &exporter_, &follower_, &cutter_}) job->stop_current();
}

/// Starts long work for the present client, which receives its errors.
void Session::start(Job& job, double id, const std::string& about, const Job::Work& work) {
  job.start(
      [this, client = client_, id, about, work](const std::stop_token& asked) {
        try {
          work(asked);
        } catch (const std::exception& e) {
          enqueue([this, client, id, about, what = failure_message(e)] {
            send_message(error_message(what, id, about), client);
          });
        }
      },
      [this, client = client_, id] { dropped(client, id); });
}

const std::map<std::string, Session::Command>& Session::commands() {
  using S = Session;
  using M = Message;
  const auto then_send_state =
      [](const Command& change) {  // sends the state to everybody, since the command changes it
        return [change](S& s, const M& m) {
          change(s, m);
          s.send_state();
        };
      };
  static const std::map<std::string, Command> all = {
      {"mode", [](S& s, const M& m) { s.set_mode(m); }},
      {"theta",
       [](S& s, const M& m) {
         s.fold_to(m.number("deg", -steepest_deg, steepest_deg) * radians_per_degree);
       }},
      {"drag", [](S& s, const M& m) { s.drag(m); }},
      {"release", then_send_state([](S& s, const M&) { s.player_.release(); })},
      {"fix", then_send_state([](S& s, const M& m) { s.player_.fix(s.body_of(m), m.boolean("fixed")); })},
      {"push",
       [](S& s, const M& m) {
         s.player_.push(s.body_of(m), m.point("at"), m.number("force_N", -largest_push_N, largest_push_N));
       }},
      {"gravity", then_send_state([](S& s, const M& m) { s.player_.set_gravity(m.boolean("on")); })},
      {"pause", then_send_state([](S& s, const M& m) { s.player_.set_paused(m.boolean("on")); })},
      {"step", [](S& s, const M&) { s.player_.step(); }},
      {"speed", then_send_state([](S& s, const M& m) { s.player_.set_speed(m.number("factor", 0.05, 1)); })},
      {"springs", then_send_state([](S& s, const M& m) { s.player_.set_springs(m.boolean("on")); })},
      {"reset", then_send_state([](S& s, const M&) {
         s.tracer_.stop_current();
         ++s.traces_;  // discards its states that wait to be shown
         s.player_.reset();
       })},
      {"snap", [](S& s, const M&) { s.snap(); }},
      {"hinge", [](S& s, const M& m) { s.take(with_hinges(s.history_.current(), m)); }},
      {"paint", [](S& s, const M& m) { s.take(with_cell(s.history_.current(), m)); }},
      {"sheet", [](S& s, const M& m) { s.take(with_sheet(s.history_.current(), m)); }},
      {"made", [](S& s, const M& m) { s.take(with_manufactured_hinges(s.history_.current(), m)); }},
      {"nearest", [](S& s, const M&) { s.apply_nearest_design(); }},
      {"undo", [](S& s, const M&) { s.step_history(false); }},
      {"redo", [](S& s, const M&) { s.step_history(true); }},
      {"open", [](S& s, const M& m) { s.open(m); }},
      {"save", [](S& s, const M& m) { s.save(m); }},
      {"search", [](S& s, const M& m) { s.search(m); }},
      {"part", [](S& s, const M& m) { s.receive_part(m); }},
      {"stop", [](S& s, const M&) { s.searcher_.stop_current(); }},
      {"driven", [](S& s, const M& m) { s.take(with_driven_hinge(s.history_.current(), m)); }},
      {"export", [](S& s, const M& m) { s.export_files(m); }},
  };
  return all;
}

int Session::body_of(const Message& message) const {
  return message.integer("body", 0, static_cast<int>(player_.moving().linkage.bodies.size()) - 1);
}

void Session::set_mode(const Message& message) {
  const std::string name = message.text("mode");
  if (name != "exact" && name != "equilibrium" && name != "bullet")
    throw InvalidInput("mode: must be exact, equilibrium or bullet");
  const Mode mode = name == "exact" ? Mode::exact : name == "bullet" ? Mode::bullet : Mode::equilibrium;
  const Moving& moving = player_.moving();
  if (moving.bodies && mode == Mode::equilibrium)
    require_one_axis(*moving.bodies->structure.assembly(), moving.motion->pulled);
  awaited_.reset();
  if (moving.bodies && mode != Mode::exact && !moving.parts) return cut_pieces_for(mode);
  enter(mode);
}

void Session::enter(Mode mode) {
  tracer_.stop_current();
  player_.enter(mode);
  send_state();
  if (player_.mode() == Mode::equilibrium) trace(player_.theta());
}

void Session::fold_to(double theta) {
  player_.fold_to(theta);
  if (player_.mode() == Mode::equilibrium) trace(player_.theta());
  if (player_.mode() == Mode::bullet) send_state();
}

void Session::drag(const Message& message) {
  const int body = body_of(message);
  const Eigen::Vector3d rest = player_.moving().linkage.rest_position(body);
  player_.drag(body, message.has("at") ? message.point("at") : rest, message.point("to"));
  if (player_.mode() == Mode::equilibrium) trace(player_.theta());
}

void Session::take(Design design, DesignResult design_result) {
  add(std::move(design), history_.thing(), std::move(design_result));
}

/// Adds a design that does not derive from the present one. `save` must not overwrite the present one's file.
void Session::replace_design(Design design, DesignResult design_result) {
  save_files_.emplace_back();
  add(std::move(design), static_cast<int>(save_files_.size()) - 1, std::move(design_result));
}

/// Adds and shows a design. If it cannot be loaded, for example for lack of memory, the one before stays.
void Session::add(Design design, int thing, DesignResult design_result) {
  player_.load(design);
  history_.add(std::move(design), thing, std::move(design_result));
  design_changed();
}

void Session::step_history(bool forth) {
  const auto go = [this](bool on) { return on ? history_.redo() : history_.undo(); };
  if (!go(forth)) return;
  try {
    player_.load(history_.current());
  } catch (...) {
    go(!forth);
    throw;
  }
  design_changed();
}

/// @pre the player has loaded the design
void Session::design_changed() {
  tracer_.stop_current();
  ++revision_;
  stable_.clear();
  known_equilibria_.reset();
  path_ = nullptr;
  ++traces_;  // running traces belong to another design
  changed_ = true;
  is_sent_ = false;
  design_text_ = {};
  keep_unsaved();
  send_design();
  send_state();
  send_last_result();
  follow();
  if (player_.mode() == Mode::equilibrium) trace(player_.theta());
}

/// Keeps the unsaved design on the disk: a studio opens it after a crash.
void Session::keep_unsaved() {
  if (!input_.autosave) return;
  try {
    if (history_.is_saved())
      input_.autosave->forget();
    else
      input_.autosave->keep(history_.current(), save_files_[history_.thing()],
                            history_.design_result().message);
    not_kept_.clear();
  } catch (const std::exception& e) {
    not_kept_ = failure_message(e);
  }
}

void Session::apply_nearest_design() {
  const auto& moving = player_.moving();
  if (moving.exact) throw InvalidInput("nearest: the design already moves with one degree of freedom");
  if (!moving.nearest) throw InvalidInput("nearest: no exact design is known near this one");
  Design design = history_.current();
  design.structure = moving.nearest->sheet;
  take(std::move(design));
}

void Session::open(const Message& message) {
  if (message.has("template")) return replace_design(template_design(message.text("template")));
  const targets::Node root = targets::parse_document(message.text("yaml"), "design");
  if (lists_bodies(root))
    throw InvalidInput("open: a design of bodies needs its mesh files. Open it with `kinetix-opt view` FILE");
  Design design = read_design(root);
  require_showable(design);
  replace_design(std::move(design));
}

/// Returns the path to save the present design to; creates a results folder on first save.
fs::path Session::save_file() {
  std::string& file = save_files_[history_.thing()];
  if (file.empty()) file = (new_folder(input_.results, history_.current().name) / "design.yaml").string();
  return file;
}

/// Saves a result that was kept with its design, unless the folder has a result.json.
void Session::save_result_beside(const std::string& folder) const {
  const Json& result_message = history_.design_result().message;
  const fs::path file = fs::path(folder) / "result.json";
  std::error_code none;
  if (result_message.is_object() && !fs::exists(file, none))
    write_file(file.string(), result_message["result"].dump(1) + "\n");
}

/// Saves the design. `at_fold` saves it at the shown fold, which changes the design.
void Session::save(const Message& message) {
  const bool at_fold = message.has("at_fold") && message.boolean("at_fold");
  Design design = history_.current();
  if (at_fold)
    design =
        design_for_saving(std::move(design), player_.moving(), player_.sheet_theta(), player_.drive_theta());
  const fs::path file = save_file();
  std::error_code ignored;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
  const DesignResult design_result = history_.design_result();
  const bool has_results = design_result.run && file.filename() == "design.yaml";
  if (has_results)
    write_results(*design_result.run, file.parent_path().string());
  else if (file.filename() == "design.yaml")
    save_result_beside(file.parent_path().string());
  const bool is_moved = has_results && std::abs(design.theta - design_result.theta) > same_fold;
  if (!has_results || is_moved) {
    FileSet files(file.parent_path().string());
    for (const NamedContent& one : design_files(design))
      files.add(one.name == "design.yaml" ? file.filename().string() : one.name, one.content);
    files.commit();
  }
  if (design.theta != history_.current().theta || design.drive != history_.current().drive)
    history_.add(design, history_.thing(), design_result);
  history_.mark_saved();
  keep_unsaved();
  send_message({{"type", "saved"},
                {"path", file.string()},
                {"theta_rad", requested_theta(design, player_.moving())},
                {"at_fold", at_fold}});
  send_design();
}

/// Sends the newest design. If bodies changed their shape, their meshes are sent to everybody before it.
void Session::send_design(int client) {
  const auto& bodies = player_.moving().bodies;
  if (bodies && !have_same_shape(bodies.get(), meshes_of_.get())) {
    meshes_of_ = bodies;
    send_message(meshes_message(*bodies->structure.assembly()));
  }
  Json out = design_message(history_.current(), player_.moving());
  out["revision"] = revision_;
  out["undo"] = history_.can_undo();
  out["redo"] = history_.can_redo();
  out["unsaved"] = !history_.is_saved();
  out["kept"] = input_.autosave && not_kept_.empty();
  if (!not_kept_.empty()) out["not_kept"] = not_kept_;
  out["restored"] = restored_ == revision_ && !history_.is_saved();
  out["has_result"] = !history_.design_result().message.is_null();
  design_text_ = text_of(out);
  send_text(design_text_, client);
  if (client == all_clients) is_sent_ = true;
}

/// Sends the result of the present design, if any.
void Session::send_last_result(int client) const {
  Json result_message = history_.design_result().message;
  if (result_message.is_null()) return;
  result_message["revision"] = revision_;
  send_message(result_message, client);
}

void Session::send_path(int client) const {
  if (!path_.is_null()) send_message({{"type", "path"}, {"revision", revision_}, {"rows", path_}}, client);
}

void Session::send_state(int client) const {
  Json state = state_message(player_);
  state["searching"] = searching_;
  send_message(state, client);
}

}  // namespace kinetix::app::studio
