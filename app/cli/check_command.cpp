#include "app/cli/commands.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "app/files/cuts_section.hpp"
#include "app/files/drawing_section.hpp"
#include "app/files/lattice_section.hpp"
#include "app/goals/registry.hpp"
#include "app/io/atomic_file.hpp"
#include "app/pictures/panel_picture.hpp"
#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/result/state_json.hpp"
#include "app/run/design_hinges.hpp"
#include "app/sweep/plan/sweep_plan.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {
namespace {

/// Draws pieces and bridges of a sheet with cuts, or only the lines of one that is refused.
std::string picture_of_cuts(const targets::Node& root, const targets::DrawnWalls& lines) {
  try {
    return cut_picture(*read_design(root).cuts);
  } catch (const InvalidInput&) {
    return drawing_picture(lines);
  }
}

/// Writes the picture of `check --picture`: the lines of a drawing, or the flat sheet of another file. Nothing is written
/// if a file without a drawing was refused.
void write_check_picture(const CommandOptions& options, const std::optional<Forecast>& forecast) {
  if (options.picture.empty()) return;
  const targets::Node root = targets::read_changed_document(options.file, max_design_bytes, options.changes);
  if (const auto drawn = find_drawn_structure(root)) {
    const targets::DrawnWalls walls = examine_drawn_structure(*drawn);
    std::error_code missing;  // set if the picture does not exist yet
    if (std::filesystem::equivalent(options.picture, walls.file, missing))
      throw InvalidInput("--picture would replace the drawing. Give another file", {options.picture});
    if (!walls.fault && drawn->knows("cuts"))
      return write_file(options.picture, picture_of_cuts(root, walls));
    return write_file(options.picture, drawing_picture(walls));
  }
  if (!forecast)
    throw InvalidInput("--picture draws sheets, and this file has none. Remove the option", {options.file});
  const model::Linkage sheet = forecast->sheet;
  write_file(options.picture, panel_picture(sheet, rest_state(sheet), {}));
}

CheckedFile check_and_draw(const CommandOptions& options, const Progress& progress) {
  try {
    CheckedFile checked = check_file(options.file, options.changes, progress);
    write_check_picture(options, checked.forecast);
    return checked;
  } catch (const InvalidInput& fault) {
    try {
      write_check_picture(options, {});
    } catch (const InvalidInput&) {
      // The file cannot be drawn, and its fault is the answer.
    }
    throw InvalidInput(fault);
  }
}

}  // namespace

int check_command(const CommandOptions& options) {
  Console console(options.quiet);
  const CheckedFile checked = check_and_draw(options, console.progress());
  if (options.json)
    std::cout << checked.json().dump(1) << "\n";
  else
    print_on_stdout(options.verbose ? checked.text() : format_short(checked.short_form()));
  return done;
}

namespace {

std::optional<double> available_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double kib = 0;
  while (file >> key >> kib && std::getline(file, unit))
    if (key == "MemAvailable:") return kib * 1024;
  return std::nullopt;
}

/// Returns the bytes that the limit of address space leaves, or infinity without a limit.
double left_of_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return std::max(static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE)),
                  0.0);
}

/// Returns the memory that this process can still allocate, bytes. It is what the system has available, or what the
/// limit of the process (`ulimit -v`) leaves, if that is less. Empty if the system does not report it.
std::optional<double> free_memory() {
  const std::optional<double> available = available_bytes();
  if (!available) return std::nullopt;
  return std::min(*available, left_of_limit());
}

// Text after the folded size of a design, whose file has no goal. A search's report turns the fold to its goal.
constexpr const char* of_motion = " along x, y and z of the design's motion";

// Number of bodies up to which the collision-free range is computed within a second.
constexpr int max_bodies_for_contact = 4000;

// Measured on square sheets of 250 x 250 and 1000 x 1000 cells, after reading.
constexpr double check_seconds_per_body = 1e-5, check_bytes_per_body = 1.6e3;

std::string size_text(const Eigen::Vector3d& mm) {
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", mm.x(), mm.y(), mm.z());
}

std::string line(const char* name, const std::string& text) {
  return fmt::format("  {:<10} {}\n", name, text);
}

