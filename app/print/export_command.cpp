#include "app/print/export_command.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/io/atomic_file.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/print/fit.hpp"
#include "app/print/folding_card.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/print_report.hpp"
#include "app/print/sheet/coupon.hpp"
#include "app/print/sheet/print_sheet.hpp"
#include "app/print/slicer.hpp"
#include "app/run/design_hinges.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

constexpr double strain_report_threshold =
    1e-6;  // of the strain that a material bears: a smaller excess is rounding

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

/// Returns the process to print by. The design's own limits also apply if its process is requested by name.
/// @param of_design the design's process
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

/// Returns the requested kind of hinge; empty: the first that fits.
std::optional<model::HingeKind> kind_of(const PrintRequest& request) {
  if (request.hinge.empty()) return std::nullopt;
  return named<model::HingeKind>(
      "--hinge", request.hinge,
      {{"pin", model::HingeKind::pin}, {"block", model::HingeKind::block}, {"film", model::HingeKind::film}});
}

/// Returns the requested kind of lock; empty: the design's.
std::optional<LockKind> lock_of(const PrintRequest& request) {
  if (request.lock.empty()) return std::nullopt;
  return named<LockKind>("--lock", request.lock,
                         {{"clip", LockKind::clip}, {"strap", LockKind::strap}, {"none", LockKind::none}});
}

/// Returns the slicer that the 3MF file is for; empty: all.
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

/// Returns the least clearance of the pins that the design itself describes, mm; empty without such pins.
std::optional<double> clearance_override_mm(const Design& design) {
  std::optional<double> least;
  for (const HingeSection* hinge : hinge_sections(design))
    if (hinge->made && hinge->made->kind == model::HingeKind::pin)
      least = std::min(least.value_or(hinge->made->clearance_mm), hinge->made->clearance_mm);
  return least;
}

void check_clearance_override(const PrintRequest& request, const Design& design) {
  const std::optional<double> own = clearance_override_mm(design);
  if (own && *own < request.clearance_mm)
    throw InvalidInput(fmt::format(
        "the design's own pins have a clearance of {:g} mm, and --clearance asks for {:g}: change "
        "`clearance_mm` in the design",
        *own, request.clearance_mm));
}

/// Returns the design to print. Joints are left open again for another process, another kind of hinge, or other sizes of
/// hinges or cells. The motion of joints does not depend on their hinges.
Design reopened(Design design, const PrintRequest& request) {
  const bool names_process = !request.process.empty() && request.process != design.process.name;
  const bool changes = names_process || !request.hinge.empty() || request.clearance_mm > 0 || request.caps ||
                       request.loose_rods || request.cell_mm > 0;
  return changes ? with_open_joints(std::move(design)) : design;
}

/// Rejects options that would change a coupon. Its bed and orientation may be chosen.
void reject_design_options(const PrintRequest& request) {
  const auto refuse = [](bool given, const char* option, const char* why) {
    if (given) throw InvalidInput(fmt::format("{} of designs: {}", option, why));
  };
  refuse(request.clearance_mm > 0, "--clearance is", "a coupon has gaps of its own");
  refuse(request.caps, "--caps are", "a coupon's axes are in the middle");
  refuse(!request.hinge.empty(), "--hinge is", "a coupon's hinges are pins");
  refuse(request.cell_mm > 0, "--cell-mm is", "a coupon has no cells");
  refuse(!request.lock.empty(), "--lock is", "a coupon does not fold");
  refuse(request.loose_rods, "--loose-rods are", "a coupon's rods are printed in place");
  refuse(request.folded, "--state folded is", "a coupon's hinges each turn by themselves");
}

/// Rejects options that make sheets: imported bodies are written as their parts are.
void reject_sheet_options(const PrintRequest& request) {
  constexpr const char* instead = "a design of bodies is written as ";
  const auto refuse = [&](bool given, const char* option) {
    if (given) throw InvalidInput(fmt::format("{} makes sheets; {}its parts are", option, instead));
  };
  refuse(!request.hinge.empty(), "--hinge");
  refuse(request.clearance_mm > 0, "--clearance");
  refuse(request.cell_mm > 0, "--cell-mm");
  refuse(!request.bed_mm.empty(), "--bed");
  refuse(!request.lock.empty(), "--lock");
  refuse(request.loose_rods, "--loose-rods");
  refuse(request.caps, "--caps");
  refuse(request.orient != "flat", "--orient");
  refuse(request.slice, "--slice");
  constexpr std::array<std::string_view, 3> meshes = {"stl", "3mf", "glb"};
  for (const std::string& name : request.formats)
    if (std::find(meshes.begin(), meshes.end(), name) == meshes.end())
      throw InvalidInput(fmt::format("--format: {} is of sheets; {}{}", targets::in_ticks(name), instead,
                                     targets::joined(meshes)));
}

