#include "app/print/print_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>

#include "app/report/report.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/result/state_json.hpp"
#include "model/base/algorithms.hpp"
#include "model/base/box.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app {
namespace {

/// Hinges of one kind and material.
struct HingeSort {
  model::HingeKind kind = model::HingeKind::pin;
  std::string material;                          ///< its name; empty for pins, and if the user gave numbers
  std::vector<const model::HingePrint*> hinges;  ///< of the sheet, not empty
};

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

std::string describe_material(const HingeSort& sort) {
  return sort.material.empty() ? "your material" : sort.material;
}

std::string plural(model::HingeKind kind) {
  return kind == model::HingeKind::film ? "living hinges" : fmt::format("{}s", to_string(kind));
}

/// Groups a sheet's hinges, in the order in which they first occur.
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

/// Describes the hinges of a sort: "films of pp: gap 2 to 2.5 mm, ...". @param sheet that has them
std::string describe_hinge_sort(const HingeSort& sort, const PrintSheet& sheet) {
  const auto all = [&](const Size& size) { return sizes(sort, size); };
  if (is_pin(sort.kind))
    return fmt::format(
        "{} {} x {} mm, clearance {} mm per side, {} mm along the axis, {} {} mm",
        sort.kind == model::HingeKind::pin ? "pins: rod" : "rods of " + describe_material(sort) + ":",
        all([](const auto& h) { return h.made.diameter_mm; }),
        all([](const auto& h) { return h.made.height_mm; }),
        all([](const auto& h) { return h.made.clearance_mm; }),
        all([](const auto& h) { return h.axial_clearance_mm; }),
        sheet.has_caps() ? "bores in round caps of" : "knuckle", all(knuckle_across_mm));
  return fmt::format("{} of {}: gap {} mm, thickness {} mm, height {} mm", plural(sort.kind),
                     describe_material(sort), all([](const auto& h) { return h.made.gap_mm; }),
                     all([](const auto& h) { return h.made.thickness_mm; }),
                     all([](const auto& h) { return h.made.height_mm; }));
}

/// Warns of files that do not separate soft parts of several materials. Also warns of hinges that the process prints
/// of another material than the design assumes. Soft parts that are a separate print may be of any material.
std::vector<std::string> material_warnings(const PrintSheet& sheet) {
  std::vector<std::string> out, soft;
  for (const HingeSort& sort : hinge_sorts(sheet)) {
    if (is_pin(sort.kind)) continue;
    soft.push_back(fmt::format("{} of {}", plural(sort.kind), describe_material(sort)));
    if (sheet.process.cuts_sheets()) continue;  // the sheet is of that material
    const std::string& printed = sheet.is_one_material() ? sheet.process.film : sheet.process.rubber;
    const bool chosen = sheet.is_one_material() || sheet.process.is_multi_material;
    if (chosen && sort.material != printed)
      out.push_back(fmt::format(
          "{} prints {} of {}: {} of {} have the stiffness of the design only if they are printed of that",
          sheet.process.name, sheet.is_one_material() ? "walls and living hinges in one," : "soft parts",
          printed, plural(sort.kind), describe_material(sort)));
  }
  if (soft.size() > 1 && !sheet.is_one_material())
    out.push_back(
        fmt::format("{} are one soft part in the files, printed of one material: the design assumes a "
                    "separate material for each",
                    fmt::join(soft, " and ")));
  return out;
}

/// Warns of living hinges that are thinner than the line that the nozzle lays, if they are printed in one with their
/// walls. Empty for separate strips, which are rolled or laid flat.
std::optional<std::string> thin_film_warning(const PrintSheet& sheet) {
  const auto& filament = sheet.process.filament;
  if (!filament || !sheet.is_one_material()) return std::nullopt;
  double thinnest = filament->line_mm;
  for (const model::HingePrint& hinge : sheet.hinges)
    if (hinge.made.kind == model::HingeKind::film) thinnest = std::min(thinnest, hinge.made.thickness_mm);
  if (!(thinnest < filament->line_mm)) return std::nullopt;
  return fmt::format(
      "living hinges of {:.3g} mm are thinner than the line of {:g} mm that {} lays. Slicers omit them, or "
      "print "
      "them thicker and stiffer than designed",
      thinnest, filament->line_mm, sheet.process.name);
}

using Json = nlohmann::ordered_json;

constexpr double worth_turning = 0.99;  // of the overhang: a smaller gain is rounding of faces

Json vector_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Eigen::Vector3d bounds(const model::Polyhedron& solid) { return model::box_of(solid.points).sizes(); }

int count_bodies(const PrintSheet& sheet) {
  return static_cast<int>(std::count_if(sheet.meshes.begin(), sheet.meshes.end(),
                                        [](const model::Polyhedron& m) { return !m.points.empty(); }));
}

Json distance_json(const PrintSheet& sheet, const LeastDistance& d) {
  if (d.first < 0) return nullptr;
  return {{"mm", d.mm},
          {"theta_deg", to_degrees(d.theta)},
          {"asked_mm", d.required_mm},
          {"bodies", {part_name(sheet, d.first), part_name(sheet, d.second)}},
          {"place_mm", vector_json(d.place)}};
}

std::string describe_bed(const PrintJob& job) {
  const model::Process& process = job.sheet.process;
  const auto& [x, y] = process.bed_mm;
  const std::string bed =
      fmt::format("larger than the bed of a usual {} printer, {:g} x {:g} mm", process.name, x, y);
  if (process.cuts_sheets())
    return fmt::format("larger than the bed of a usual {} cutter, {:g} x {:g} mm", process.name, x, y);
  if (job.sheet.is_imported() || job.folded) return bed;
  return bed + ". Give the size of your bed (`--bed`) to cut it into tiles";
}

/// Warns if a usual printer does not hold the print. Its bed counts only if the user named none.
std::vector<std::string> room_warnings(const PrintJob& job) {
  const model::Process& process = job.sheet.process;
  const Eigen::Vector3d size = bounds(hard_part(job));
  std::vector<std::string> out;
  if (!job.sheet.tiles.bed_mm && !fits_on_bed(size.head<2>(), {process.bed_mm[0], process.bed_mm[1]}))
    out.push_back(describe_bed(job));
  const char* const limit =
      process.cuts_sheets() ? "thick: a usual {} cutter cuts" : "high: a usual {} printer prints";
  if (size.z() > process.max_height_mm)
    out.push_back(fmt::format("{:.1f} mm {} {:g} mm at most", size.z(),
                              fmt::format(fmt::runtime(limit), process.name), process.max_height_mm));
  return out;
}

/// Warns if the printed rods, side by side, do not fit on the requested bed.
std::optional<std::string> rods_warning(const PrintSheet& sheet) {
  const model::Polyhedron rods = laid_out_rods(sheet);
  if (!sheet.tiles.bed_mm || rods.points.empty()) return std::nullopt;
  const Eigen::Vector3d field = bounds(rods);
  if (fits_on_bed(field.head<2>(), *sheet.tiles.bed_mm)) return std::nullopt;
  return fmt::format("the loose rods need {:.1f} x {:.1f} mm side by side, more than the bed", field.x(),
                     field.y());
}

/// Describes what to do where two tiles meet.
std::string describe_joining(const PrintSheet& sheet) {
  bool pins = false, soft = false;
  for (std::size_t h = 0; h < sheet.hinges.size(); ++h) {
    const model::RestHinge& hinge = sheet.linkage.hinges[h];
    if (sheet.tiles.of_body[hinge.lower] == sheet.tiles.of_body[hinge.upper]) continue;
    (is_pin(sheet.hinges[h].made.kind) ? pins : soft) = true;
  }
  if (pins && soft)
    return "push a rod through each pin between two of them, and glue the soft parts there to both";
  return pins   ? "push a rod through each hinge between two of them"
         : soft ? "glue the soft parts between two of them to both"
                : "no hinge is between two of them";
}

std::string describe_tiles(const PrintSheet& sheet) {
  const Tiles& tiles = sheet.tiles;
  const int places = tiles.columns * tiles.rows;
  return fmt::format("{} x {}{}, one bed each{}: {}", tiles.columns, tiles.rows,
                     tiles.count() < places ? fmt::format(", {} of them with bodies", tiles.count()) : "",
                     tiles.turned ? ", rotated by 90 degrees on the bed" : "", describe_joining(sheet));
}

/// Describes what keeps the sheet folded.
std::string describe_lock(const Lock& lock) {
  const std::string parts =
      lock.kind == "clip"
          ? fmt::format("a clip, printed apart, fits over the posts of bodies {} and {}", lock.bodies[0],
                        lock.bodies[1])
          : fmt::format("a strap through the eyes of bodies {} and {}", lock.bodies[0], lock.bodies[1]);
  const std::string load = lock.force_N > 0 ? fmt::format("the hinges load it with {:.3g} N", lock.force_N)
                                            : std::string("the hinges turn freely and do not load it");
  return fmt::format(
      "{} at the fold, {:.1f} mm apart ({:.1f} mm flat); {}; estimated strength {:.3g} N, of {}, which is "
      "assumed",
      parts, lock.folded_mm, lock.flat_mm, load, lock.strength_N, lock.material);
}

Json slicer_json(const std::optional<SlicerAnswer>& slicer) {
  if (!slicer) return nullptr;
  if (!slicer->estimate) return {{"why_none", slicer->no_estimate_reason}};
  return {{"name", "PrusaSlicer"},
          {"seconds", slicer->estimate->seconds},
          {"material_mm3", slicer->estimate->material_mm3},
          {"prints", slicer->estimate->prints}};
}

Json orientations_json(const std::vector<PrintOrientation>& all) {
  Json out = Json::object();
  for (const PrintOrientation& lie : all) out[std::string(lie.name)] = lie.overhang_mm2;
  return out;
}

/// Returns the swelling per side at which the first two pieces of the flat sheet meet, mm; null with soft parts.
Json swelling_json(const PrintSheet& sheet, const PathClearance& clearance) {
  if (sheet.has_soft() || clearance.least().first < 0) return nullptr;
  return std::max(0.0, clearance.flat_mm / 2);
}

Json gaps_json(const std::optional<GapSettings>& gaps) {
  if (!gaps) return nullptr;
  return {{"closing_radius_mm", gaps->closing_radius_mm},
          {"elephant_foot_compensation_mm", gaps->elephant_foot_mm},
          {"xy_compensation_mm", gaps->expansion_mm}};
}

Json slicer_settings_json(const PrintJob& job) {
  Json out = Json::object();
  const std::vector<Slicer> slicers = slicers_for(job);
  for (const Slicer slicer : slicers) {
    Json& settings = out[std::string(option_name(slicer))] = Json::object();
    for (const auto& [key, value] : object_settings(slicer, job, slicers.size() > 1)) settings[key] = value;
  }
  return out;
}

std::string format_print_time(double seconds) {
  const long minutes = std::max(1L, std::lround(seconds / 60));
  return minutes < 60 ? fmt::format("{} min", minutes)
                      : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string describe_counted_supports(const SliceEstimate& print) {
  if (print.supports) return "with supports";
  return print.lacks_supports ? "without the supports that it needs" : "without supports";
}

std::string describe_slicer_estimate(const SlicerAnswer& slicer, const Tiles& tiles) {
  if (!slicer.estimate) return slicer.no_estimate_reason;
  const SliceEstimate& print = *slicer.estimate;
  return fmt::format("{} and {:.2f} cm3 of material{}, {}, by PrusaSlicer with its own settings for speed{}",
                     format_print_time(print.seconds), print.material_mm3 / mm3_per_cm3,
                     print.prints > 1 ? fmt::format(" in {} prints", print.prints) : "",
                     describe_counted_supports(print),
                     tiles.count() > 1 ? ", as if one bed held all tiles" : "");
}

/// Returns the orientation of the sheet in its files.
const PrintOrientation& current_orientation(const PrintJob& job, const std::vector<PrintOrientation>& all) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const PrintOrientation& lie) { return lie.name == job.lie; });
}

