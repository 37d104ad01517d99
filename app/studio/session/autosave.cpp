#include "app/studio/session/autosave.hpp"

#include <fmt/format.h>
#include <cstdlib>

#include "app/files/bodies_section.hpp"
#include "app/io/bytes.hpp"
#include "app/result/state_json.hpp"
#include "app/result/summary.hpp"
#include "app/studio/messages/message.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_result = 64 << 20;  // bytes: a result of 10 000 bodies has about 20 MB
constexpr double rounding = 1e-9;  // relative, or mm and rad: files drop the last bit of offsets

Json read(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(file, none)) return nullptr;
  try {
    const std::string text = targets::read_text_file(file.string(), largest_result);
    if (targets::find_too_deep(text)) return nullptr;
    return Json::parse(text, nullptr, false);
  } catch (const InvalidInput&) {
    return nullptr;
  }
}

/// Returns whether it is a search result as the program writes it. The file was not requested and may be
/// anything.
bool is_of_search(const Json& result) {
  const auto is = [](const Json& part, const char* key, bool (Json::*kind)() const noexcept) {
    return part.contains(key) && (part[key].*kind)();
  };
  return result.is_object() && is(result, "target", &Json::is_object) &&
         is(result, "metrics", &Json::is_object) &&
         (!result.contains("name") || is(result, "name", &Json::is_string)) &&
         (!result.contains("stopped") || is(result, "stopped", &Json::is_boolean));
}

}  // namespace

std::optional<double> theta_reached(const Json& message) {
  if (!message.is_object()) return {};
  const Json& metrics = message["result"]["metrics"];
  const auto theta = metrics.find("theta_rad");
  if (theta == metrics.end() || !theta->is_number()) return {};
  return theta->get<double>();
}

Json earlier_result(const std::string& design_file, const Design& design) {
  const fs::path file = fs::path(design_file).parent_path() / "result.json";
  Json result = read(file);
  if (!is_of_search(result) || !matches_sheet(result, design, rounding)) return nullptr;
  const Json judged = result.value("verdict", Json(nullptr));  // null in results of earlier versions
  const Json met = judged.is_object() ? judged.value("met", Json(nullptr)) : Json(nullptr);
  const bool stopped = result.value("stopped", false);
  const std::string text = page_summary(short_form_of(result));
  return {{"type", "result"}, {"result", std::move(result)}, {"summary", text},
          {"met", met},       {"stopped", stopped},          {"earlier", true}};
}

namespace {

constexpr int max_places = 100;  // studios of one source at the same time
constexpr std::string_view kept_heading = "# Kept by the studio until it is saved: ";

std::string kept_text(const std::string& text, const std::string& save_file) {
  const Json about = {{"saves_to", save_file}};
  return fmt::format("{}{}\n{}", kept_heading, about.dump(-1, ' ', true, Json::error_handler_t::replace),
                     text);
}

/// Returns the file that `save` would write; empty if the text names none.
std::string save_file_of(const std::string& text) {
  if (!text.starts_with(kept_heading)) return "";
  const std::size_t begin = kept_heading.size(), end = text.find('\n');
  const Json about = Json::parse(text.substr(begin, end - begin), nullptr, false);
  return about.is_object() ? about.value("saves_to", std::string()) : "";
}

/// Returns a folder name for a source: readable, and unique by its hash.
std::string place_name(const std::string& source) {
  std::string stem =
      fs::path(source).parent_path().filename().string() + "-" + fs::path(source).stem().string();
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return stem.substr(0, 60) + "-" + sha256(source).substr(0, 16);
}

}  // namespace

fs::path autosave_place() {
  const char *state = std::getenv("XDG_STATE_HOME"), *home = std::getenv("HOME");
  if (state && fs::path(state).is_absolute()) return fs::path(state) / "kinetix" / "studio";
  if (home && fs::path(home).is_absolute()) return fs::path(home) / ".local" / "state" / "kinetix" / "studio";
  return {};
}

Autosave::Autosave(const fs::path& state, const std::string& source) {
  std::error_code failure;
  fs::create_directories(state, failure);
  if (!fs::is_directory(state, failure))
    throw InvalidInput("this folder cannot be made, so that designs are not kept", {state.string()});
  fs::permissions(state, fs::perms::owner_all, failure);
  const std::string name = place_name(source);
  for (int k = 1; k <= max_places; ++k) {
    folder_ = state / (k == 1 ? name : fmt::format("{}_{}", name, k));
    lock_ = LockFile::acquire(folder_.string() + ".lock");
    if (lock_) return;
  }
  throw InvalidInput("no place can be made in this folder, so that designs are not kept", {state.string()});
}

std::optional<AutosavedDesign> Autosave::kept() const {
  const std::string file = (folder_ / "design.yaml").string();
  std::error_code none;
  if (!fs::exists(file, none)) return {};
  try {
    AutosavedDesign kept{read_design(file), save_file_of(targets::read_text_file(file, max_design_bytes))};
    kept.result = earlier_result(file, kept.design);
    return kept;
  } catch (const InvalidInput&) {
    return {};
  }
}

void Autosave::keep(const Design& design, const std::string& save_file, const Json& result_message) {
  const std::lock_guard guard(mutex_);
  if (has_ended_) return;
  FileSet files(folder_.string());
  for (const NamedContent& one : design_files(design))
    files.add(one.name, one.name == "design.yaml" ? kept_text(one.content, save_file) : one.content);
  if (result_message.is_object()) files.add("result.json", result_message["result"].dump(1) + "\n");
  files.commit();
  std::error_code ignored;
  if (!result_message.is_object()) fs::remove(folder_ / "result.json", ignored);
}

void Autosave::forget() {
  const std::lock_guard guard(mutex_);
  std::error_code ignored;
  if (!has_ended_) fs::remove_all(folder_, ignored);
}

std::string Autosave::put_aside() {
  const std::lock_guard guard(mutex_);
  has_ended_ = true;
  std::error_code failure;
  if (!fs::exists(folder_ / "design.yaml", failure)) return "";
  const fs::path aside = folder_.string() + ".last";
  fs::remove_all(aside, failure);
  fs::rename(folder_, aside, failure);
  return ((failure ? folder_ : aside) / "design.yaml").string();
}

}  // namespace kinetix::app::studio
