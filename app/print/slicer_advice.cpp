#include "app/print/slicer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

namespace kinetix::app {
namespace {

bool has_slicer(const PrintJob& job, Slicer slicer) {
  const std::vector<Slicer> all = slicers_for(job);
  return std::find(all.begin(), all.end(), slicer) != all.end();
}

/// Joins names: "A", "A and B", "A, B and C".
std::string listed(const std::vector<std::string_view>& names) {
  if (names.size() < 2) return names.empty() ? "" : std::string(names.front());
  const auto last = names.end() - 1;
  return fmt::format("{} and {}", fmt::join(names.begin(), last, ", "), *last);
}

constexpr const char* set_by_hand = "set in the 3MF file, to be set by hand for STL";

/// Describes the settings that keep gaps open. Cura's have other names.
std::string describe_gaps(const PrintJob& job, const GapSettings& gaps) {
  if (job.slicer == Slicer::cura) {
    std::string values;
    for (const auto& [key, value] : object_settings(Slicer::cura, job))
      values += fmt::format("{} {}, ", key, value);
    return values.substr(0, values.size() - 2) + ": " + set_by_hand;
  }
  const std::string radius = fmt::format("slice gap closing radius {:g} mm", gaps.closing_radius_mm),
                    foot = fmt::format("elephant foot compensation {:g} mm", gaps.elephant_foot_mm);
  if (is_foot_of_printer(job.sheet))
    return fmt::format("{}: {}. Set {} in the printer's settings, since a 3MF file cannot", radius,
                       set_by_hand, foot);
  return fmt::format("{}, {}, XY size compensation {:g} mm: {}", radius, foot, gaps.expansion_mm,
                     set_by_hand);
}

/// Describes how to open the 3MF file so that the slicer keeps its settings.
std::string describe_opening(const PrintJob& job) {
  std::vector<std::string_view> projects;
  for (const Slicer slicer : {Slicer::orca, Slicer::bambu})
    if (has_slicer(job, slicer)) projects.push_back(program_name(slicer));
  std::string out = "the 3MF file has the settings of this sheet";
  if (!projects.empty())
    out += fmt::format("; in {} open it by File > Open Project, since Import drops them", listed(projects));
  if (has_slicer(job, Slicer::cura))
    out +=
        "; in Cura choose Skirt as build plate adhesion, since a brim joins parts and a file cannot set it";
  return out;
}

/// Describes what no setting does for gaps of pins where they meet the bed, and across layers.
std::string describe_first_layer(const PrintJob& job) {
  const model::Filament& filament = *job.sheet.process.filament;
  const std::string layers = fmt::format(
      "layers of {:g} mm or less, the first too: gaps between knuckles are "
      "at least two of them high",
      filament.layer_mm);
  const std::string knife = ". Separate parts that fuse on the bed with a knife";
  if (job.slicer == Slicer::cura) return layers + knife;
  return layers + knife +
         fmt::format(", as slicers do not narrow outlines below {:g} mm there", 2 * filament.line_mm);
}

}  // namespace

std::string slicer_names(const PrintJob& job) {
  std::vector<std::string_view> names;
  for (const Slicer slicer : slicers_for(job))
    if (can_slice(slicer, job.sheet)) names.push_back(program_name(slicer));
  return listed(names);
}

std::vector<std::pair<const char*, std::string>> slicer_advice(const PrintJob& job) {
  std::vector<std::pair<const char*, std::string>> out;
  if (const std::string names = slicer_names(job); !names.empty())
    out.emplace_back("made for", fmt::format("{}: {}", names, describe_opening(job)));
  if (const auto gaps = gap_settings(job.sheet)) out.emplace_back("gaps", describe_gaps(job, *gaps));
  if (job.sheet.process.filament && least_clearance_mm(job.sheet))
    out.emplace_back("first layer", describe_first_layer(job));
  return out;
}

std::optional<std::string> separation_warning(const PrintJob& job) {
  const PrintSheet& sheet = job.sheet;
  if (job.slicer || slicers_for(job).size() < 2 || !sheet.has_soft() || sheet.is_one_material())
    return std::nullopt;
  return "the 3MF file separates hard and soft parts for PrusaSlicer only: for another slicer export with "
         "--slicer orca, bambu or cura";
}

}  // namespace kinetix::app