/// Describes the orientation in the files, and whether another one has less overhang.
std::string describe_orientation(const PrintJob& job) {
  const std::vector<PrintOrientation> all = lies(job);
  const PrintOrientation& least = best(all);
  const char* const side = job.lie == "over" ? "flipped about x"
                           : job.folded      ? "as its motion leaves it"
                                             : "flat on the bed";
  const std::string here = fmt::format("{}{}", job.folded ? "folded, " : "", side);
  const PrintOrientation& now = current_orientation(job, all);
  const std::string hangs = fmt::format("{}; {:.1f} mm2 lean more than {:g} degrees over the bed", here,
                                        now.overhang_mm2, steep_deg);
  if (!(least.overhang_mm2 < worth_turning * now.overhang_mm2)) return hangs + ", flipped no less";
  return fmt::format("{}, {:.1f} mm2 with orientation `{}`", hangs, least.overhang_mm2, least.name);
}

namespace fs = std::filesystem;

constexpr std::size_t largest_report = 64 << 20;  // bytes: a report of 10 000 bodies has 9 MB
constexpr double digits_of_reports = 1e-5;        // relative, or mm and rad: reports have six digits

}  // namespace

std::vector<std::string> print_warnings(const PrintJob& job) {
  std::vector<std::string> out;
  if (job.folding && describe_effort(*job.folding) == "no")
    out.emplace_back(
        "no drive is known that folds this print by hand or with a clamp: see `force` in print.txt");
  if (job.folding && !job.folding->overstrain.empty()) out.push_back(job.folding->overstrain);
  model::append(job.sheet.warnings, out);
  if (!job.sheet.no_path_reason.empty())
    out.push_back("the motion to the fold was not checked for collisions: " + job.sheet.no_path_reason);
  if (!job.sheet.is_path_exact && job.sheet.path.size() > 1)
    out.push_back(
        "the motion to the fold was checked along the equilibrium of the design's hinges, since it has no "
        "analytic motion");
  if (!job.sheet.jumps.empty())
    out.push_back(
        fmt::format("the sheet snaps through at fold angle {:.1f} deg. During the snap, parts were checked "
                    "along a straight path",
                    to_degrees(job.sheet.thetas[job.sheet.jumps.front() + 1])));
  if (job.sheet.has_soft() && !job.sheet.process.is_multi_material && !job.sheet.is_one_material())
    out.push_back(job.sheet.process.name +
                  " prints one material. Print the soft parts separately, and glue them to the walls");
  for (const auto& notes : {material_warnings(job.sheet), room_warnings(job)})
    out.insert(out.end(), notes.begin(), notes.end());
  if (auto separation = separation_warning(job)) out.push_back(std::move(*separation));
  if (const auto film = thin_film_warning(job.sheet)) out.push_back(*film);
  if (const auto rods = rods_warning(job.sheet)) out.push_back(*rods);
  const double steep = steepest_deg(job.sheet);
  if (job.sheet.process.filament && steep > steep_deg)
    out.push_back(fmt::format("hinges lean {:.1f} degrees from upright: more than {:g} need support", steep,
                              steep_deg));
  return out;
}

