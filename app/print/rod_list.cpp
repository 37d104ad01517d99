#include "app/print/print_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {
namespace {

/// Rods of one size and material that are separate parts.
struct RodSort {
  double diameter_mm = 0, length_mm = 0;
  std::string material;  ///< its name; empty if the user gave numbers
  bool is_printable = false;
  int count = 0;
};

/// Groups a sheet's rods, in the order in which they first occur.
std::vector<RodSort> rod_sorts(const PrintSheet& sheet) {
  std::vector<RodSort> out;
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) {
    if (sheet.rods[h].points.empty()) continue;
    const model::ManufacturedHinge& made = sheet.hinges[h].made;
    const auto is_same = [&](const RodSort& sort) {
      return sort.diameter_mm == made.diameter_mm && sort.length_mm == made.height_mm &&
             sort.material == made.material.name;
    };
    auto at = std::find_if(out.begin(), out.end(), is_same);
    if (at == out.end())
      at = out.insert(at,
                      {made.diameter_mm, made.height_mm, made.material.name, is_printable_rod(sheet, h), 0});
    ++at->count;
  }
  return out;
}

std::string describe_rod_sort(const RodSort& sort) {
  return fmt::format("{} rods of {:.4g} mm, each {:.4g} mm long, {:.0f} mm of {} in all", sort.count,
                     sort.diameter_mm, sort.length_mm, sort.count * sort.length_mm,
                     sort.material.empty() ? "your material" : sort.material);
}

/// Describes where the rods come from. Rods of pins are printed, those of the kind rod are wire.
std::string describe_rod_source(const PrintSheet& sheet, const std::vector<RodSort>& sorts) {
  const auto is_printable = [](const RodSort& sort) { return sort.is_printable; };
  if (std::none_of(sorts.begin(), sorts.end(), is_printable)) return "Cut them from wire";
  if (!std::all_of(sorts.begin(), sorts.end(), is_printable))
    return fmt::format("Cut them from wire. The file of rods contains those that {} prints",
                       sheet.process.name);
  const bool is_wire =
      std::any_of(sheet.hinges.begin(), sheet.hinges.end(),
                  [](const model::HingePrint& hinge) { return hinge.made.kind == model::HingeKind::rod; });
  return is_wire ? "Cut them from wire, or print the file of rods" : "Print the file of rods";
}

}  // namespace

std::string describe_rods(const PrintSheet& sheet) {
  const std::vector<RodSort> sorts = rod_sorts(sheet);
  std::vector<std::string> texts;
  for (const RodSort& sort : sorts) texts.push_back(describe_rod_sort(sort));
  return fmt::format("{}. {}. Push them in after printing (press-fit)", fmt::join(texts, ", and "),
                     describe_rod_source(sheet, sorts));
}

nlohmann::ordered_json rods_json(const PrintSheet& sheet) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const RodSort& sort : rod_sorts(sheet))
    out.push_back({{"count", sort.count},
                   {"diameter_mm", sort.diameter_mm},
                   {"length_mm", sort.length_mm},
                   {"material", sort.material},
                   {"printable", sort.is_printable}});
  return out;
}

}  // namespace kinetix::app