double physics_of(const Forecast& f) { return f.has_physics ? physics_seconds(f.sheet) : 0; }

std::string time_text(const Forecast& f, const model::Linkage& linkage) {
  const double physics = physics_of(f);
  const double memory_mb = memory_needed(linkage) / 1e6;
  std::string parts;
  if (f.search_s + physics >= 1)
    parts = fmt::format(" (search {}, simulation {})", about(f.search_s),
                        f.has_physics ? about(physics) : "skipped: too large");
  return fmt::format("{}{}, {:.0f} MB of memory", about(f.search_s + physics), parts, memory_mb);
}

/// Formats a forecast. @param lies text on the axes of the folded size; empty for targets
std::string text_of(const Forecast& f, const char* lies) {
  const model::Linkage linkage = f.sheet;
  std::string out =
      line("sheet", fmt::format("{} bodies, {} hinges; flat {}, cells of {:.4g} mm, walls {:.3g} mm thick",
                                f.sheet.bodies(), f.sheet.hinges(), size_text(flat_size(linkage)),
                                f.sheet.size().edge_mm, f.sheet.size().thickness_mm));
  if (f.folded_mm) out += line("folded", "about " + size_text(*f.folded_mm) + lies);
  out += line("run time", time_text(f, linkage));
  for (const std::string& note : f.notes) out += line("note", note);
  return out;
}

nlohmann::ordered_json json_of(const Forecast& f) {
  const model::Linkage linkage = f.sheet;
  nlohmann::ordered_json out = {{"bodies", f.sheet.bodies()},
                                {"hinges", f.sheet.hinges()},
                                {"flat_mm", point_json(flat_size(linkage))},
                                {"folded_mm", nullptr},
                                {"search_s", f.search_s},
                                {"physics_s", physics_of(f)},
                                {"memory_bytes", memory_needed(linkage)},
                                {"notes", f.notes}};
  if (f.folded_mm) out["folded_mm"] = point_json(*f.folded_mm);
  return out;
}

std::optional<CheckedContact> contact_of(const Design& design) {
  const model::ExactMotion exact = exact_motion(design.structure);
  if (!exact || plan_model(design, Model::bullet) == Model::equilibrium) return std::nullopt;
  return CheckedContact{certify(design.structure, wall_error(design)), exact_theta_of(design, exact)};
}

/// Returns the size of the drawing that a design names; empty for other designs.
std::optional<CheckedDrawing> drawing_of(const targets::Node& root) {
  const auto drawn = find_drawn_structure(root);
  if (!drawn) return std::nullopt;
  const targets::DrawnWalls walls = examine_drawn_structure(*drawn);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& vertex : walls.graph.vertices) box.extend(vertex);
  if (box.isEmpty())
    for (const targets::DrawnLine& line : walls.lines) box.extend(line.from).extend(line.to);
  return CheckedDrawing{box.sizes(), walls.unit};
}

/// Reports how long the check of a large sheet takes. @throws InvalidInput if it takes more memory than is free
void announce_check(const std::string& file, const model::Lattice& sheet, const Progress& progress) {
  const double seconds = check_seconds_per_body * sheet.bodies(),
               bytes = check_bytes_per_body * sheet.bodies();
  if (const auto free = free_memory(); free && !(bytes <= *free))
    throw InvalidInput(
        fmt::format("checking {} bodies needs about {:.0f} MB of memory, and {:.0f} MB are free. "
                    "Give fewer cells, or close other programs",
                    sheet.bodies(), bytes / 1e6, *free / 1e6),
        {file, 0, 0, "structure.cells"});
  if (seconds >= 1)
    progress(fmt::format("checking {} bodies, {}, {:.0f} MB of memory", sheet.bodies(), about(seconds),
                         bytes / 1e6),
             -1, {});
}

}  // namespace

std::string CheckedDrawing::size_text() const {
  return fmt::format("{:.4g} x {:.4g} mm", size_mm.x(), size_mm.y());
}