Json estimate_json(const PrintJob& job, const SliceEstimate& print) {
  return {{"process", job.sheet.process.name},
          {"hinges", to_string(job.sheet.kind())},
          {"seconds", print.seconds},
          {"material_mm3", print.material_mm3},
          {"prints", print.prints}};
}

Json print_json(const PrintJob& job, const PathClearance& clearance,
                const std::optional<SlicerAnswer>& slicer) {
  const PrintSheet& sheet = job.sheet;
  const model::Polyhedron hard = hard_part(job), soft = soft_part(job);
  const int usual = sheet.most_frequent_hinge();
  const model::HingeStiffness k =
      sheet.is_imported() ? sheet.imported_k[usual] : stiffness(sheet.hinges[usual].made);
  return {
      {"schema", "kinetix-print/1"},
      {"name", sheet.name},
      {"process", sheet.process.name},
      {"state", job.folded ? "folded" : "flat"},
      {"hinge", to_string(sheet.kind())},
      {"bodies", count_bodies(sheet)},
      {"hinges", sheet.hinges.size()},
      {"volume_mm3", {{"hard", volume_mm3(hard)}, {"soft", soft.points.empty() ? 0.0 : volume_mm3(soft)}}},
      {"clearance_mm", least_clearance_mm(sheet).value_or(0)},
      {"swelling_mm", swelling_json(sheet, clearance)},
      {"gap_settings", gaps_json(gap_settings(sheet))},
      {"slicer_settings", slicer_settings_json(job)},
      {"bounds_mm", vector_json(bounds(joined(hard, soft)))},
      {"orientation", job.lie},
      {"overhang_mm2", orientations_json(lies(job))},
      {"slicer", slicer_json(slicer)},
      {"loose_rods", sheet.loose_rods()},
      {"rods", rods_json(sheet)},
      {"lock", lock_json(sheet.lock)},
      {"caps", sheet.has_caps()},
      {"tiles", {sheet.tiles.columns, sheet.tiles.rows}},
      {"force_N", load_json(job.folding, true)},
      {"moment_Nmm", load_json(job.folding, false)},
      {"folds", job.folding ? Json(describe_effort(*job.folding)) : Json(nullptr)},
      {"k", {{"axial", k.axial}, {"shear", k.shear}, {"along", k.along}, {"turn", k.turn}}},
      {"path",
       {{"states", sheet.path.size()},
        {"theta_deg", to_degrees(sheet.thetas.back())},
        {"asked_mm", clearance.least().required_mm},
        {"in_hinges", distance_json(sheet, clearance.in_hinges)},
        {"elsewhere", distance_json(sheet, clearance.elsewhere)}}},
      {"cut", cut_json(sheet)},
      {"warnings", print_warnings(job)}};
}

