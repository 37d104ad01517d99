#include "app/print/print_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

#include "app/print/format/cut_drawing.hpp"

namespace kinetix::app {
namespace {

using CutJson = nlohmann::ordered_json;

/// Returns the material of the sheet: that of its hinges, which are one with the walls.
std::string sheet_material(const PrintSheet& sheet) {
  std::set<std::string> names;
  for (const model::HingePrint& hinge : sheet.hinges)
    names.insert(hinge.made.material.name.empty() ? "your material" : hinge.made.material.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

/// Largest strain of a bridge at the fold, over what its material bears.
struct BridgeStrain {
  double strain = 0, borne = 1;
};

/// Returns the strain of the bridge that is strained most of what it bears; empty if the fold is not known.
std::optional<BridgeStrain> bridge_strain(const PrintSheet& sheet) {
  if (sheet.path.size() < 2) return std::nullopt;
  BridgeStrain worst;
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) {
    const model::ManufacturedHinge& made = sheet.hinges[h].made;
    const BridgeStrain one{hinge_strain(made, sheet.linkage, sheet.path.back(), h), made.material.strain_max};
    if (one.strain / one.borne >= worst.strain / worst.borne) worst = one;
  }
  return worst;
}

/// Returns the least and the largest size of the bridges; null for a sheet that has creases alone.
CutJson range_json(const PrintSheet& sheet, double model::ManufacturedHinge::*size) {
  std::vector<double> sizes;
  for (const model::HingePrint& hinge : sheet.hinges)
    if (hinge.made.kind == model::HingeKind::film) sizes.push_back(hinge.made.*size);
  if (sizes.empty()) return nullptr;
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
  return {*least, *most};
}

}  // namespace

CutJson cut_json(const PrintSheet& sheet) {
  if (!sheet.process.cuts_sheets()) return nullptr;
  const CutDrawing cut = cut_drawing(sheet);
  const std::optional<BridgeStrain> strain = bridge_strain(sheet);
  const Eigen::Vector2d size = cut.high - cut.low;
  return {{"sheet_mm", sheet.process.sheet_mm},
          {"material", sheet_material(sheet)},
          {"kerf_mm", sheet.process.kerf_mm},
          {"size_mm", {size.x(), size.y()}},
          {"pieces", cut.pieces},
          {"length_mm", cut.length_mm()},
          {"bridges",
           {{"width_mm", range_json(sheet, &model::ManufacturedHinge::thickness_mm)},
            {"length_mm", range_json(sheet, &model::ManufacturedHinge::gap_mm)},
            {"strain", strain ? CutJson(strain->strain) : CutJson(nullptr)},
            {"strain_max", strain ? CutJson(strain->borne) : CutJson(nullptr)}}}};
}

/// Describes sheet, cuts and bridges for print.txt.
CutLines describe_cut(const PrintSheet& sheet) {
  const CutDrawing cut = cut_drawing(sheet);
  const Eigen::Vector2d size = cut.high - cut.low;
  CutLines out{
      {"sheet", fmt::format("{:g} mm thick, of {}; {:.1f} x {:.1f} mm of it", sheet.process.sheet_mm,
                            sheet_material(sheet), size.x(), size.y())},
      {"cut",
       fmt::format("{:.0f} mm in {}{} closed lines, {} {}, for a kerf of {:g} mm", cut.length_mm(),
                   cut.slits.empty() ? "" : fmt::format("{} open and ", cut.slits.size()), cut.cuts.size(),
                   cut.pieces, cut.pieces == 1 ? "piece" : "pieces", sheet.process.kerf_mm)}};
  if (const auto strain = bridge_strain(sheet))
    out.emplace_back(
        "bridges",
        fmt::format("strained by {:.3g} at the fold, {}; limit of their material {:g}", strain->strain,
                    sheet.is_path_exact ? "by turning alone" : "by turning and stretch", strain->borne));
  return out;
}

}  // namespace kinetix::app
