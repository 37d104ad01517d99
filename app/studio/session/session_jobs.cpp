#include "app/console/console.hpp"
#include "app/goals/registry.hpp"
#include "app/io/atomic_file.hpp"
#include "app/io/bytes.hpp"
#include "app/pipeline/imported_bodies.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/export_command.hpp"
#include "app/print/fit.hpp"
#include "app/result/result_json.hpp"
#include "app/result/summary.hpp"
#include "app/result/verdict.hpp"
#include "app/studio/messages/message.hpp"
#include "app/studio/session/session.hpp"
#include "app/studio/session/uploads.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_progress_texts{
    500};                               // of a search, on screen: as often as people read them
constexpr std::size_t max_senders = 8;  // pages whose parts of files are kept

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

/// Removes the path of a temporary folder from a message: the user did not name it. @param folder null: none
std::string without_folder(std::string message, const fs::path* folder) {
  if (!folder) return message;
  const std::string path = folder->string() + "/";
  for (std::size_t at = 0; (at = message.find(path, at)) != std::string::npos;)
    message.erase(at, path.size());
  return message;
}

}  // namespace

void Session::receive_part(const Message& message) {
  if (parts_.count(client_) == 0 && parts_.size() >= max_senders) parts_.erase(parts_.begin());
  constexpr double farthest = 1e15;  // largest whole number allowed here; Parts has a separate limit
  parts_[client_].add(plain_name(message.text("name")),
                      static_cast<std::int64_t>(message.number("at", 0, farthest)),
                      from_base64(message.text("content")));
}

void Session::search(const Message& message) {
  if (searching_) throw InvalidInput("search: a search is running. Stop it first");
  const auto folder = make_temporary_folder();
  Parts parts = std::exchange(parts_[client_], {});
  if (message.has("files"))
    for (const auto& [name, content] : message.named_texts("files"))
      parts.add(plain_name(name), 0, from_base64(content));
  for (const auto& [name, content] : parts.files()) write_file((*folder / name).string(), content);
  const std::string file = (*folder / "target.yaml").string();
  write_file(file, message.text("target"));
  try {
    const targets::Node root = targets::read_document(file, max_design_bytes);
    read_target(root);
    search_for(root, folder);
  } catch (const InvalidInput& e) {
    throw InvalidInput(without_folder(e.what(), folder.get()));
  }
}