namespace {

std::vector<SummaryLine> print_lines(const PrintJob& job, const PathClearance& clearance,
                                     const std::optional<SlicerAnswer>& slicer) {
  const PrintSheet& sheet = job.sheet;
  const Eigen::Vector3d size = bounds(joined(hard_part(job), soft_part(job)));
  std::vector<SummaryLine> lines = {
      {"process", sheet.process.name},
      {"pieces", fmt::format("{} bodies, {} hinges, {:.1f} x {:.1f} x {:.1f} mm", count_bodies(sheet),
                             sheet.hinges.size(), size.x(), size.y(), size.z())}};
  const std::vector<HingeSort> sorts = sheet.is_imported() ? std::vector<HingeSort>{} : hinge_sorts(sheet);
  for (const HingeSort& sort : sorts)
    lines.push_back({"hinges", (sorts.size() > 1 ? fmt::format("{} ", sort.hinges.size()) : "") +
                                   describe_hinge_sort(sort, sheet)});
  if (sheet.tiles.count() > 1)
    lines.push_back({"tiles", describe_tiles(sheet)});
  else if (sheet.tiles.turned)
    lines.push_back({"bed", "fits on the bed rotated by 90 degrees"});
  if (sheet.loose_rods() > 0) lines.push_back({"rods", describe_rods(sheet)});
  if (sheet.lock) lines.push_back({"lock", describe_lock(*sheet.lock)});
  const bool is_cut = sheet.process.cuts_sheets();
  for (const auto& [label, text] : is_cut ? describe_cut(sheet) : CutLines{}) lines.push_back({label, text});
  if (!is_cut) lines.push_back({"orientation", describe_orientation(job)});
  if (slicer) lines.push_back({"slicer", describe_slicer_estimate(*slicer, sheet.tiles)});
  if (!is_cut) lines.push_back({"supports", describe_supports(job)});
  for (const auto& [label, text] : slicer_advice(job)) lines.push_back({label, text});
  const LeastDistance& nearest = clearance.nearest;
  if (nearest.first >= 0 && sheet.path.size() > 1)
    lines.push_back(
        {"motion",
         fmt::format("solids stay {:.3f} mm apart from flat to {:.1f} degrees, least at {:.1f} degrees",
                     nearest.mm, to_degrees(sheet.thetas.back()), to_degrees(nearest.theta))});
  if (job.folding)
    lines.push_back({"force", describe_folding(*job.folding)});
  else if (!sheet.is_imported() && sheet.path.size() > 1)
    lines.push_back(
        {"force", "not computed for large sheets of soft hinges, nor for other cells than the design's"});
  return lines;
}

}  // namespace

