#include "app/studio/session/earlier_result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "app/result/state_json.hpp"
#include "app/studio/messages/message.hpp"
#include "model/base/angle.hpp"
#include "targets/document/json_depth.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_result = 64 << 20;  // bytes: a result of 10 000 bodies has about 20 MB
constexpr double rounding = 1e-9;  // relative, or mm and rad: files drop the last bit of offsets

/// A number of `metrics`, formatted in a line as by summary().
struct Measure {
  const char* key;
  const char* label;
  const char* before;
  double unit;  // of the text over that of the file
  int digits;   // number of significant digits
  const char* after;
};

constexpr double percent = 100,
                 degree = 1 / radians_per_degree;  // units for a ratio and for a radian, as people read them

/// Numbers to show, for all kinds of goals. Others interest only experts.
constexpr Measure reported_measures[] = {
    {"theta_rad", "folded", "theta ", degree, 4, " deg"},
    {"shape_rms", "shape", "rms ", percent, 3, " % of the goal's diagonal"},
    {"shape_max", "", "largest ", percent, 3, " % of it"},
    {"surface_rms", "shape", "rms ", percent, 3, " % of the goal's diagonal"},
    {"cover", "", "covers ", percent, 3, " % of it"},
    {"outline_rms", "shape", "rms ", percent, 3, " % of the goal's diagonal"},
    {"iou", "", "shares ", percent, 3, " % of the area of both"},
    {"factor_off", "block", "factors off by up to ", percent, 3, " %"},
    {"fold_miss_deg", "creases", "off by up to ", 1, 3, " deg"},
    {"face_rms", "faces", "rms ", percent, 3, " % of an edge from the ideal solid"},
    {"distance_rms_mm", "fit", "rms ", 1, 3, " mm from head plus clearance"},
    {"distance_max_mm", "", "largest ", 1, 3, " mm"},
    {"contrast", "picture", "contrast ", 1, 2, ""},
    {"auc", "", "auc ", 1, 3, ""},
    {"strain_max", "strained", "by ", 1, 3, ""},
    {"strain_allowed", "", "its material bears ", 1, 3, ""},
    {"as_made_rms_mm", "as made", "", 1, 3, " mm off the goal (rms)"},
    {"as_made_p95_mm", "", "95 of 100 prints within ", 1, 3, " mm"},
    {"force_N", "effort", "at most ", 1, 3, " N"},
    {"verify_rms", "physics", "rms ", 1, 2, " cell edges from the model"},
};

std::string format_result_line(const std::string& label, const std::string& text) {
  return fmt::format("\n  {:<10} {}", label, text);
}

std::string format_result_number(double value, int digits) {
  constexpr double seen = 1e-3;  // of all units above: smaller values do not matter to people
  return std::abs(value) < seen ? "below 0.001" : plain_number(value, digits);
}

/// Describes the result, as after the search.
std::string words(const Json& result, const std::string& file) {
  const Json& metrics = result["metrics"];
  std::string out = result.value("name", std::string("A result")) + ", from " + file;
  for (const auto& [key, label, before, unit, digits, after] : reported_measures)
    if (const auto value = metrics.find(key); value != metrics.end() && value->is_number())
      out += format_result_line(label,
                                before + format_result_number(unit * value->get<double>(), digits) + after);
  const Json judged = result.value("verdict", Json(nullptr));
  if (!judged.is_object() || !judged.contains("problems") || !judged["problems"].is_array()) return out;
  for (const Json& problem : judged["problems"])
    if (problem.contains("level") && problem.contains("text") && problem["level"].is_string() &&
        problem["text"].is_string())
      out += format_result_line(problem["level"].get<std::string>(), problem["text"].get<std::string>());
  return out;
}

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
  if (!is_of_search(result) || !is_of_sheet(result, design, rounding)) return nullptr;
  const Json judged = result.value("verdict", Json(nullptr));  // null in results of earlier versions
  const Json met = judged.is_object() ? judged.value("met", Json(nullptr)) : Json(nullptr);
  const bool stopped = result.value("stopped", false);
  const std::string text = words(result, file.string());
  return {{"type", "result"}, {"result", std::move(result)}, {"summary", text},
          {"met", met},       {"stopped", stopped},          {"earlier", true}};
}

}  // namespace kinetix::app::studio
