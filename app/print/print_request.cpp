#include "app/print/export_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/print/fit.hpp"
#include "app/print/slicer.hpp"
#include "app/run/design_hinges.hpp"
#include "model/base/algorithms.hpp"
#include "model/solids/hinge_shape.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

/// Returns the value of that name. @param allowed pairs of name and value
template <class Value>
Value named(const char* option, const std::string& name,
            const std::vector<std::pair<std::string_view, Value>>& allowed) {
  std::vector<std::string_view> names;
  for (const auto& [known, value] : allowed) {
    if (known == name) return value;
    names.push_back(known);
  }
  throw InvalidInput(fmt::format("{}: unknown {} {}{}; allowed: {}", option, option + 2,
                                 targets::in_ticks(name), targets::did_you_mean(name, names),
                                 targets::joined(names)));
}

/// Returns the least clearance of the pins that the design itself describes, mm; empty without such pins. The bore of a
/// rod may be narrower than the least gap that prints.
std::optional<double> clearance_override_mm(const Design& design) {
  std::optional<double> least;
  for (const HingeSection* hinge : hinge_sections(design))
    if (hinge->made && hinge->made->kind == model::HingeKind::pin)
      least = std::min(least.value_or(hinge->made->clearance_mm), hinge->made->clearance_mm);
  return least;
}

}  // namespace

std::string format_help() {
  std::string text;
  for (const PrintFormat* format : print_formats())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", format->name, format->meaning);
  return text + "; all: every format. Separate several by commas";
}

model::Process process_of(const PrintRequest& request, const model::Process& of_design) {
  model::Process out = of_design;
  if (!request.process.empty() && of_design.name != request.process) {
    std::vector<std::pair<std::string_view, const model::Process*>> all;
    for (const model::Process& process : model::processes()) all.emplace_back(process.name, &process);
    out = *named("--process", request.process, all);
    if (of_design.is_bed_given) out.bed_mm = of_design.bed_mm;
    out.is_bed_given = of_design.is_bed_given;
  }
  if (request.bed_mm.size() == 2) {
    out.bed_mm = {request.bed_mm[0], request.bed_mm[1]};
    out.is_bed_given = true;
  }
  return out;
}

std::optional<model::HingeKind> kind_of(const PrintRequest& request) {
  if (request.hinge.empty()) return std::nullopt;
  return named<model::HingeKind>("--hinge", request.hinge,
                                 {{"pin", model::HingeKind::pin},
                                  {"block", model::HingeKind::block},
                                  {"film", model::HingeKind::film},
                                  {"rod", model::HingeKind::rod}});
}

std::optional<LockKind> lock_of(const PrintRequest& request) {
  if (request.lock.empty()) return std::nullopt;
  return named<LockKind>("--lock", request.lock,
                         {{"clip", LockKind::clip}, {"strap", LockKind::strap}, {"none", LockKind::none}});
}

std::optional<Slicer> slicer_of(const PrintRequest& request) {
  if (request.slicer.empty()) return std::nullopt;
  std::vector<std::pair<std::string_view, Slicer>> all;
  for (const Slicer slicer : all_slicers) all.emplace_back(option_name(slicer), slicer);
  return named<Slicer>("--slicer", request.slicer, all);
}

std::vector<const PrintFormat*> formats_of(const PrintRequest& request) {
  std::vector<const PrintFormat*> out;
  for (const std::string& name : request.formats) {
    if (name == "all") return print_formats();
    out.push_back(&print_format(name));
  }
  return out;
}

void check_clearance_override(const PrintRequest& request, const Design& design) {
  const std::optional<double> own = clearance_override_mm(design);
  if (own && *own < request.clearance_mm)
    throw InvalidInput(
        fmt::format("--clearance {1:g} is not the clearance of the design's pins, {0:g} mm. Change "
                    "`clearance_mm` in the design",
                    *own, request.clearance_mm));
}

bool changes_sheet(const PrintRequest& request, const Design& design) {
  const bool names_process = !request.process.empty() && request.process != design.process.name;
  return names_process || !request.hinge.empty() || request.clearance_mm > 0 || request.caps ||
         request.loose_rods || request.cell_mm > 0;
}

namespace {

/// Checks whether all hinges are the pins that the process of the design has if nothing else is asked for. Searches leave
/// them in panels, whose hinges are elastic.
bool has_usual_pins(const Design& design) {
  return has_pins_alone(design) && design.hinge_overrides.empty() &&
         design.hinge.made == open_hinge(model::HingeKind::pin, design.process, design.structure.size());
}

}  // namespace

Design reopened(Design design, const PrintRequest& request) {
  if (changes_sheet(request, design) && has_usual_pins(design)) design.hinge.made.reset();
  return changes_sheet(request, design) ? with_open_joints(std::move(design)) : design;
}