/// Rejects the folded state of a sheet for which only the flat state is known.
void check_state(const PrintRequest& request, const PrintSheet& sheet) {
  if (request.folded && !sheet.is_path_exact && !sheet.no_path_reason.empty())
    throw InvalidInput("--state folded: how the design looks when it is folded is not known: " +
                       sheet.no_path_reason);
}

/// Lists requested options that change nothing, a sentence each.
std::vector<std::string> idle_options(const PrintRequest& request, const Design& design,
                                      const PrintSheet& sheet) {
  std::vector<std::string> all;
  const auto has = [&](model::HingeKind kind) {
    return std::any_of(sheet.hinges.begin(), sheet.hinges.end(),
                       [&](const model::HingePrint& hinge) { return hinge.made.kind == kind; });
  };
  const bool has_pins = has(model::HingeKind::pin);
  if (const auto kind = kind_of(request); kind && !has(*kind))
    all.push_back("--hinge changes nothing: the design says itself how its hinges are made");
  if (request.clearance_mm > 0 && !has_pins) all.push_back("--clearance changes nothing: no hinge is a pin");
  if (const auto own = clearance_override_mm(design); own && request.clearance_mm > 0)
    all.push_back(fmt::format(
        "--clearance {:g} leaves the design's own pins as they are: their clearance is {:g} mm or more",
        request.clearance_mm, *own));
  if (request.loose_rods && !has_pins) all.push_back("--loose-rods changes nothing: no hinge is a pin");
  if (request.caps && !sheet.has_caps())
    all.push_back("--caps changes nothing: all axes are in the middle of their walls");
  return all;
}

/// Describes walls that are as high as the sheet that they are cut from, if the design has others.
std::optional<std::string> sheet_note(const Design& design, const PrintSheet& sheet) {
  const double height_mm = design.structure.size().height_mm;
  if (!sheet.process.cuts_sheets() || sheet.process.sheet_mm == height_mm) return std::nullopt;
  return fmt::format(
      "walls are {:g} mm high, as the sheet is thick, instead of {:g}: bridges are softer or stiffer by as "
      "much; "
      "for another sheet give the design `process: {{base: {}, sheet_mm: ...}}` and walls of that height",
      sheet.process.sheet_mm, height_mm, sheet.process.name);
}

/// Describes how cells of another edge change the size that the design was made for. Empty if they do not.
std::optional<std::string> size_note(const Design& design, const PrintSheet& sheet) {
  const double edge_mm = sheet.linkage.size.edge_mm;
  const double design_edge_mm = design.structure.size().edge_mm;
  const auto resized = describe_resizing(design_edge_mm, edge_mm);
  if (!resized) return std::nullopt;
  return fmt::format(
      "made with cells of {:.3g} mm instead of {:.3g}: {}; for the size that its goal asked for search again "
      "with {} cells{}",
      edge_mm, design_edge_mm, *resized, edge_mm > design_edge_mm ? "fewer" : "more",
      sheet.is_path_exact ? "" : "; its fold is the equilibrium at its own size, scaled");
}

/// Describes the hinge that is strained farthest beyond what its material bears along the path to the fold.
std::optional<std::string> strain_note(const PrintSheet& sheet) {
  std::optional<model::StrainedHinge> worst;
  for (const model::State& state : sheet.path) {
    const auto one = most_strained(sheet.linkage, state, [&](int h) { return &sheet.hinges[h].made; });
    if (one && one->share() > (worst ? worst->share() : 1 + strain_report_threshold)) worst = one;
  }
  if (!worst) return std::nullopt;
  return describe_strain(*worst, sheet.linkage.wall_name(worst->hinge), " on the way to the fold");
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
      "--state folded changes nothing in {}, where the sheet is always flat; sizes here are of the fold",
      flat);
}

/// Describes that tiles are printed flat, if the folded state is requested.
std::optional<std::string> flat_tiles_note(const PrintRequest& request, const PrintSheet& sheet) {
  if (!request.folded || sheet.tiles.count() < 2) return std::nullopt;
  return "--state folded changes nothing in tiles, which are printed flat, on the sheet's own side; sizes "
         "here "
         "are of the fold";
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
      "hinges of {} turn and do not stretch, as those of the design do on the way: its actuator need not "
      "reach "
      "the fold",
      rigid);
}

/// Finds how the printed sheet is folded. Empty for cells of another size than the design's.
std::optional<Folding> folding_as_printed(const Design& design, const PrintSheet& sheet) {
  if (describe_resizing(design.structure.size().edge_mm, sheet.linkage.size.edge_mm)) return std::nullopt;
  std::vector<model::ManufacturedHinge> made;
  for (const model::HingePrint& hinge : sheet.hinges) made.push_back(hinge.made);
  return find_folding(with_manufactured_hinges(design, made));
}

