#include "app/print/hinge_sorts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace kinetix::app {
namespace {

constexpr double one_size_mm = 1e-6;  // mm: sizes that differ by less are reported as one

using Size = std::function<double(const model::HingePrint&)>;

/// Formats the range of a size: "2", "2 to 2.5".
std::string sizes(const HingeSort& sort, const Size& size) {
  const auto less = [&](const auto* a, const auto* b) { return size(*a) < size(*b); };
  const auto [least, most] = std::minmax_element(sort.hinges.begin(), sort.hinges.end(), less);
  const double low = size(**least), high = size(**most);
  return high - low < one_size_mm ? fmt::format("{:.3g}", high) : fmt::format("{:.3g} to {:.3g}", low, high);
}

double knuckle_across_mm(const model::HingePrint& h) {
  return h.made.diameter_mm + 2 * (h.made.clearance_mm + h.knuckle_wall_mm + h.cap_across_mm);
}

std::string material_words(const HingeSort& sort) {
  return sort.material.empty() ? "your material" : sort.material;
}

std::string plural(model::HingeKind kind) { return fmt::format("{}s", to_string(kind)); }

}  // namespace

std::vector<HingeSort> hinge_sorts(const PrintSheet& sheet) {
  std::vector<HingeSort> out;
  for (const model::HingePrint& hinge : sheet.hinges) {
    const auto kind = hinge.made.kind;
    const std::string material = kind == model::HingeKind::pin ? "" : hinge.made.material.name;
    const auto same = [&](const HingeSort& sort) { return sort.kind == kind && sort.material == material; };
    auto at = std::find_if(out.begin(), out.end(), same);
    if (at == out.end()) at = out.insert(at, {kind, material, {}});
    at->hinges.push_back(&hinge);
  }
  return out;
}

std::string hinge_words(const HingeSort& sort, const PrintSheet& sheet) {
  const auto all = [&](const Size& size) { return sizes(sort, size); };
  if (sort.kind == model::HingeKind::pin)
    return fmt::format("pins: rod {} x {} mm, clearance {} mm a side, {} mm along the axis, {} {} mm",
                       all([](const auto& h) { return h.made.diameter_mm; }),
                       all([](const auto& h) { return h.made.height_mm; }),
                       all([](const auto& h) { return h.made.clearance_mm; }),
                       all([](const auto& h) { return h.axial_clearance_mm; }),
                       sheet.has_caps() ? "bores in round caps of" : "knuckle", all(knuckle_across_mm));
  return fmt::format("{} of {}: gap {} mm, thickness {} mm, height {} mm", plural(sort.kind),
                     material_words(sort), all([](const auto& h) { return h.made.gap_mm; }),
                     all([](const auto& h) { return h.made.thickness_mm; }),
                     all([](const auto& h) { return h.made.height_mm; }));
}

std::vector<std::string> material_warnings(const PrintSheet& sheet) {
  std::vector<std::string> out, soft;
  for (const HingeSort& sort : hinge_sorts(sheet)) {
    if (sort.kind == model::HingeKind::pin) continue;
    soft.push_back(fmt::format("{} of {}", plural(sort.kind), material_words(sort)));
    const std::string& printed = sheet.is_one_material() ? sheet.process.film : sheet.process.rubber;
    const bool chosen = sheet.is_one_material() || sheet.process.joins_two;
    if (chosen && sort.material != printed)
      out.push_back(fmt::format(
          "{} prints {} of {}: {} of {} are as stiff as the design says only if they are printed of that",
          sheet.process.name, sheet.is_one_material() ? "walls and films in one," : "soft parts", printed,
          plural(sort.kind), material_words(sort)));
  }
  if (soft.size() > 1 && !sheet.is_one_material())
    out.push_back(
        fmt::format("{} are one soft part in the files, printed of one material: stiffnesses of the design "
                    "are those of each its own",
                    fmt::join(soft, " and ")));
  return out;
}

std::optional<std::string> thin_film_warning(const PrintSheet& sheet) {
  const auto& filament = sheet.process.filament;
  if (!filament || !sheet.is_one_material()) return std::nullopt;
  double thinnest = filament->line_mm;
  for (const model::HingePrint& hinge : sheet.hinges)
    if (hinge.made.kind == model::HingeKind::film) thinnest = std::min(thinnest, hinge.made.thickness_mm);
  if (!(thinnest < filament->line_mm)) return std::nullopt;
  return fmt::format(
      "films of {:.3g} mm are thinner than the line of {:g} mm that {} lays: slicers leave them out or "
      "print them thicker, and stiffer than the design says",
      thinnest, filament->line_mm, sheet.process.name);
}

}  // namespace kinetix::app
