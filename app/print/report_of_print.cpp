#include "app/print/report_of_print.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/io/atomic_file.hpp"
#include "app/report/report.hpp"
#include "app/result/same_sheet.hpp"
#include "targets/document/json_depth.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_report = 64 << 20;  // bytes: that of 10 000 bodies has 9 MB
constexpr double digits_of_reports = 1e-5;        // relative, or mm and rad: reports have six digits

}  // namespace

std::string tell_report(const std::string& design_file, const Design& design, const Json& print) {
  const fs::path folder = fs::path(design_file).parent_path(), file = folder / "report.html";
  std::error_code none;
  if (!fs::exists(file, none)) return {};
  const std::string page = targets::read_text_file(file.string(), largest_report);
  const std::string text = data_of_report(page);
  if (targets::find_too_deep(text)) return {};
  Json data = Json::parse(text, nullptr, false);
  if (!is_of_sheet(data, design, digits_of_reports)) return {};
  data["print"] = print;
  FileSet files(folder.string());
  files.add("report.html", report_with(page, data.dump()));
  files.commit();
  return file.string();
}

}  // namespace kinetix::app