void reject_design_options(const PrintRequest& request) {
  const auto refuse = [](bool given, const char* option, const char* why) {
    if (given) throw InvalidInput(fmt::format("{} only applies to designs: {}. Remove it", option, why));
  };
  refuse(request.clearance_mm > 0, "--clearance", "a coupon has several gaps");
  refuse(request.caps, "--round-caps", "the axes of a coupon are in the middle");
  refuse(!request.hinge.empty(), "--hinge", "the hinges of a coupon are pins");
  refuse(request.cell_mm > 0, "--cell-mm", "a coupon has no cells");
  refuse(!request.lock.empty(), "--lock", "a coupon does not fold");
  refuse(request.loose_rods, "--loose-rods", "the rods of a coupon are printed in place");
  refuse(request.folded, "--state folded", "a coupon does not fold");
}

void reject_sheet_options(const PrintRequest& request, bool is_cut) {
  constexpr const char* instead = "and this is a design of bodies. ";
  const auto refuse = [&](bool given, const char* option) {
    if (given) throw InvalidInput(fmt::format("{} only applies to sheets, {}Remove it", option, instead));
  };
  refuse(!request.hinge.empty(), "--hinge");
  refuse(request.clearance_mm > 0, "--clearance");
  refuse(request.cell_mm > 0, "--cell-mm");
  refuse(!request.bed_mm.empty(), "--bed");
  refuse(!request.lock.empty(), "--lock");
  refuse(request.loose_rods, "--loose-rods");
  refuse(request.caps, "--round-caps");
  refuse(request.orient != "flat", "--orient");
  refuse(request.slice, "--slice");
  std::vector<std::string_view> allowed = {"stl", "3mf", "glb"};
  if (is_cut)
    for (const char* drawing : {"svg", "dxf"}) allowed.emplace_back(drawing);
  for (const std::string& name : request.formats)
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      throw InvalidInput(fmt::format("--format: {} only applies to sheets, {}Give {}",
                                     targets::in_ticks(name), instead, targets::joined(allowed)));
}

void check_state(const PrintRequest& request, const PrintSheet& sheet) {
  if (request.folded && !sheet.is_path_exact && !sheet.no_path_reason.empty())
    throw InvalidInput("--state folded: the folded state of the design is not known. Export it flat: " +
                       sheet.no_path_reason);
}

void lay_as_requested(const PrintRequest& request, PrintJob& job) {
  if (request.orient == "flat") return;
  const std::vector<PrintOrientation> all = lies(job);
  std::vector<std::pair<std::string_view, const PrintOrientation*>> allowed{{"best", &best(all)}};
  for (const PrintOrientation& lie : all) allowed.emplace_back(lie.name, &lie);
  lay(job, *named("--orient", request.orient, allowed));
}