/// Source of an export: a design, or a coupon.
struct Source {
  std::string file;
  std::optional<Design> design;

  std::string name() const { return design ? design->name : "coupon"; }

  PreparedPrint prepared_for(const PrintRequest& request) const {
    const model::Process process = process_of(request, design ? design->process : model::processes().front());
    if (!design) {
      reject_design_options(request);
      PrintJob job{make_coupon(process, requested_bed(process))};
      job.slicer = slicer_of(request);
      if (const std::string names = slicer_names(job); !names.empty())
        job.sheet.warnings.push_back("this coupon is for " + names +
                                     ": another slicer may leave another gap that turns");
      const PathClearance clearance = path_clearance(job.sheet);
      return {std::move(job), clearance};
    }
    if (design->structure.assembly()) {
      reject_sheet_options(request);
      if (process.cuts_sheets())
        throw InvalidInput(
            fmt::format("{} cuts flat sheets, and a design of bodies is not one: print it "
                        "instead (--process fdm)",
                        process.name));
      return {{imported_sheet(*design, process, request.folded), request.folded}, {}};
    }
    try {
      Design printed = reopened(*design, request);
      if (const auto lock = lock_of(request)) printed.lock = lock;
      PreparedPrint print = prepared_of_design(printed, request, process);
      check_state(request, print.job.sheet);
      for (std::string& idle : idle_options(request, printed, print.job.sheet))
        print.job.sheet.warnings.push_back(std::move(idle));
      if (auto note = size_note(*design, print.job.sheet))
        print.job.sheet.warnings.push_back(std::move(*note));
      if (auto note = sheet_note(*design, print.job.sheet))
        print.job.sheet.warnings.push_back(std::move(*note));
      if (auto note = elastic_note(request, *design, print.job.sheet))
        print.job.sheet.warnings.push_back(std::move(*note));
      if (auto note = strain_note(print.job.sheet)) print.job.sheet.warnings.push_back(std::move(*note));
      print.job.folding = folding_as_printed(printed, print.job.sheet);
      return print;
    } catch (const NotPrintable& e) {
      throw NotPrintable(e.reason(), {file, 0, 0, e.place().key});
    } catch (const InvalidInput& e) {
      throw InvalidInput(e.reason(), {file, 0, 0, e.place().key});
    }
  }

 private:
  static PreparedPrint prepared_of_design(const Design& design, const PrintRequest& request,
                                          const model::Process& process) {
    std::optional<model::HingeKind> kind = kind_of(request);
    check_clearance_override(request, design);
    if (request.caps && kind.value_or(model::HingeKind::pin) != model::HingeKind::pin)
      throw InvalidInput("--caps are of pins");
    if (request.caps) kind = model::HingeKind::pin;
    PrintChoice choice{.clearance_mm = request.clearance_mm,
                       .loose_rods = request.loose_rods,
                       .caps = request.caps,
                       .bed_mm = requested_bed(process),
                       .edge_mm = request.cell_mm};
    if (!kind) {
      model::Process tried = process;
      if (request.clearance_mm > 0 || request.loose_rods)  // sizes of pins
        tried.hinges = {model::HingeKind::pin, model::HingeKind::block};
      return prepare_fitting_print(design, tried, choice, request.folded);
    }
    choice.kind = *kind;
    return prepared(design, process, choice, request.folded);
  }
};

Source source_of(const PrintRequest& request) {
  if (request.coupon == request.source.empty()) {
    if (request.coupon) return {};
    const std::string file = design_at(request.source);
    return {file, read_design(file)};
  }
  throw InvalidInput("export needs a design, the folder of a result, or --coupon, and one of them only");
}

}  // namespace

std::string format_help() {
  std::string text;
  for (const PrintFormat* format : print_formats())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", format->name, format->meaning);
  return text + "; all: every one; several, with commas between them";
}