std::string CheckedFile::text() const {
  std::string out = fmt::format("{}: valid {} '{}'\n", file, kind, name);
  if (drawing) out += line("drawing", drawing->size_text() + "; " + drawing->unit);
  if (!cuts.empty()) out += line("sheet", cuts);
  if (forecast) out += text_of(*forecast, kind == "design" ? of_motion : "");
  if (contact)
    for (const auto& [label, words] :
         certified_lines(contact->certified, forecast->sheet, contact->theta, ClosedFormRelation::same))
      out += line(label.c_str(), words);
  if (kind == "sweep") out += line("samples", fmt::format("{:.0f}", samples));
  return out;
}

ShortForm CheckedFile::short_form() const {
  ShortForm out{.title = fmt::format("{}: valid {} '{}'", file, kind, name)};
  if (forecast) {
    const model::Linkage linkage = forecast->sheet;
    const model::CellSize size = forecast->sheet.size();
    out.lines = {{"sheet", fmt::format("{} bodies, {} hinges; cells of {} mm, walls {} mm thick",
                                       forecast->sheet.bodies(), forecast->sheet.hinges(),
                                       format_figures(size.edge_mm), format_figures(size.thickness_mm))},
                 {"size", "flat " + size_text(flat_size(linkage))},
                 {"time", time_text(*forecast, linkage)}};
    if (forecast->folded_mm) out.lines[1][1] += "; folded about " + size_text(*forecast->folded_mm);
    for (const std::string& note : forecast->notes) out.problems.push_back({"warning", note});
  }
  // Early, since problems replace the last lines; separate, since long lines lose their last parts.
  if (drawing)
    out.lines.insert(out.lines.begin() + (out.lines.empty() ? 0 : 1),
                     {{"drawing", drawing->size_text()}, {"unit", drawing->unit}});
  if (!cuts.empty()) out.lines.push_back({"sheet", cuts});
  if (contact)
    out.lines.push_back(
        certified_lines(contact->certified, forecast->sheet, contact->theta, ClosedFormRelation::same)
            .front());
  if (kind == "sweep") out.lines.push_back({"samples", fmt::format("{:.0f}", samples)});
  return out;
}

nlohmann::ordered_json CheckedFile::json() const {
  nlohmann::ordered_json out = {{"file", file}, {"kind", kind}, {"name", name}, {"valid", true}};
  if (forecast) out["expected"] = json_of(*forecast);
  if (drawing)
    out["drawing"] = {{"size_mm", {drawing->size_mm.x(), drawing->size_mm.y()}}, {"unit", drawing->unit}};
  if (!cuts.empty()) out["cuts"] = cuts;
  if (contact)
    out["certified"] =
        certified_json(contact->certified, forecast->sheet, contact->theta, ClosedFormRelation::same);
  if (kind == "sweep") out["samples"] = samples;
  return out;
}

CheckedFile check_file(const std::string& file, const targets::DocumentChanges& changes,
                       const Progress& progress) {
  const targets::Node root = targets::read_changed_document(file, max_design_bytes, changes);
  if (root.kind() != targets::Node::Kind::map)
    throw root.error("this is not a kinetix file. Write YAML keys, starting with `kinetix: 1`");
  if (root.optional("factors")) {
    const SweepPlan plan = make_sweep_plan(file, {}, changes);
    return {
        .file = file, .kind = "sweep", .name = plan.doe.name, .samples = static_cast<double>(plan.size())};
  }
  if (root.optional("target")) {
    const Target target = read_target(root);
    return {file, "target", target.goal->name, target.goal->forecast()};
  }
  const Design design = read_design(root);
  if (design.structure.assembly()) {
    CheckedFile out{.file = file, .kind = "design", .name = design.name, .drawing = drawing_of(root)};
    if (design.cuts) out.cuts = describe_cuts(*design.cuts, design.process.kerf_mm);
    return out;
  }
  announce_check(file, design.structure, progress);
  CheckedFile out{.file = file, .kind = "design", .name = design.name, .forecast = forecast_design(design)};
  out.drawing = drawing_of(root);
  if (design.structure.bodies() <= max_bodies_for_contact)
    out.contact = contact_of(design);
  else
    out.forecast->notes.push_back(
        fmt::format("the collision-free range is computed here for up to {} bodies. Run `simulate`, which "
                    "needs {} for it",
                    max_bodies_for_contact, about(contact_seconds(design.structure))));
  return out;
}

}  // namespace kinetix::app
