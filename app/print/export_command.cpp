#include "app/print/export_command.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/io/atomic_file.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/print/fit.hpp"
#include "app/print/folding_card.hpp"
#include "app/print/print_report.hpp"
#include "app/print/sheet/coupon.hpp"
#include "app/print/sheet/print_sheet.hpp"
#include "app/print/slicer.hpp"
#include "app/run/design_hinges.hpp"
#include "model/base/algorithms.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

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
      reject_sheet_options(request, design->cuts && process.cuts_sheets());
      if (process.cuts_sheets() && !design->cuts)
        throw InvalidInput(
            fmt::format("{} cuts flat sheets, and a design of bodies is not one: print it "
                        "instead (--process fdm)",
                        process.name));
      return {{imported_sheet(*design, process, request.folded), request.folded}, {}};
    }
    try {
      Design printed = reopened(*design, request);
      if (const auto lock = lock_of(request)) printed.lock = lock;
      PreparedPrint print = prepared_with_lock(printed, request, process);
      check_state(request, print.job.sheet);
      model::append(notes_on_sheet(request, *design, printed, print.job.sheet), print.job.sheet.warnings);
      print.job.folding = folding_as_printed(printed, print.job.sheet);
      return print;
    } catch (const NotPrintable& e) {
      throw NotPrintable(e.reason(), {file, 0, 0, e.place().key});
    } catch (const InvalidInput& e) {
      throw InvalidInput(e.reason(), {file, 0, 0, e.place().key});
    }
  }

 private:
  /// Prepares a design. A lock of the design that other hinges or sizes leave no room for is left out with a warning.
  PreparedPrint prepared_with_lock(Design printed, const PrintRequest& request,
                                   const model::Process& process) const {
    try {
      return prepared_of_design(printed, request, process);
    } catch (const LockDoesNotFit& e) {
      if (!request.lock.empty() || !changes_sheet(request, *design)) throw;
      printed.lock = LockKind::none;
      PreparedPrint print = prepared_of_design(printed, request, process);
      print.job.sheet.warnings.push_back("the print has no lock: " + e.reason());
      return print;
    }
  }

  static PreparedPrint prepared_of_design(const Design& design, const PrintRequest& request,
                                          const model::Process& process) {
    std::optional<model::HingeKind> kind = kind_of(request);
    check_clearance_override(request, design);
    if (request.caps && !is_pin(kind.value_or(model::HingeKind::pin)))
      throw InvalidInput("--round-caps only applies to pins. Remove it, or give --hinge pin");
    if (request.caps && !kind)
      kind = design.hinge.kind == model::HingeKind::rod ? model::HingeKind::rod : model::HingeKind::pin;
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
  model::append(notes_on_files(request, formats, print.job), print.job.sheet.warnings);
  if (request.slice) progress(slicing_stage, -1, fmt::format("PrusaSlicer, at most {:g} s", slicing_limit_s));
  const std::optional<SlicerAnswer> slicer =
      request.slice ? std::optional(estimate_by_slicer(print.job)) : std::nullopt;
  FileSet files(folder.path());
  FileRecord record(folder.path(), record_of_prints);
  Exported out{folder.path(),
               {},
               print_json(print.job, print.clearance, slicer).dump(1) + "\n",
               print_text(print.job, print.clearance, slicer),
               export_form(print.job, print.clearance, slicer)};
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
  Exported out = exported(source, request, folder, progress_on(console));
  std::string text =
      out.text + fmt::format("{:<12} {}: {}\n", "written", out.folder, fmt::join(out.files, ", "));
  if (!out.report.empty()) text += fmt::format("{:<12} {} has time and material too\n", "report", out.report);
  out.form.ends = {fmt::format("Written: {} files in {}", out.files.size(), out.folder),
                   fmt::format("Next: print as in {}/print.txt", out.folder)};
  if (options.json)
    std::cout << out.json;
  else
    print_on_stdout(options.verbose ? text : format_short(out.form));
  return done;
}

}  // namespace kinetix::app