std::string print_text(const PrintJob& job, const PathClearance& clearance,
                       const std::optional<SlicerAnswer>& slicer) {
  std::string out = job.sheet.name + "\n\n";
  for (const auto& [label, text] : print_lines(job, clearance, slicer))
    out += fmt::format("{:<12} {}\n", label, text);
  for (const std::string& warning : print_warnings(job)) out += fmt::format("{:<12} {}\n", "note", warning);
  return out;
}

ShortForm export_form(const PrintJob& job, const PathClearance& clearance,
                      const std::optional<SlicerAnswer>& slicer) {
  ShortForm out{.title = fmt::format("{}: exported for {}", job.sheet.name, job.sheet.process.name)};
  const std::vector<SummaryLine> all = print_lines(job, clearance, slicer);
  for (const char* label : {"pieces", "hinges", "force", "slicer", "tiles", "supports"})
    for (const SummaryLine& line : all)
      if (line[0] == label) out.lines.push_back(line);
  for (const std::string& warning : print_warnings(job)) out.problems.push_back({"warning", warning});
  return out;
}

std::string add_to_report(const std::string& design_file, const Design& design, const Json& print) {
  const fs::path folder = fs::path(design_file).parent_path(), file = folder / "report.html";
  std::error_code none;
  if (!fs::exists(file, none)) return {};
  const std::string page = targets::read_text_file(file.string(), largest_report);
  const std::string text = data_of_report(page);
  if (targets::find_too_deep(text)) return {};
  Json data = Json::parse(text, nullptr, false);
  if (!matches_sheet(data, design, digits_of_reports)) return {};
  data["print"] = print;
  FileSet files(folder.string());
  files.add("report.html", report_with(page, data.dump()));
  files.commit();
  return file.string();
}

}  // namespace kinetix::app