namespace {

void lay_as_requested(const PrintRequest& request, PrintJob& job) {
  if (request.orient == "flat") return;
  const std::vector<PrintOrientation> all = lies(job);
  std::vector<std::pair<std::string_view, const PrintOrientation*>> allowed{{"best", &best(all)}};
  for (const PrintOrientation& lie : all) allowed.emplace_back(lie.name, &lie);
  lay(job, *named("--orient", request.orient, allowed));
}

constexpr const char* slicing_stage = "slicing";

/// Returns a progress that reports slicing once: the slicer says nothing until it ends.
Progress progress_on(Console& console) {
  return [&console](const std::string& name, double done, const std::string& so_far) {
    if (name == slicing_stage)
      console.stage_once(name, so_far);
    else
      console.stage(name, done, {}, so_far);
  };
}

constexpr const char* record_of_prints = ".kinetix-prints";  // separate from runs' record

/// Checks whether a file is written for some sheets only: soft parts, rods, clips, tiles and strips.
bool is_auxiliary(const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  return stem == "soft" || stem.starts_with("tile_") || stem.find("_tile_") != std::string::npos ||
         stem.ends_with("rods") || stem.ends_with("clip") || stem.ends_with("_strips");
}

/// Checks whether an earlier export's file is of a format, or of a sheet, that this one does not write.
bool is_of_another_export(const std::string& file, const Exported& now, const std::string& name) {
  const std::string ending = fs::path(file).extension().string();
  const bool same_format = std::any_of(now.files.begin(), now.files.end(), [&](const std::string& written) {
    return fs::path(written).extension() == ending;
  });
  return !same_format || (ending != ".stl" && !file.starts_with(name + "_"));
}

/// Checks whether a report next to the design may describe this print: flat, of the design's size, in one piece.
bool can_describe_in_report(const Source& source, const PrintJob& job) {
  if (!source.design || source.file.empty() || job.folded || job.sheet.tiles.count() > 1) return false;
  return !describe_resizing(source.design->structure.size().edge_mm, job.sheet.linkage.size.edge_mm);
}

Exported exported(const Source& source, const PrintRequest& request, const std::string& where,
                  const Progress& progress) {
  const auto formats = formats_of(request);
  const auto slicer_choice = slicer_of(request);
  for (const PrintFormat* format : formats)
    if (format->load) format->load();
  OutputFolder folder(where);
  progress("building solids", -1);
  PreparedPrint print = source.prepared_for(request);
  lay_as_requested(request, print.job);
  print.job.slicer = slicer_choice;
  for (auto& note : {always_flat_note(request, formats), flat_tiles_note(request, print.job.sheet),
                     unlaid_note(request, formats, print.job.lie), unstretched_note(print.job.sheet, formats),
                     slicer_note(print.job, formats)})
    if (note) print.job.sheet.warnings.push_back(*note);
  if (request.slice) progress(slicing_stage, -1, fmt::format("PrusaSlicer, at most {:g} s", slicing_limit_s));
  const std::optional<SlicerAnswer> slicer =
      request.slice ? std::optional(estimate_by_slicer(print.job)) : std::nullopt;
  FileSet files(folder.path());
  FileRecord record(folder.path(), record_of_prints);
  Exported out{folder.path(),
               {},
               print_json(print.job, print.clearance, slicer).dump(1) + "\n",
               print_text(print.job, print.clearance, slicer)};
  const auto add = [&](const std::string& name, const std::string& content) {
    files.add(name, content);
    out.files.push_back(name);
    if (is_auxiliary(name)) record.add(name, content);
  };
  for (std::size_t k = 0; k < formats.size(); ++k) {
    progress("writing files", static_cast<double>(k) / static_cast<double>(formats.size()),
             std::string(formats[k]->name));
    for (const auto& [name, content] : formats[k]->write(print.job)) add(name, content);
  }
  if (source.design && !print.job.sheet.is_imported()) {
    const FoldingCard card = make_folding_card(print.job);
    for (const auto& [name, content] : card_files(card)) add(name, content);
    out.card = card_json(card).dump();
  }
  add("print.json", out.json);
  add("print.txt", out.text);
  record.keep([&](const std::string& file) { return is_of_another_export(file, out, print.job.sheet.name); });
  if (const std::string text = record.text(); !text.empty()) files.add(record_of_prints, text);
  files.commit();
  record.remove_leftovers();
  folder.keep();
  if (can_describe_in_report(source, print.job) && slicer && slicer->estimate)
    out.report = add_to_report(source.file, *source.design, estimate_json(print.job, *slicer->estimate));
  return out;
}

}  // namespace

Exported export_design(const Design& design, const PrintRequest& request, const std::string& folder,
                       const Progress& progress) {
  return exported({"", design}, request, folder, progress);
}

int export_command(const CommandOptions& options, const PrintRequest& request) {
  formats_of(request);
  process_of(request, model::processes().front());
  slicer_of(request);
  lock_of(request);
  const Source source = source_of(request);
  const std::string folder = options.folder_of(source.name(), "_print");
  Console console(options.quiet, false);
  const Exported out = exported(source, request, folder, progress_on(console));
  std::string text =
      out.text + fmt::format("{:<12} {}: {}\n", "written", out.folder, fmt::join(out.files, ", "));
  if (!out.report.empty()) text += fmt::format("{:<12} {} has time and material too\n", "report", out.report);
  std::cout << (options.json ? out.json : text);
  return done;
}

}  // namespace kinetix::app
