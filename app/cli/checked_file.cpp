#include "app/cli/checked_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/assembly/assembly_file.hpp"
#include "app/goals/read_target.hpp"
#include "app/pipeline/certify.hpp"
#include "app/pipeline/design_drive.hpp"
#include "app/pipeline/design_scene.hpp"
#include "app/result/certified_json.hpp"
#include "app/result/state_json.hpp"
#include "app/run/run_hinges.hpp"
#include "app/sweep/plan/sweep_plan.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// Of a fold whose file has no goal; the report of a search turns it as its goal lies.
constexpr const char* of_motion = " along x, y and z of the design's motion";

// Bodies, of which the collision-free range is computed within a second.
constexpr int most_bodies_for_contact = 4000;

std::string size_text(const Eigen::Vector3d& mm) {
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", mm.x(), mm.y(), mm.z());
}

std::string line(const char* name, const std::string& text) {
  return fmt::format("  {:<10} {}\n", name, text);
}

double physics_of(const Forecast& f) { return f.has_physics ? physics_seconds(f.sheet) : 0; }

std::string time_text(const Forecast& f) {
  const double physics = physics_of(f);
  const double memory_mb = memory_needed(f.sheet) / 1e6;
  std::string parts;
  if (f.search_s + physics >= 1)
    parts = fmt::format(" (search {}, physics run {})", about(f.search_s),
                        f.has_physics ? about(physics) : "none");
  return fmt::format("{}{}, {:.0f} MB of memory", about(f.search_s + physics), parts, memory_mb);
}

/// @param lies how, where that is not as a goal was drawn
std::string text_of(const Forecast& f, const char* lies) {
  std::string out =
      line("sheet", fmt::format("{} bodies, {} hinges; flat {}, cells of {:.4g} mm, walls {:.3g} mm thick",
                                f.sheet.bodies(), f.sheet.hinges(), size_text(flat_size(f.sheet)),
                                f.sheet.size().edge_mm, f.sheet.size().thickness_mm));
  if (f.folded_mm) out += line("folded", "about " + size_text(*f.folded_mm) + lies);
  out += line("takes", time_text(f));
  for (const std::string& note : f.notes) out += line("note", note);
  return out;
}

nlohmann::ordered_json json_of(const Forecast& f) {
  nlohmann::ordered_json out = {{"bodies", f.sheet.bodies()},
                                {"hinges", f.sheet.hinges()},
                                {"flat_mm", point_json(flat_size(f.sheet))},
                                {"folded_mm", nullptr},
                                {"search_s", f.search_s},
                                {"physics_s", physics_of(f)},
                                {"memory_bytes", memory_needed(f.sheet)},
                                {"notes", f.notes}};
  if (f.folded_mm) out["folded_mm"] = point_json(*f.folded_mm);
  return out;
}

std::optional<CheckedContact> contact_of(const DesignFile& design, const Scene& scene) {
  const model::ExactMotion exact = exact_motion(design.structure);
  if (!exact || scene.model() == Model::equilibrium) return std::nullopt;
  Run sheet;
  sheet.structure = design.structure;
  sheet.hinge = design.hinge;
  sheet.own_hinges = design.own_hinges;
  sheet.process = design.process.value_or(sheet.process);
  return CheckedContact{certify(design.structure, wall_error(sheet)), exact_theta_of(design, exact)};
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

CheckedFile check_file(const std::string& file) {
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
    return {file, "target", target.goal->name(), target.goal->forecast()};
  }
  if (is_assembly(root)) return {file, "design", read_assembly(root).name};
  const DesignFile design = read_design(root);
  const auto scene = make_scene(design, Model::bullet);
  CheckedFile out{.file = file, .kind = "design", .name = scene->name(), .forecast = scene->forecast()};
  if (design.structure.bodies() <= most_bodies_for_contact)
    out.contact = contact_of(design, *scene);
  else
    out.forecast->notes.push_back(fmt::format(
        "the collision-free range is computed here for up to {} bodies; `simulate` needs {} for it",
        most_bodies_for_contact, about(contact_seconds(design.structure))));
  return out;
}

}  // namespace kinetix::app
