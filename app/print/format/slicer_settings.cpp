#include "app/print/format/slicer_settings.hpp"

#include <fmt/format.h>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {
namespace {

constexpr double usual_radius_mm =
    0.049;                             // mm: the default of PrusaSlicer, Orca and Bambu, which mends meshes
constexpr double share_of_gap = 0.4;   // of a clearance: a radius of a half would close it
constexpr double usual_foot_mm = 0.2;  // mm, of PrusaSlicer's own printers: about half a squashed line
constexpr double cura_foot_mm = 0.15;  // mm: Cura narrows thin walls too, and leaves 0.5 of 0.8 mm
constexpr double usual_deviation_mm = 0.025;  // mm, of Cura's outlines: its default
constexpr double share_of_deviation = 0.1;    // of a clearance, which two outlines border

std::string mm_text(double mm) { return fmt::format("{:.6g}", mm); }

bool is_extruded(const PrintSheet& sheet) { return sheet.process.filament.has_value(); }

SlicerSettings prusa_settings(const PrintSheet& sheet) {
  SlicerSettings out;
  if (const auto gaps = gap_settings(sheet)) {
    out.push_back({"slice_closing_radius", mm_text(gaps->closing_radius_mm)});
    if (!is_foot_of_printer(sheet)) {
      out.push_back({"elefant_foot_compensation", mm_text(gaps->elephant_foot_mm)});
      out.push_back({"xy_size_compensation", mm_text(gaps->expansion_mm)});
    }
  }
  if (is_extruded(sheet)) {
    out.push_back({"perimeter_generator", "arachne"});
    out.push_back({"brim_width", "0"});
  }
  return out;
}

/// Returns the settings for Orca and Bambu, which have one origin.
SlicerSettings orca_settings(Slicer slicer, const PrintSheet& sheet, bool shared) {
  SlicerSettings out;
  if (const auto gaps = gap_settings(sheet)) {
    out.push_back({"slice_closing_radius", mm_text(gaps->closing_radius_mm)});
    out.push_back({"elefant_foot_compensation", mm_text(gaps->elephant_foot_mm)});
    out.push_back({"xy_hole_compensation", mm_text(gaps->expansion_mm)});
    out.push_back({"xy_contour_compensation", mm_text(gaps->expansion_mm)});
    if (!shared && slicer == Slicer::orca) {
      out.push_back({"elefant_foot_compensation_layers", "1"});
      out.push_back({"hole_to_polyhole", "0"});
    }
    if (!shared && slicer == Slicer::bambu) {
      out.push_back({"enable_circle_compensation", "0"});
      out.push_back({"circle_compensation_manual_offset", "0"});
    }
  }
  if (is_extruded(sheet)) {
    out.push_back({"wall_generator", "arachne"});
    out.push_back({"brim_type", "no_brim"});
  }
  return out;
}

/// Returns the settings for Cura. Soft parts touch hard ones, which a narrower first layer would part.
SlicerSettings cura_settings(const PrintSheet& sheet) {
  SlicerSettings out;
  if (const auto gaps = gap_settings(sheet)) {
    const double clearance = *least_clearance_mm(sheet);
    const bool narrows = gaps->elephant_foot_mm > 0 && !sheet.has_soft();
    out.push_back({"xy_offset", mm_text(gaps->expansion_mm)});
    out.push_back({"xy_offset_layer_0", narrows ? mm_text(-cura_foot_mm) : "0"});
    out.push_back({"hole_xy_offset", "0"});
    out.push_back(
        {"meshfix_maximum_deviation", mm_text(std::min(usual_deviation_mm, share_of_deviation * clearance))});
  }
  if (is_extruded(sheet)) out.push_back({"fill_outline_gaps", "True"});
  return out;
}

SlicerSetting without_supports(Slicer slicer) {
  if (slicer == Slicer::prusa) return {"support_material", "0"};
  if (slicer == Slicer::cura) return {"support_enable", "False"};
  return {"enable_support", "0"};
}

}  // namespace

std::string_view option_name(Slicer slicer) {
  constexpr std::string_view names[] = {"prusa", "orca", "bambu", "cura"};
  return names[static_cast<int>(slicer)];
}

std::string_view program_name(Slicer slicer) {
  constexpr std::string_view names[] = {"PrusaSlicer", "OrcaSlicer", "Bambu Studio", "Cura"};
  return names[static_cast<int>(slicer)];
}

std::vector<Slicer> slicers_for(const PrintJob& job) {
  if (job.slicer) return {*job.slicer};
  if (!is_extruded(job.sheet)) return {Slicer::prusa};
  return {std::begin(all_slicers), std::end(all_slicers)};
}

bool can_slice(Slicer slicer, const PrintSheet& sheet) {
  return is_extruded(sheet) || (slicer == Slicer::prusa && sheet.process.name == "sla");
}

bool has_separate_materials(const PrintJob& job) {
  return job.slicer && *job.slicer != Slicer::prusa && job.sheet.has_soft() && !job.sheet.is_one_material();
}

bool is_foot_of_printer(const PrintSheet& sheet) {
  return sheet.process.spreads_on_bed && !is_extruded(sheet);
}

std::optional<double> least_clearance_mm(const PrintSheet& sheet) {
  std::optional<double> least;
  for (const model::HingePrint& hinge : sheet.hinges)
    if (is_pin(hinge.made.kind))
      least = std::min(least.value_or(hinge.made.clearance_mm), hinge.made.clearance_mm);
  return least;
}

std::optional<GapSettings> gap_settings(const PrintSheet& sheet) {
  const std::optional<double> least = least_clearance_mm(sheet);
  if (!least) return std::nullopt;
  return GapSettings{std::min(usual_radius_mm, share_of_gap * *least),
                     sheet.process.spreads_on_bed ? usual_foot_mm : 0, 0};
}

SlicerSettings object_settings(Slicer slicer, const PrintJob& job, bool shared) {
  SlicerSettings out = slicer == Slicer::prusa  ? prusa_settings(job.sheet)
                       : slicer == Slicer::cura ? cura_settings(job.sheet)
                                                : orca_settings(slicer, job.sheet, shared);
  if (is_extruded(job.sheet) && !plan_supports(job).is_needed) out.push_back(without_supports(slicer));
  return out;
}

}  // namespace kinetix::app
