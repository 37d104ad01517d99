#include "app/studio/view_command.hpp"

#include <cstdlib>
#include <future>
#include <iostream>

#include "app/goals/registry.hpp"
#include "app/io/atomic_file.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/studio/server.hpp"
#include "app/studio/session/autosave.hpp"
#include "app/studio/session/session.hpp"
#include "app/studio/session/uploads.hpp"
#include "app/viewer/assets.hpp"
#include "targets/document/document.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;
using studio::SessionInput;

constexpr std::chrono::milliseconds patience{500};  // at the end, for work that still runs

/// Returns an absolute path, which stays valid if the working directory changes.
std::string absolute(const std::string& file) {
  std::error_code failure;
  const fs::path path = fs::absolute(file, failure);
  return failure ? file : path.lexically_normal().string();
}

SessionInput input_of_file(const std::string& file, const targets::DocumentChanges& changes) {
  const targets::Node root = targets::read_changed_document(file, max_design_bytes, changes);
  if (root.optional("target")) {
    read_target(root);  // rejects a broken target before the page opens
    return SessionInput{studio::template_design("panel"), "", root};
  }
  Design design = read_design(root);
  studio::require_showable(design);
  return SessionInput{std::move(design), file};
}

SessionInput input_of_source(const std::string& source, const targets::DocumentChanges& changes) {
  if (!source.empty()) return input_of_file(absolute(design_at(source)), changes);
  if (!changes.empty())
    throw InvalidInput("--process, --hinge, --bed and --lock change a file: name a design or a target");
  return SessionInput{studio::template_design("panel")};
}

/// Returns the store of unsaved designs; null if nothing can be kept.
std::shared_ptr<studio::Autosave> autosave_of(const SessionInput& opened) {
  const fs::path place = studio::autosave_place();
  if (place.empty()) return nullptr;
  const std::string file = opened.target ? opened.target->place().file : opened.save_file;
  try {
    return std::make_shared<studio::Autosave>(place, file.empty() ? absolute("new") : file);
  } catch (const InvalidInput& e) {
    std::cerr << "warning: " << e.what() << "\n";
    return nullptr;
  }
}

std::unique_ptr<studio::Session> session_of(SessionInput opened, const CommandOptions& options,
                                            std::shared_ptr<studio::Autosave> autosave,
                                            studio::MessageSink outlet) {
  opened.threads = options.threads;
  opened.seed = options.seed;
  opened.results = absolute(opened.results);
  opened.autosave = std::move(autosave);
  if (!opened.save_file.empty() && options.changes.empty())
    opened.result = studio::earlier_result(opened.save_file, opened.design);
  return std::make_unique<studio::Session>(std::move(opened), std::move(outlet));
}

/// Returns 128 random bits as hexadecimal digits.
std::string random_token() {
  std::random_device device;
  std::string token;
  for (int k = 0; k < 32; ++k) token += "0123456789abcdef"[device() % 16];
  return token;
}

std::vector<studio::WebFile> web_files() {
  std::vector<studio::WebFile> files;
  for (const Asset& asset : studio_assets()) files.push_back({asset.path, asset.type, asset.content});
  if (files.empty())
    throw InvalidInput("this program was built without the studio: its pages need npm when it is built");
  return files;
}

/// Stops the session. @return whether it ended in time; work that still runs ends with the program
bool ends_in_time(std::jthread worker, std::unique_ptr<studio::Session> session) {
  std::promise<void> ended;
  const std::future<void> end = ended.get_future();
  worker.request_stop();
  std::thread closer(
      [worker = std::move(worker), session = std::move(session), ended = std::move(ended)]() mutable {
        worker.join();
        session.reset();
        ended.set_value();
      });
  const bool in_time = end.wait_for(patience) == std::future_status::ready;
  if (in_time)
    closer.join();
  else
    closer.detach();
  return in_time;
}

/// Moves an unsaved design aside and prints its path. The next studio does not open it.
void put_aside(studio::Autosave* autosave) {
  const std::string file = autosave ? autosave->put_aside() : "";
  if (!file.empty()) std::cerr << "The design was not saved. `kinetix-opt view " << file << "` opens it.\n";
}

}  // namespace

int view_command(const CommandOptions& options, const ViewRequest& request) {
  const std::vector<studio::WebFile> files = web_files();
  SessionInput opened = input_of_source(request.source, options.changes);
  const std::string token = random_token();
  studio::Session* to = nullptr;
  studio::Server server(files, token, static_cast<std::uint16_t>(request.port),
                        {[&](int client) { to->add_client(client); },
                         [&](int client, std::string text) { to->post(client, std::move(text)); },
                         [&](int client) { to->remove_client(client); }});
  const std::shared_ptr<studio::Autosave> autosave = autosave_of(opened);
  std::unique_ptr<studio::Session> session =
      session_of(std::move(opened), options, autosave,
                 {[&](int client, studio::Text text) { server.send_message(client, std::move(text)); },
                  [&](std::shared_ptr<const studio::Frame> frame) { server.show(std::move(frame)); },
                  [&](int client, std::size_t bytes) { server.took(client, bytes); }});
  to = session.get();
  std::jthread worker([to](const std::stop_token& stop) { to->run(stop); });
  const std::string address = "http://127.0.0.1:" + std::to_string(server.port()) + "/#" + token;
  std::cout << address << std::endl;
  if (request.opens_browser) open_report(address);
  server.run();
  const bool in_time = ends_in_time(std::move(worker), std::move(session));
  put_aside(autosave.get());
  if (in_time) return done;
  remove_unfinished_of_others();
  studio::remove_temporary_folders();
  std::_Exit(done);
}

}  // namespace kinetix::app
