#include "app/print/export_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/console/console.hpp"
#include "app/io/atomic_file.hpp"
#include "app/print/fit.hpp"
#include "app/print/overhang.hpp"
#include "app/print/print_report.hpp"
#include "app/print/report_of_print.hpp"
#include "app/print/sheet/coupon.hpp"
#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

std::string design_file(const std::string& source) {
  if (!fs::is_directory(source)) return source;
  const fs::path inside = fs::path(source) / "design.yaml";
  if (fs::exists(inside)) return inside.string();
  throw InvalidInput(source + ": no design.yaml in this folder; give a design, or the folder of a result");
}

/// The entry of that name. @param allowed as (name, value)
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

/// @param of_design none: it does not say
const model::Process& process_of(const PrintRequest& request, const std::string& of_design) {
  const std::string& name = request.process.empty() ? of_design : request.process;
  if (name.empty()) return model::processes().front();
  std::vector<std::pair<std::string_view, const model::Process*>> all;
  for (const model::Process& process : model::processes()) all.emplace_back(process.name, &process);
  return *named("--process", name, all);
}

/// None where pins are to be used if they fit.
std::optional<model::HingeKind> kind_of(const PrintRequest& request) {
  if (request.hinge.empty()) return std::nullopt;
  return named<model::HingeKind>(
      "--hinge", request.hinge,
      {{"pin", model::HingeKind::pin}, {"block", model::HingeKind::block}, {"film", model::HingeKind::film}});
}

std::vector<const PrintFormat*> formats_of(const PrintRequest& request) {
  std::vector<const PrintFormat*> out;
  for (const std::string& name : request.formats) {
    if (name == "all") return print_formats();
    out.push_back(&print_format(name));
  }
  return out;
}

/// What is to be made: a design, or a coupon.
struct Source {
  std::string file;
  std::optional<DesignFile> design;

  std::string name() const { return design ? design->name : "coupon"; }

  PreparedPrint prepared_for(const PrintRequest& request) const {
    const model::Process& process = process_of(request, design ? design->process : "");
    if (!design) {
      if (request.clearance_mm > 0)
        throw InvalidInput("--clearance is of designs: a coupon has gaps of its own");
      if (request.caps) throw InvalidInput("--caps are of designs: a coupon's axes are in the middle");
      PrintJob job{make_coupon(process), request.folded};
      const PathClearance clearance = path_clearance(job.sheet);
      return {std::move(job), clearance};
    }
    try {
      std::optional<model::HingeKind> kind = kind_of(request);
      if (request.caps && kind.value_or(model::HingeKind::pin) != model::HingeKind::pin)
        throw InvalidInput("--caps are of pins");
      if (request.caps) kind = model::HingeKind::pin;
      PrintChoice choice{.clearance_mm = request.clearance_mm,
                         .loose_rods = request.loose_rods,
                         .caps = request.caps,
                         .edge_mm = request.cell_mm};
      if (request.bed_mm.size() == 2) choice.bed_mm = {request.bed_mm[0], request.bed_mm[1]};
      if (!kind) return prepared_as_fits(*design, process, choice, request.folded);
      choice.kind = *kind;
      return prepared(*design, process, choice, request.folded);
    } catch (const InvalidInput& e) {
      throw InvalidInput(e.reason(), {file, 0, 0, e.place().key});
    }
  }
};

Source source_of(const PrintRequest& request) {
  if (request.coupon == request.source.empty()) {
    if (request.coupon) return {};
    const std::string file = design_file(request.source);
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

void lay_as_asked(const PrintRequest& request, PrintJob& job) {
  if (request.orient == "flat") return;
  const std::vector<Lie> all = lies(job);
  std::vector<std::pair<std::string_view, const Lie*>> allowed{{"best", &best(all)}};
  for (const Lie& lie : all) allowed.emplace_back(lie.name, &lie);
  lay(job, *named("--orient", request.orient, allowed));
}

Exported exported(const Source& source, const PrintRequest& request, const std::string& where,
                  const Progress& progress) {
  const auto formats = formats_of(request);
  OutputFolder folder(where);
  progress("building solids", -1);
  PreparedPrint print = source.prepared_for(request);
  lay_as_asked(request, print.job);
  if (request.slice) progress("slicing", -1);
  const std::optional<SlicerAnswer> slicer =
      request.slice ? std::optional(ask_slicer(print.job)) : std::nullopt;
  FileSet files(folder.path());
  Exported out{folder.path(),
               {},
               print_json(print.job, print.clearance, slicer).dump(1) + "\n",
               print_text(print.job, print.clearance, slicer)};
  const auto add = [&](const std::string& name, const std::string& content) {
    files.add(name, content);
    out.files.push_back(name);
  };
  for (std::size_t k = 0; k < formats.size(); ++k) {
    progress("writing files", static_cast<double>(k) / static_cast<double>(formats.size()),
             std::string(formats[k]->name));
    for (const auto& [name, content] : formats[k]->write(print.job)) add(name, content);
  }
  add("print.json", out.json);
  add("print.txt", out.text);
  files.commit();
  folder.keep();
  if (source.design && !source.file.empty() && slicer && slicer->estimate)
    out.report = tell_report(source.file, *source.design, estimate_json(print.job, *slicer->estimate));
  return out;
}

}  // namespace

Exported export_design(const DesignFile& design, const PrintRequest& request, const std::string& folder,
                       const Progress& progress) {
  return exported({"", design}, request, folder, progress);
}

int export_command(const CommandOptions& options, const PrintRequest& request) {
  formats_of(request);
  process_of(request, "");
  const Source source = source_of(request);
  const std::string folder = options.folder_given ? options.folder : "results/" + source.name() + "_print";
  const Exported out = exported(source, request, folder, Console(options.quiet, false).progress());
  std::string text =
      out.text + fmt::format("{:<12} {}: {}\n", "written", out.folder, fmt::join(out.files, ", "));
  if (!out.report.empty()) text += fmt::format("{:<12} {} has time and material too\n", "report", out.report);
  std::cout << (options.json ? out.json : text);
  return done;
}

}  // namespace kinetix::app
