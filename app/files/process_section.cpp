#include "app/files/process_section.hpp"

#include <fmt/format.h>
#include <cmath>
#include <utility>

namespace kinetix::app {
namespace {

namespace value = targets::value;

// mm: from a single cell to a hall.
const targets::Bounds side_of_bed = targets::from_to(1, 1e5, "mm");
// mm: from foil to a block that needs another machine.
const targets::Bounds sheet_thickness = targets::from_to(0.01, 100, "mm");
const targets::Bounds cut_width = targets::from_to(0, 10, "mm");

// Words of the key `lock`.
constexpr targets::Word<LockKind> lock_choices[] = {
    {"none", LockKind::none}, {"clip", LockKind::clip}, {"strap", LockKind::strap}};

std::vector<std::string> process_names() {
  std::vector<std::string> names;
  for (const model::Process& process : model::processes()) names.push_back(process.name);
  return names;
}

std::string sd_meaning(double model::PrintError::*field, const char* what) {
  std::string text = std::string("standard deviation of ") + what + ", from hinge to hinge";
  for (const model::Process& p : model::processes())
    text += fmt::format("{} {} {}", &p == &model::processes().front() ? ":" : ",", p.name, p.sd.*field);
  return text;
}

const targets::KeyTable& sd_keys() {
  static const targets::KeyTable keys({
      {"t_mm", &model::PrintError::t_mm, value::number(targets::from_to(0, 10, "mm")),
       targets::otherwise("the process's"),
       sd_meaning(&model::PrintError::t_mm, "a hinge's position along its wall")},
      {"tilt_deg", &model::PrintError::tilt_deg, value::number(targets::from_to(0, 45, "degrees")),
       targets::otherwise("the process's"), sd_meaning(&model::PrintError::tilt_deg, "a wall's tilt")},
      {"clearance_mm", &model::PrintError::clearance_mm, value::number(targets::from_to(0, 10, "mm")),
       targets::otherwise("the process's"),
       sd_meaning(&model::PrintError::clearance_mm, "a pin's clearance")},
  });
  return keys;
}

/// Returns the key of a limit that differs between machines of a process. Processes without it have 0.
targets::Key limit_key(const char* name, double model::Process::*field, const char* what,
                       const targets::Bounds& bounds = {0, 100, false, true, "mm"}) {
  std::string text;
  for (const model::Process& p : model::processes())
    if (p.*field > 0) text += fmt::format("{} {} {}", text.empty() ? ":" : ",", p.name, p.*field);
  return {name, field, value::number(bounds), targets::otherwise("the process's"), what + text};
}

std::vector<std::string> material_choices() {
  std::vector<std::string> names;
  for (const model::Material& material : model::materials()) names.push_back(material.name);
  return names;
}

/// Returns the key of the material that walls and films are made of in one.
targets::Key one_material_key() {
  std::string text = "material of walls and living hinges that are made in one piece";
  bool is_first = true;
  for (const model::Process& p : model::processes())
    if (!p.film.empty())
      text += fmt::format("{} {} {}", std::exchange(is_first, false) ? ":" : ",", p.name, p.film);
  return {"material", value::choice(material_choices()), targets::otherwise("the process's"), text};
}

const targets::KeyTable& custom_process_keys() {
  static const targets::KeyTable keys({
      {"base", value::choice(process_names()), targets::by_default(process_names().front().c_str()),
       "process whose numbers are used for the keys that are omitted"},
      limit_key("clearance_mm", &model::Process::clearance_mm, "minimum clearance of a pin, per side"),
      limit_key("min_wall_mm", &model::Process::min_wall_mm, "minimum thickness of a wall")
          .formerly("least_wall_mm"),
      limit_key("min_pin_mm", &model::Process::min_pin_mm, "minimum diameter of a pin's rod")
          .formerly("least_pin_mm"),
      limit_key("min_film_mm", &model::Process::min_film_mm, "minimum width of a bridge in a cut sheet")
          .formerly("least_film_mm"),
      limit_key("sheet_mm", &model::Process::sheet_mm,
                "thickness of the sheet that is cut, which is the height of all walls. "
                "`structure.wall_mm.height` replaces it",
                sheet_thickness),
      limit_key("kerf_mm", &model::Process::kerf_mm, "width of the cut, for which the drawings compensate",
                cut_width),
      one_material_key(),
      targets::Key("std_dev", sd_keys(), "standard deviations of prints from the design").formerly("sd"),
  });
  return keys;
}

targets::Key key_of_process(const char* meaning) {
  return {"process", value::either({value::choice(process_names()), value::map(process_keys())}),
          targets::by_default(process_names().front().c_str()), meaning};
}

const model::Process& named(const targets::Node& node) {
  const std::vector<std::string> names = process_names();
  return model::processes()[node.one_of({names.begin(), names.end()})];
}

}  // namespace

const targets::KeyTable& process_keys() {
  static const targets::KeyTable keys(custom_process_keys().keys(), {}, "Section process");
  return keys;
}

targets::Key process_key() {
  return key_of_process(
      "printing process ([hinges.md](hinges.md)). The result estimates the effect of its print errors");
}

targets::Key design_process_key() {
  return key_of_process(
      "printing process for `export` ([print.md](print.md)). `export --process` replaces it");
}

targets::Key bed_key() {
  return {"bed_mm", value::list(value::number(side_of_bed), "`[x, y]`", 2, 2), targets::no_default,
          "bed of the printer, mm. A larger sheet is cut into tiles that join by hinges"};
}

std::string to_string(LockKind kind) {
  for (const auto& [name, value] : lock_choices)
    if (value == kind) return std::string(name);
  return {};
}

targets::Key lock_key() {
  return {
      "lock", value::choice(lock_choices), targets::no_default,
      "part that keeps the sheet folded ([print.md](print.md#6-staying-folded)). `clip`: a bar that is "
      "printed with the sheet and fits over two posts. `strap`: two eyes for a strap. If the key is omitted, "
      "a search chooses, and a design has none"};
}

std::optional<LockKind> read_lock(const targets::Section& root) {
  std::optional<LockKind> lock;
  root.read("lock", lock, lock_choices);
  return lock;
}

std::string process_text(const model::Process& process) {
  const model::Process& base = *model::find_process(process.name);
  if (process == base) return process.name;
  std::string own = custom_process_keys().text(process, base);
  if (process.film != base.film) own += fmt::format("{}material: {}", own.empty() ? "" : ", ", process.film);
  if (const std::string sd = sd_keys().text(process.sd, base.sd); !sd.empty())
    own += fmt::format("{}{}: {{{}}}", own.empty() ? "" : ", ",
                       custom_process_keys().at("std_dev").written_name(), sd);
  return fmt::format("{{base: {}, {}}}", process.name, own);
}

namespace {

/// Reads the keys of walls and hinges that are made in one. @throws InvalidInput for keys that the base does not have
/// @param process the base, whose material is replaced
void read_one_piece(const targets::Section& own, model::Process& process) {
  for (const char* key : {"sheet_mm", "kerf_mm", "min_film_mm"})
    if (const auto given = own.optional(key); given && !process.cuts_sheets())
      throw given->key_error(
          fmt::format("only applies to processes that cut sheets, and {} prints. Remove the key, or give "
                      "`base: laser`",
                      process.name));
  const auto material = own.optional("material");
  if (!material) return;
  if (process.film.empty())
    throw material->key_error(
        fmt::format("only applies to walls and living hinges that are made in one piece, which {} does not "
                    "print. Give `hinge.material` instead",
                    process.name));
  const std::vector<std::string> names = material_choices();
  process.film = names[material->one_of({names.begin(), names.end()})];
}

/// Returns a value of nested maps; empty if one is not given.
std::optional<targets::Node> nested(const targets::Node& root, std::initializer_list<const char*> keys) {
  std::optional<targets::Node> node = root;
  for (const char* key : keys) {
    if (node->kind() != targets::Node::Kind::map) return std::nullopt;
    node = node->optional(key);
    if (!node) return std::nullopt;
  }
  return node;
}

/// Makes the sheet as thick as the file's walls are high.
void follow_walls(const targets::Section& root, model::Process& process) {
  const auto height = nested(root.node(), {"structure", "wall_mm", "height"});
  if (!process.cuts_sheets() || !height) return;
  const double height_mm = height->number(sheet_thickness);
  if (nested(root.node(), {"process", "sheet_mm"}) && height_mm != process.sheet_mm)
    throw height->error(fmt::format(
        "differs from the thickness of the sheet, {:.4g} mm (process.sheet_mm), which is the height of its "
        "walls. Remove one of the two keys",
        process.sheet_mm));
  process.sheet_mm = height_mm;
}

model::Process read_limits(const targets::Section& root) {
  const auto node = root.optional("process");
  if (!node) return model::processes().front();
  if (node->kind() != targets::Node::Kind::map) return named(*node);
  const targets::Section own(*node, custom_process_keys());
  const auto base = own.optional("base");
  model::Process process = base ? named(*base) : model::processes().front();
  read_one_piece(own, process);
  own.read_into(process);
  own.read_into(process.sd);
  return process;
}

}  // namespace

model::Process read_process(const targets::Section& root) {
  model::Process process = read_limits(root);
  follow_walls(root, process);
  const auto bed = root.knows("bed_mm") ? root.optional("bed_mm") : std::nullopt;
  if (!bed) return process;
  const auto sides = bed->list_of(2, "[x, y] in mm");
  process.bed_mm = {sides[0].number(side_of_bed), sides[1].number(side_of_bed)};
  process.is_bed_given = true;
  return process;
}

std::optional<double> open_wall_height_mm(const targets::Node& root) {
  const auto named_in_map = nested(root, {"process", "base"}), process = nested(root, {"process"}),
             sheet = nested(root, {"process", "sheet_mm"});
  const auto name = named_in_map ? named_in_map : process;
  if (!name || name->kind() != targets::Node::Kind::scalar) return std::nullopt;
  const model::Process* base = model::find_process(name->text("a process"));
  if (!base || !base->cuts_sheets() || nested(root, {"structure", "wall_mm", "height"})) return std::nullopt;
  return sheet ? sheet->number(sheet_thickness) : base->sheet_mm;
}

}  // namespace kinetix::app
