#include "app/studio/assembly/assembly_session.hpp"

#include <algorithm>
#include <array>

#include "app/assembly/assembly_run.hpp"
#include "app/studio/messages/design_message.hpp"
#include "app/studio/messages/failure_message.hpp"
#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {
namespace {

// Commands that edit, search or write, or need what bodies have not.
constexpr std::array of_sheets = {"push", "springs", "snap", "hinge", "nearest", "paint", "sheet", "made",
                                  "undo", "redo",    "open", "save",  "search",  "part",  "stop",  "export"};

InvalidInput refusal(const std::string& type) {
  const bool is_known = std::find(of_sheets.begin(), of_sheets.end(), type) != of_sheets.end();
  if (!is_known) return InvalidInput("type: unknown command '" + type + "'");
  return InvalidInput(type + ": is of sheets; a design of bodies is turned by a hinge and played with");
}

}  // namespace

AssemblySession::AssemblySession(AssemblyFile file, int threads, Outlet outlet)
    : SessionLoop(std::move(outlet)), player_(std::move(file)), threads_(threads) {
  drive_by(player_.driven(), player_.theta_at(player_.file().angle), player_.file().pull());
}

void AssemblySession::welcome(int client) {
  tell_json(assembly_hello(player_.file().name), client);
  tell_json(meshes_message(player_.file().assembly), client);
  tell_design(client);
  tell_state(client);
}

void AssemblySession::obey(const Message& message) {
  const auto command = commands().find(message.type());
  if (command == commands().end()) throw refusal(message.type());
  command->second(*this, message);
}

bool AssemblySession::play() {
  player_.play();
  return true;
}

Frame AssemblySession::frame() const {
  Frame frame = player_.frame();
  frame.revision = revision_;
  return frame;
}

void AssemblySession::halt() {
  player_.set_paused(true);
  tell_state();
}

void AssemblySession::stop_jobs() {
  follower_.ask_to_stop();
  cutter_.ask_to_stop();
}

const std::map<std::string, AssemblySession::Command>& AssemblySession::commands() {
  using S = AssemblySession;
  using M = Message;
  static const std::map<std::string, Command> all = {
      {"mode", [](S& s, const M& m) { s.set_mode(m); }},
      {"theta",
       [](S& s, const M& m) {
         s.player_.fold_to(m.number("deg", -steepest_deg, steepest_deg) * radians_per_degree);
         if (s.player_.mode() == Mode::bullet) s.tell_state();
       }},
      {"drag",
       [](S& s, const M& m) {
         const int body = s.body_of(m);
         const Eigen::Vector3d rest = s.player_.linkage().rest_position(body);
         s.player_.drag(body, m.has("at") ? m.point("at") : rest, m.point("to"));
       }},
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
      {"reset",
       [](S& s, const M&) {
         s.player_.reset();
         s.tell_state();
       }},
      {"driven",
       [](S& s, const M& m) {
         const int hinges = static_cast<int>(s.player_.linkage().hinges.size());
         const int hinge = m.integer("hinge", 0, hinges - 1);
         if (s.player_.linkage().hinges[hinge].ball)
           throw InvalidInput("hinge: is a ball, which has no axis to be turned about");
         s.drive_by(hinge, 0);
       }},
  };
  return all;
}

int AssemblySession::body_of(const Message& message) const {
  return message.integer("body", 0, static_cast<int>(player_.linkage().bodies.size()) - 1);
}

void AssemblySession::set_mode(const Message& message) {
  const std::string name = message.text("mode");
  if (name == "equilibrium")
    throw InvalidInput(
        "equilibrium: of a design of bodies it is not live; `kinetix-opt simulate --model equilibrium` finds "
        "it");
  if (name != "exact" && name != "bullet") throw InvalidInput("mode: must be exact or bullet");
  awaits_engine_ = false;
  if (name == "bullet") return enter_engine();
  player_.enter_exact();
  tell_state();
}

/// Long work for whoever asked for it, who hears what goes wrong.
void AssemblySession::start(Job& job, double id, const std::function<void(const std::stop_token&)>& work) {
  job.start(
      [this, client = client_, id, type = type_, work](const std::stop_token& asked) {
        try {
          work(asked);
        } catch (const std::exception& e) {
          enqueue([this, client, id, type, what = failure_message(e)] {
            tell_json(error_message(what, id, type), client);
          });
        }
      },
      [this, client = client_, id] {
        enqueue([this, client, id] {
          note_heard(client, id);
          changed_ = true;
        });
      });
}

/// Bodies collide by convex pieces, which are cut once and take a while.
void AssemblySession::enter_engine() {
  if (parts_) {
    player_.enter_engine(parts_);
    return tell_state();
  }
  awaits_engine_ = true;
  const int client = client_;
  const double id = std::exchange(id_, 0);
  start(cutter_, id, [this, client, id, assembly = player_.file().assembly](const std::stop_token&) {
    const auto parts =
        std::make_shared<const sim::ContactParts>(contact_parts(pieces_of(assembly, threads_), assembly));
    enqueue([this, client, id, parts] {
      parts_ = parts;
      if (std::exchange(awaits_engine_, false)) player_.enter_engine(parts_);
      note_heard(client, id);
      changed_ = true;
      tell_state();
    });
  });
}

/// @param theta to which it is then turned, rad   @param pull of the bodies, instead of a turned hinge
void AssemblySession::drive_by(int hinge, double theta, const std::optional<model::Pull>& pull) {
  player_.drive_by(hinge);
  ++revision_;
  known_ = {};
  tell_design();
  tell_state();
  const auto job = [this, revision = revision_, theta, linkage = player_.linkage(),
                    assembly = player_.file().assembly, hinge, pull](const std::stop_token& asked) {
    const auto stop = [&] { return asked.stop_requested(); };
    const AssemblyWay way = pull ? way_of_pull(linkage, *pull, hinge, stop) : way_of(linkage, hinge, stop);
    if (stop()) return;
    enqueue([this, revision, theta, way] {
      if (revision == revision_) take(way, theta);
    });
    const WayKnown known{
        true, true, {first_meeting(assembly, way.back, stop), first_meeting(assembly, way.forth, stop)}};
    if (stop()) return;
    enqueue([this, revision, known] {
      if (revision != revision_) return;
      known_ = known;
      tell_design();
    });
  };
  start(follower_, 0, job);
}

void AssemblySession::take(const AssemblyWay& way, double theta) {
  player_.take(way);
  known_.followed = true;
  tell_design();
  if (theta != 0) player_.fold_to(theta);
  changed_ = true;
}

void AssemblySession::tell_design(int client) const {
  tell_json(assembly_design(player_, revision_, known_), client);
}

void AssemblySession::tell_state(int client) const { tell_json(assembly_state(player_), client); }

}  // namespace kinetix::app::studio
