#include "app/studio/earlier_result.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "app/result/same_sheet.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_result = 64 << 20;  // bytes: a result of some 10 000 bodies has 20 MB
constexpr double rounding = 1e-9;  // relative, or mm and rad: offsets lose their last bit in files

/// Of errors from the goal that the result knows, in words.
std::string words(const Json& result, const std::string& file) {
  std::string out = "From " + file;
  for (const auto& [key, value] : result["metrics"].items())
    if (value.is_number()) out += fmt::format("\n{}: {:.4g}", key, value.get<double>());
  return out;
}

Json read(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(file, none)) return nullptr;
  try {
    return Json::parse(targets::read_text_file(file.string(), largest_result), nullptr, false);
  } catch (const InvalidInput&) {
    return nullptr;
  }
}

}  // namespace

Json earlier_result(const std::string& design_file, const DesignFile& design) {
  const fs::path file = fs::path(design_file).parent_path() / "result.json";
  Json result = read(file);
  if (!result.is_object() || !result.contains("target") || !result["target"].is_object()) return nullptr;
  if (!result.contains("metrics") || !result["metrics"].is_object()) return nullptr;
  if (!is_of_sheet(result, design, rounding)) return nullptr;
  const Json met = result["metrics"].value("met", Json(nullptr));
  const bool stopped = result.value("stopped", false);
  const std::string text = words(result, file.string());
  return {{"type", "result"}, {"result", std::move(result)}, {"summary", text},
          {"met", met},       {"stopped", stopped},          {"earlier", true}};
}

}  // namespace kinetix::app::studio
