#include "app/cli/checked_file.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/goals/registry.hpp"
#include "app/pipeline/certify.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/hinge_loads.hpp"
#include "app/result/certified_json.hpp"
#include "app/result/state_json.hpp"
#include "app/run/design_hinges.hpp"
#include "app/sweep/plan/sweep_plan.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::app {
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

// Text after the folded size of a design, whose file has no goal. A search's report turns the fold as its goal lies.
constexpr const char* of_motion = " along x, y and z of the design's motion";

// Number of bodies up to which the collision-free range is computed within a second.
constexpr int most_bodies_for_contact = 4000;

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
    parts = fmt::format(" (search {}, physics run {})", about(f.search_s),
                        f.has_physics ? about(physics) : "none");
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
  out += line("takes", time_text(f, linkage));
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

/// Reports how long the check of a large sheet takes. @throws InvalidInput if it takes more memory than is free
void announce_check(const std::string& file, const model::Lattice& sheet, const Progress& progress) {
  const double seconds = check_seconds_per_body * sheet.bodies(),
               bytes = check_bytes_per_body * sheet.bodies();
  if (const auto free = free_memory(); free && !(bytes <= *free))
    throw InvalidInput(
        fmt::format("checking {} bodies takes about {:.0f} MB of memory, and {:.0f} MB are free. "
                    "Take fewer cells, or close other programs",
                    sheet.bodies(), bytes / 1e6, *free / 1e6),
        {file, 0, 0, "structure.cells"});
  if (seconds >= 1)
    progress(fmt::format("checking {} bodies, {}, {:.0f} MB of memory", sheet.bodies(), about(seconds),
                         bytes / 1e6),
             -1, {});
}

}  // namespace

std::string CheckedFile::text() const {
  std::string out = fmt::format("{}: valid {} '{}'\n", file, kind, name);
  if (forecast) out += text_of(*forecast, kind == "design" ? of_motion : "");
  if (contact)
    for (const auto& [label, words] :
         certified_lines(contact->certified, forecast->sheet, contact->theta, NearExact::same))
      out += line(label.c_str(), words);
  if (kind == "sweep") out += line("samples", fmt::format("{:.0f}", samples));
  return out;
}

nlohmann::ordered_json CheckedFile::json() const {
  nlohmann::ordered_json out = {{"file", file}, {"kind", kind}, {"name", name}, {"valid", true}};
  if (forecast) out["expected"] = json_of(*forecast);
  if (contact)
    out["certified"] = certified_json(contact->certified, forecast->sheet, contact->theta, NearExact::same);
  if (kind == "sweep") out["samples"] = samples;
  return out;
}

CheckedFile check_file(const std::string& file, const Progress& progress) {
  const targets::Node root = targets::read_document(file, max_design_bytes);
  if (root.kind() != targets::Node::Kind::map)
    throw root.error(
        "is no map of keys, which a target, a design and a sweep are; the first is `kinetix: 1`");
  if (root.optional("factors")) {
    const SweepPlan plan = make_sweep_plan(file, {});
    return {
        .file = file, .kind = "sweep", .name = plan.doe.name, .samples = static_cast<double>(plan.size())};
  }
  if (root.optional("target")) {
    const Target target = read_target(root);
    return {file, "target", target.goal->name, target.goal->forecast()};
  }
  const Design design = read_design(root);
  if (design.structure.assembly()) return {file, "design", design.name};
  announce_check(file, design.structure, progress);
  CheckedFile out{.file = file, .kind = "design", .name = design.name, .forecast = forecast_design(design)};
  if (design.structure.bodies() <= most_bodies_for_contact)
    out.contact = contact_of(design);
  else
    out.forecast->notes.push_back(fmt::format(
        "the collision-free range is computed here for up to {} bodies; `simulate` needs {} for it",
        most_bodies_for_contact, about(contact_seconds(design.structure))));
  return out;
}

}  // namespace kinetix::app