namespace {

constexpr double strain_report_threshold =
    1e-6;  // of the strain that a material bears: a smaller excess is rounding

/// Lists requested options that change nothing, a sentence each.
std::vector<std::string> idle_options(const PrintRequest& request, const Design& design,
                                      const PrintSheet& sheet) {
  std::vector<std::string> all;
  const auto has = [&](model::HingeKind kind) {
    return std::any_of(sheet.hinges.begin(), sheet.hinges.end(),
                       [&](const model::HingePrint& hinge) { return hinge.made.kind == kind; });
  };
  const bool has_pins = has(model::HingeKind::pin), has_rods = has(model::HingeKind::rod);
  if (const auto kind = kind_of(request); kind && !has(*kind))
    all.push_back("--hinge has no effect: the design sets the kind of its hinges");
  if (request.clearance_mm > 0 && !has_pins && !has_rods)
    all.push_back("--clearance has no effect: no hinge is a pin");
  if (const auto own = clearance_override_mm(design); own && request.clearance_mm > 0)
    all.push_back(fmt::format(
        "--clearance {:g} leaves the design's own pins as they are: their clearance is {:g} mm or more",
        request.clearance_mm, *own));
  if (request.loose_rods && !has_pins) all.push_back("--loose-rods has no effect: no hinge is a pin");
  if (request.caps && !sheet.has_caps())
    all.push_back("--round-caps has no effect: all axes are in the middle of their walls");
  return all;
}

/// Describes walls that are as high as the sheet that they are cut from, if the design has others.
std::optional<std::string> sheet_note(const Design& design, const PrintSheet& sheet) {
  const double height_mm = design.structure.size().height_mm;
  if (!sheet.process.cuts_sheets() || sheet.process.sheet_mm == height_mm) return std::nullopt;
  return fmt::format(
      "walls are {:g} mm high, the thickness of the sheet, instead of {:g}. This changes the stiffness of "
      "bridges. For another sheet give the design `process: {{base: {}, sheet_mm: ...}}` and walls of that "
      "height",
      sheet.process.sheet_mm, height_mm, sheet.process.name);
}

/// Describes how cells of another edge change the size that the design was made for. Empty if they do not.
std::optional<std::string> size_note(const Design& design, const PrintSheet& sheet) {
  const double edge_mm = sheet.linkage.size.edge_mm;
  const double design_edge_mm = design.structure.size().edge_mm;
  const auto resized = describe_resizing(design_edge_mm, edge_mm);
  if (!resized) return std::nullopt;
  return fmt::format(
      "made with cells of {:.3g} mm instead of {:.3g}: {}. For the size of the goal search again with {} "
      "cells{}",
      edge_mm, design_edge_mm, *resized, edge_mm > design_edge_mm ? "fewer" : "more",
      sheet.is_path_exact ? "" : ". Its fold is the scaled equilibrium of the original size");
}

/// Describes the hinge that is strained farthest beyond what its material bears along the path to the fold.
std::optional<std::string> strain_note(const PrintSheet& sheet) {
  std::optional<model::StrainedHinge> worst;
  for (const model::State& state : sheet.path) {
    const auto one = most_strained(sheet.linkage, state, [&](int h) { return &sheet.hinges[h].made; });
    if (one && one->share() > (worst ? worst->share() : 1 + strain_report_threshold)) worst = one;
  }
  if (!worst) return std::nullopt;
  return describe_strain(*worst, sheet.linkage.wall_name(worst->hinge), " during the motion to the fold");
}

/// Describes how the elastic hinges' equilibrium, which result.json reports, differs from the fold of the closed form.
std::optional<std::string> elastic_note(const PrintRequest& request, const Design& design,
                                        const PrintSheet& sheet) {
  if (!request.folded || sheet.path.size() < 2) return std::nullopt;
  return equilibrium_beside_exact(design, sheet.linkage.size.edge_mm);
}

using Formats = std::vector<const PrintFormat*>;

/// Joins the names of the formats for which `is` holds: "svg and dxf"; empty: none.
template <class Is>
std::string names_of(const Formats& formats, Is is) {
  std::vector<std::string_view> names;
  for (const PrintFormat* format : formats)
    if (is(*format)) names.push_back(format->name);
  return fmt::format("{}", fmt::join(names, " and "));
}

/// Describes the requested formats that show the sheet flat in any case, if its folded state is requested.
std::optional<std::string> always_flat_note(const PrintRequest& request, const Formats& formats) {
  const std::string flat = names_of(formats, [](const PrintFormat& format) { return format.is_always_flat; });
  if (!request.folded || flat.empty()) return std::nullopt;
  return fmt::format(
      "--state folded has no effect in {}, where the sheet is always flat. Sizes here are of the fold", flat);
}

/// Describes that tiles are printed flat, if the folded state is requested.
std::optional<std::string> flat_tiles_note(const PrintRequest& request, const PrintSheet& sheet) {
  if (!request.folded || sheet.tiles.count() < 2) return std::nullopt;
  return "--state folded has no effect on tiles, which are printed flat, with the designed side up. Sizes "
         "here are of the fold";
}

/// Describes the formats that ignore the orientation on the bed. @param lie the chosen orientation
std::optional<std::string> unlaid_note(const PrintRequest& request, const Formats& formats,
                                       std::string_view lie) {
  const std::string others = names_of(formats, [](const PrintFormat& format) { return !format.lies_on_bed; });
  if (lie == "flat" || others.empty()) return std::nullopt;
  return fmt::format("--orient {} changes nothing in {}, where the sheet is in its own place", request.orient,
                     others);
}

/// Describes a requested slicer that no format is for, or that does not slice for the process.
std::optional<std::string> slicer_note(const PrintJob& job, const Formats& formats) {
  if (!job.slicer) return std::nullopt;
  if (std::find(formats.begin(), formats.end(), &threemf_format) == formats.end())
    return fmt::format("--slicer changes nothing in {}: only 3mf has settings of a slicer",
                       names_of(formats, [](const PrintFormat&) { return true; }));
  if (can_slice(*job.slicer, job.sheet)) return std::nullopt;
  return fmt::format("{} does not slice for {}: its files are for --process fdm", program_name(*job.slicer),
                     job.sheet.process.name);
}

/// Describes the formats in which hinges only turn, for a sheet whose hinges stretch along its path.
std::optional<std::string> unstretched_note(const PrintSheet& sheet, const Formats& formats) {
  const std::string rigid = names_of(formats, [](const PrintFormat& format) { return format.turns_alone; });
  if (sheet.is_path_exact || sheet.path.size() < 2 || rigid.empty()) return std::nullopt;
  return fmt::format(
      "hinges of {} turn and do not stretch, and those of the design stretch during the motion. The drive "
      "may not reach the fold",
      rigid);
}

/// Lists the notes that are not empty.
std::vector<std::string> given_notes(const std::vector<std::optional<std::string>>& notes) {
  std::vector<std::string> all;
  for (const auto& note : notes)
    if (note) all.push_back(*note);
  return all;
}

}  // namespace

std::vector<std::string> notes_on_sheet(const PrintRequest& request, const Design& design,
                                        const Design& printed, const PrintSheet& sheet) {
  std::vector<std::string> all = idle_options(request, printed, sheet);
  model::append(given_notes({size_note(design, sheet), sheet_note(design, sheet),
                             elastic_note(request, design, sheet), strain_note(sheet)}),
                all);
  return all;
}

std::vector<std::string> notes_on_files(const PrintRequest& request,
                                        const std::vector<const PrintFormat*>& formats, const PrintJob& job) {
  return given_notes({always_flat_note(request, formats), flat_tiles_note(request, job.sheet),
                      unlaid_note(request, formats, job.lie), unstretched_note(job.sheet, formats),
                      slicer_note(job, formats)});
}

}  // namespace kinetix::app
