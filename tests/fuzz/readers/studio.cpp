#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/studio/messages/templates.hpp"
#include "app/studio/session/session.hpp"
#include "tests/fuzz/input_folder.hpp"

using namespace kinetix;
using app::studio::Session;

namespace {

/// Checks for commands that leave the session's thread or write files. Their duration does not depend on the reader.
bool is_long(const std::string& text) {
  const auto command = nlohmann::json::parse(text, nullptr, false);
  if (!command.is_object()) return false;
  static const std::set<nlohmann::json> types = {"search", "save", "export"};
  return types.contains(command.value("type", nlohmann::json())) ||
         command.value("mode", nlohmann::json()) == "equilibrium";
}

}  // namespace

/// Sends a page's messages, one per line, to a session in its thread. The session ends with its answer to the last
/// message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string last = "987654321";
  std::stop_source stop;
  Session session({app::studio::template_design("strip"), fuzz::input_folder().path("saved.yaml"), {}, 1, 0},
                  {[&](int, const app::studio::Text& text) {
                     if (text.bytes->find(last) != std::string::npos) stop.request_stop();
                   },
                   [](const auto&) {}});
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(lines, line);)
    if (!is_long(line)) session.post(0, line);
  session.post(0, R"({"type": "none of the commands", "id": 987654321})");
  session.run(stop.get_token());
  return 0;
}
