#include "app/studio/session/session.hpp"

#include <filesystem>

#include "app/print/export_command.hpp"
#include "app/studio/messages/design_message.hpp"
#include "app/studio/messages/message.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

}  // namespace

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
  const bool at_fold = message.has("at_fold") && message.boolean("at_fold");
  Design design = history_.current();
  if (at_fold)
    design =
        design_at_shown_fold(std::move(design), player_.moving(), player_.sheet_theta(), player_.theta());
  const fs::path beside = save_file().parent_path();
  const std::string folder = (beside / (design.name + "_print")).string();
  const int client = client_;
  const double id = std::exchange(id_, 0);
  exporter_.start([this, client, id, theta = asked_theta(design, player_.moving()),
                   design = std::move(design), request, folder, at_fold,
                   revision = revision_](const std::stop_token&) {
    const auto progress = [this](const std::string& stage, double done, const std::string& so_far) {
      const Json out = progress_message("export", stage, done, so_far);
      enqueue([this, out] { tell(out); });
    };
    try {
      const Exported out = export_design(design, request, folder, progress);
      enqueue([this, client, id, out, at_fold, revision, theta] {
        exporting_ = false;
        note_heard(client, id);
        changed_ = true;
        tell({{"type", "exported"},
              {"folder", out.folder},
              {"files", out.files},
              {"summary", out.text},
              {"revision", revision},
              {"theta_rad", theta},
              {"at_fold", at_fold}});
      });
    } catch (const std::exception& e) {
      enqueue([this, client, id, what = failure_message(e)] {
        exporting_ = false;
        tell(error_message(what, id, "export"), client);
      });
    }
  });
  exporting_ = true;
}

}  // namespace kinetix::app::studio
