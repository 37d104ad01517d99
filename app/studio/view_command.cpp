#include "app/studio/view_command.hpp"

#include <filesystem>
#include <iostream>
#include <random>
#include <variant>

#include "app/assembly/assembly_file.hpp"
#include "app/console/open_report.hpp"
#include "app/goals/read_target.hpp"
#include "app/studio/assembly/assembly_session.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/studio/server.hpp"
#include "app/studio/session/earlier_result.hpp"
#include "app/studio/session/session.hpp"
#include "app/viewer/assets.hpp"
#include "targets/document/document.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;
using studio::Opened;

using Source = std::variant<Opened, AssemblyFile>;

Source opened_file(const std::string& file) {
  const targets::Node root = targets::read_document(file, max_design_bytes);
  if (is_assembly(root)) return read_assembly(root);
  if (!root.optional("target")) return Opened{read_design(root), file, "", 0, 0};
  read_target(root);  // refuses a broken one before the page is there
  return Opened{studio::template_design("panel"), "", file, 0, 0};
}

Source opened_source(const std::string& source) {
  if (source.empty()) return Opened{studio::template_design("panel"), "", "", 0, 0};
  if (!fs::is_directory(source)) return opened_file(design_at(source));
  const fs::path inside = fs::path(source) / "design.yaml";
  if (fs::exists(inside)) return opened_file(inside.string());
  throw InvalidInput(source +
                     ": no design.yaml in this folder; give a design, a target, or the folder of a result");
}

std::unique_ptr<studio::SessionLoop> session_of(Source source, const CommandOptions& options,
                                                studio::Outlet outlet) {
  if (auto* bodies = std::get_if<AssemblyFile>(&source))
    return std::make_unique<studio::AssemblySession>(std::move(*bodies), options.threads, std::move(outlet));
  Opened& opened = std::get<Opened>(source);
  opened.threads = options.threads;
  opened.seed = options.seed;
  if (!opened.save_file.empty()) opened.result = studio::earlier_result(opened.save_file, opened.design);
  return std::make_unique<studio::Session>(std::move(opened), std::move(outlet));
}

/// 128 bits that nobody can guess, as hexadecimal digits.
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

}  // namespace

int view_command(const CommandOptions& options, const ViewRequest& request) {
  const std::vector<studio::WebFile> files = web_files();
  Source source = opened_source(request.source);
  const std::string token = random_token();
  studio::SessionLoop* to = nullptr;
  studio::Server server(files, token, static_cast<std::uint16_t>(request.port),
                        {[&](int client) { to->greet(client); },
                         [&](int client, std::string text) { to->post(client, std::move(text)); },
                         [&](int client) { to->dismiss(client); }});
  const std::unique_ptr<studio::SessionLoop> session =
      session_of(std::move(source), options,
                 {[&](int client, std::string text) { server.tell(client, std::move(text)); },
                  [&](std::shared_ptr<const studio::Frame> frame) { server.show(std::move(frame)); }});
  to = session.get();
  std::jthread worker([&](const std::stop_token& stop) { session->run(stop); });
  const std::string address = "http://127.0.0.1:" + std::to_string(server.port()) + "/#" + token;
  std::cout << address << std::endl;
  if (request.opens_page) open_report(address);
  server.run();
  return done;
}

}  // namespace kinetix::app