/// @param folder of the target's files, which lives until the search ends; null for a target that the user named
void Session::search_for(const targets::Node& root, std::shared_ptr<const fs::path> folder) {
  searcher_.start([this, root, folder](const std::stop_token& stop) {
    std::string stage_shown;
    TimeLeft left;
    std::mutex text_mutex;
    const auto start = SteadyClock::now();
    SteadyClock::time_point stage_start = start, next = start;
    const auto progress = [&](const std::string& stage, double done, const std::string& so_far) {
      const std::lock_guard lock(text_mutex);
      if (stage != stage_shown) {
        stage_shown = stage;
        stage_start = next = SteadyClock::now();
        left = {};
      }
      left.update(seconds_since(stage_start), done);
      if (SteadyClock::now() < next) return;
      next = SteadyClock::now() + between_progress_texts;
      Json out = progress_message("search", stage, done, so_far);
      if (const auto seconds = left.at(seconds_since(stage_start)); seconds && done < 1)
        out["left_s"] = *seconds;
      send_message(out);
    };
    try {
      const Target target = read_target(root);
      RunOptions options;
      options.threads = input_.threads;
      options.seed = input_.seed;
      options.progress = progress;
      options.stop = stop;
      options.engine = &engine_;
      options.printable = answer_of_export;
      options.printable_size = find_printable_size;
      options.seeks_remedy = true;
      auto run = std::make_shared<Run>(run_goal(*target.goal, options));
      enqueue([this, run] { found(run); });
    } catch (const std::exception& e) {
      enqueue([this, what = without_folder(failure_message(e), folder.get())] {
        searching_ = false;
        send_message(error_message(what, 0, "search"));
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
  DesignResult design_result{run,
                             {{"type", "result"},
                              {"result", result_json(*run)},
                              {"summary", page_summary(short_form(*run))},
                              {"details", summary(*run)},
                              {"met", verdict_of(*run).met.value_or(false)},
                              {"stopped", run->stopped}},
                             design.theta};
  if (is_other)
    replace_design(std::move(design), std::move(design_result));
  else
    take(std::move(design), std::move(design_result));
  fold_to(run->theta);
  send_state();
  changed_ = true;
}

namespace {

/// Returns the rows of an equilibrium path that the page draws.
Json path_rows(const KnownEquilibria& path, const Equilibria& equilibria) {
  Json rows = Json::array();
  for (const model::DrivenState& at : path.states)
    rows.push_back({{"theta_rad", at.step.theta},
                    {"force_N", equilibria.force_N(at.step.theta, at.step.load)},
                    {"energy_Nmm", at.step.energy},
                    {"stable", at.step.stable}});
  return rows;
}

}  // namespace

/// Newest shape of an equilibrium path that is not shown yet.
struct Session::NewestShape {
  std::mutex mutex;
  std::optional<std::pair<model::DrivenState, double>> at;  ///< state and its force, N
};

/// Traces equilibria to theta on a separate thread, starting from the known ones. Shapes are shown as they
/// are found.
void Session::trace(double theta) {
  if (theta == 0) return show_flat();
  const int client = client_, number = ++traces_;
  const double id = std::exchange(id_, 0);
  start(
      tracer_, id, "theta",
      [this, client, number, id, theta, design = history_.current(), moving = player_.moving(),
       known = known_equilibria_, is_settled = stable_of_ == known_equilibria_](const std::stop_token& stop) {
        if (stop.stop_requested()) return dropped(client, id);
        const Equilibria equilibria(design, moving);
        const auto newest = std::make_shared<NewestShape>();
        const auto see = [&](const model::DrivenState& at) {
          const double force = equilibria.force_N(at.step.theta, at.step.load);
          const std::lock_guard lock(newest->mutex);
          const bool is_awaited = newest->at.has_value();
          newest->at.emplace(at, force);
          if (!is_awaited) enqueue([this, number, newest] { show_newest(number, *newest); });
        };
        std::string why;
        const auto path = equilibria.trace_to(theta, known, stop, see, why);
        if (stop.stop_requested()) return dropped(client, id);
        Json rows = path_rows(*path, equilibria);
        enqueue([this, number, client, id, path, why, rows = std::move(rows)] {
          note_processed(client, id);
          changed_ = true;
          if (number != traces_) return;
          known_equilibria_ = path;
          path_ = rows;
          send_path();
          if (!why.empty()) send_message(error_message(why, 0, "equilibrium"), client);
        });
        if (path == known && is_settled) return;
        auto states = equilibria.stable(*path, stop);
        if (stop.stop_requested()) return;
        enqueue([this, number, path, states = std::move(states)] {
          if (number != traces_) return;
          stable_ = states;
          stable_of_ = path;
        });
      });
}

/// Shows the flat state, which needs no search: nothing is strained.
void Session::show_flat() {
  tracer_.stop_current();
  ++traces_;
  player_.show_equilibrium(rest_state(player_.moving().linkage), 0, 0, 0);
  changed_ = true;
}

void Session::show_newest(int number, NewestShape& newest) {
  std::optional<std::pair<model::DrivenState, double>> shape;
  {
    const std::lock_guard lock(newest.mutex);
    shape = std::exchange(newest.at, std::nullopt);
  }
  if (number != traces_ || !shape) return;
  const auto& [at, force] = *shape;
  player_.show_equilibrium(at.state, at.step.theta, force, at.step.energy);
  changed_ = true;
}

/// Reports the command as done: newer work replaced it.
void Session::dropped(int client, double id) {
  enqueue([this, client, id] {
    note_processed(client, id);
    changed_ = true;
  });
}

void Session::snap() {
  if (player_.mode() != Mode::equilibrium) throw InvalidInput("snap: needs the mode equilibrium");
  if (stable_.size() < 2)
    throw InvalidInput("snap: no other stable state is known. Fold further first, past the snap-through");
  next_stable_ = (next_stable_ + 1) % stable_.size();
  const model::StableState& state = stable_[next_stable_];
  player_.show_equilibrium(state.state, player_.moving().theta_of(state.state), 0, state.energy);
}

/// Computes the motion of bodies if it is not known yet, and then its collisions.
void Session::follow() {
  if (!player_.moving().bodies || player_.moving().motion->meets) return;
  const Design& design = history_.current();
  const double theta = player_.moving().motion->followed ? 0 : requested_theta(design, player_.moving());
  start(follower_, 0, type_,
        [this, revision = revision_, theta, pull = pull_of(design),
         moving = player_.moving()](const std::stop_token& asked) {
          const auto stop = [&] { return asked.stop_requested(); };
          const auto send_motion = [&](const BodiesMotion& path, double to) {
            if (stop()) return;
            enqueue([this, revision, to, path = std::make_shared<const BodiesMotion>(path)] {
              if (revision == revision_) take(path, to);
            });
          };
          BodiesMotion path = *moving.motion;
          if (!path.followed) send_motion(path = motion_of(moving.linkage, path.hinge, pull, stop), theta);
          const model::Assembly& assembly = *moving.bodies->structure.assembly();
          path.meets = {first_collision(assembly, path, -1, stop), first_collision(assembly, path, 1, stop)};
          send_motion(path, 0);
        });
}

void Session::take(std::shared_ptr<const BodiesMotion> motion, double theta) {
  player_.take(std::move(motion));
  send_design();
  if (theta != 0) fold_to(theta);
  changed_ = true;
}

/// Cuts bodies into convex pieces for collisions, once and in the background, and then enters the mode.
void Session::cut_pieces_for(Mode mode) {
  awaited_ = mode;
  const double id = std::exchange(id_, 0);
  start(cutter_, id, type_, [this, client = client_, id, moving = player_.moving()](const std::stop_token&) {
    const model::Assembly& assembly = *moving.bodies->structure.assembly();
    const BodyPieces pieces = pieces_of(assembly, input_.threads);
    const auto parts = std::make_shared<const sim::ContactParts>(contact_parts(pieces, assembly));
    std::unique_lock alone(engine_);
    const auto pressing =
        std::make_shared<const model::ConvexBodies>(convex_bodies(pieces, assembly, moving.linkage));
    alone.unlock();
    enqueue([this, client, id, of = moving.bodies, parts, pressing] {
      const bool is_shown = have_same_shape(of.get(), player_.moving().bodies.get());
      if (is_shown) player_.take(parts, pressing);
      note_processed(client, id);
      changed_ = true;
      if (const auto wanted = std::exchange(awaited_, {}); wanted && is_shown) enter(*wanted);
    });
  });
}

namespace {}  // namespace

void Session::export_files(const Message& message) {
  if (exporting_) throw InvalidInput("export: an export is running. Wait for its end");
  PrintRequest request;
  request.formats = message.texts("formats");
  if (message.has("process")) request.process = message.text("process");
  if (message.has("hinge")) request.hinge = message.text("hinge");
  if (message.has("clearance_mm")) request.clearance_mm = message.number("clearance_mm", 0.01, 10);
  if (message.has("orient")) request.orient = message.text("orient");
  if (message.has("bed_mm")) request.bed_mm = message.numbers("bed_mm", 1, 1e5);
  if (request.bed_mm.size() % 2 != 0 || request.bed_mm.size() > 2)
    throw InvalidInput("bed_mm: must be [x, y]");
  const bool at_fold = message.has("at_fold") && message.boolean("at_fold");
  Design design = history_.current();
  if (at_fold)
    design =
        design_at_shown_fold(std::move(design), player_.moving(), player_.sheet_theta(), player_.theta());
  const fs::path beside = save_file().parent_path();
  const std::string folder = (beside / (design.name + "_print")).string();
  const int client = client_;
  const double id = std::exchange(id_, 0);
  exporter_.start([this, client, id, theta = requested_theta(design, player_.moving()),
                   design = std::move(design), request, folder, at_fold,
                   revision = revision_](const std::stop_token&) {
    const auto progress = [this](const std::string& stage, double done, const std::string& so_far) {
      const Json out = progress_message("export", stage, done, so_far);
      enqueue([this, out] { send_message(out); });
    };
    try {
      const Exported out = export_design(design, request, folder, progress);
      enqueue([this, client, id, out, at_fold, revision, theta] {
        exporting_ = false;
        note_processed(client, id);
        changed_ = true;
        send_message({{"type", "exported"},
                      {"folder", out.folder},
                      {"files", out.files},
                      {"summary", out.text},
                      {"card", Json::parse(out.card)},
                      {"revision", revision},
                      {"theta_rad", theta},
                      {"at_fold", at_fold}});
      });
    } catch (const std::exception& e) {
      enqueue([this, client, id, what = failure_message(e)] {
        exporting_ = false;
        send_message(error_message(what, id, "export"), client);
      });
    }
  });
  exporting_ = true;
}

}  // namespace kinetix::app::studio
