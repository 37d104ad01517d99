#include "app/files/hinge_section.hpp"

#include <fmt/format.h>
#include <cmath>

#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Model = HingeSection::Model;
using model::HingeKind, model::ManufacturedHinge;

// Words of the key `model`.
constexpr targets::Word<Model> models[] = {{"rotary", Model::rotary}, {"elastic", Model::elastic}};
// Words of the key `kind`.
constexpr targets::Word<HingeKind> kinds[] = {
    {"pin", HingeKind::pin}, {"block", HingeKind::block}, {"film", HingeKind::film}, {"rod", HingeKind::rod}};

constexpr double default_clearance_mm = 0.3;  // mm per side: of FDM, the widest in general use
constexpr const char* default_pin = "pa12";   // a material that rods are printed in
constexpr const char* default_rod = "steel";  // wire
// Ranges of a made hinge, far beyond practical values.
const targets::Bounds modulus = targets::from_to(1e-6, 1e7, "MPa");
const targets::Bounds poisson = {0, 0.5, true, false, {}};
const targets::Bounds strain = {0, 10, false, true, {}};

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const model::Material& material : model::materials()) names.push_back(material.name);
  return names;
}

const targets::KeyTable& material_keys() {
  static const targets::KeyTable keys({
      {"E_mpa", &model::Material::E_mpa, value::number(modulus), targets::needed_as("a modulus in MPa"),
       "Young's modulus"},
      {"nu", &model::Material::nu, value::number(poisson), targets::needed_as("Poisson's ratio"),
       "Poisson's ratio"},
      {"strain_max", &model::Material::strain_max, value::number(strain), targets::needed_as("a strain"),
       "largest strain that the material withstands repeatedly"},
  });
  return keys;
}

const targets::KeyTable& stiffness_keys() {
  using Stiffness = model::HingeStiffness;
  const auto newtons = value::number(targets::above(0, "N/mm")),
             moments = value::number(targets::above(0, "N mm/rad"));
  const auto force = targets::needed_as("a stiffness in N/mm");
  static const targets::KeyTable keys({
      {"axial", &Stiffness::axial, newtons, force, "along the wall, across the hinge's axis"},
      {"shear", &Stiffness::shear, newtons, force, "across the wall and the axis"},
      {"along", &Stiffness::along, newtons, force, "along the axis"},
      {"turn", &Stiffness::turn, moments, targets::needed_as("a stiffness in N mm/rad"), "about the axis"},
      {"rock", &Stiffness::rock, moments, targets::otherwise("axial times `reach_mm` squared"),
       "about the direction across the wall and the axis"},
      {"twist", &Stiffness::twist, moments, targets::otherwise("shear times `reach_mm` squared"),
       "about the wall's own direction"},
  });
  return keys;
}

std::string material_meaning() {
  std::string text = "material of a hinge with a `kind`:";
  for (const model::Material& m : model::materials())
    text += fmt::format("{} `{}` {:g} MPa, nu {:g}, strain {:g}",
                        &m == &model::materials().front() ? "" : ";", m.name, m.E_mpa, m.nu, m.strain_max);
  return text + "; or a custom material";
}

std::vector<targets::Key> stiffness_and_shape() {
  static const HingeSection usual{};
  return {
      {"k_point", &HingeSection::k_point, value::number(targets::above(0, "N/mm")),
       "stiffness against joint separation, in every direction, of each of two points on the axis at "
       "`reach_mm` to either side. `k_point: N` equals `k: {axial: 2 N, shear: 2 N, along: 2 N}`"},
      {"k_turn", value::number(targets::at_least(0, "N mm/rad")), targets::by_default(usual.k_turn),
       "rotation stiffness. Elastic hinges need a value above 0"},
      {"k", stiffness_keys(),
       "stiffness of the whole hinge in the directions of its frame. It replaces `k_point` and `k_turn`"},
      {"reach_mm", &HingeSection::reach_mm,
       value::length(targets::from_to(0.01, 10, "mm (0.01 to 10 cells)")),
       targets::otherwise(
           "0.18 cells; with a `kind` the hinge's height over the root of 12, and half its height with "
           "`play`"),
       "half the distance of the two points at which a hinge joins its bodies. It sets the stiffness against "
       "bending and torsion"},
      {"kind", value::choice(kinds), targets::no_default,
       "type of hinge, which determines its stiffness ([hinges](hinges.md)). `pin`: a print-in-place pin in "
       "knuckles. `block`: rubber in the gap between the halves of the wall. `film`: a living hinge over the "
       "gap. `rod`: a pin whose rod is a separate part or a wire, pushed in after printing. If `kind` is the "
       "only key, hinges are computed as revolute joints and get the sizes that the process needs"},
      {"material", value::either({value::choice(material_names()), value::map(material_keys())}),
       targets::otherwise(fmt::format("needed by `block` and `film`; `{}` for a pin, `{}` for a rod",
                                      default_pin, default_rod)),
       material_meaning()},
      {"gap_mm", &ManufacturedHinge::gap_mm,
       value::length(targets::between(0, 1, "mm (below the cell edge)")),
       targets::otherwise("needed by `block` and `film`"),
       "length of a block or living hinge along the wall"},
      {"thickness_mm", value::number(targets::above(0, "mm")),
       targets::otherwise("the wall's; needed by `film`"),
       "thickness of a block or living hinge, at most that of the wall"},
      {"height_mm", value::number(targets::above(0, "mm")), targets::otherwise("the wall's"),
       "height of the hinge along its axis, at most that of the wall"},
      {"diameter_mm", &ManufacturedHinge::diameter_mm,
       value::length(targets::between(0, 0.5, "mm (below half a cell)")),
       targets::otherwise(fmt::format("needed by pins; {:g} mm for a rod", model::usual_rod_mm)),
       "diameter of a pin's rod. Its knuckle is wider by 1.6 mm and two clearances, at most 0.7 cells"},
      {"clearance_mm", &ManufacturedHinge::clearance_mm,
       value::length({0, 0.5, true, false, "mm (below half a cell)"}),
       targets::by_default(default_clearance_mm), "clearance between rod and bore of a pin, per side"},
      {"play", &ManufacturedHinge::with_play, value::boolean(),
       "whether a pin moves freely within its clearance. Nothing resists in this dead band, so the "
       "equilibrium of a sheet is not unique"},
      targets::Key("round_caps", &ManufacturedHinge::caps, value::boolean(),
                   "whether all pins get identical round caps. They fit the largest offset and hide the axes")
          .formerly("caps"),
  };
}

std::vector<targets::Key> keys_with(targets::Key model) {
  std::vector<targets::Key> keys = stiffness_and_shape();
  keys.insert(keys.begin(), std::move(model));
  keys.push_back({"k_contact", &HingeSection::k_contact, value::number(targets::above(0, "N/mm")),
                  targets::otherwise("10 `k_point`, or 5 times the largest stiffness of `k` or of a `kind`; "
                                     "of several hinges the stiffest counts"),
                  "stiffness of two walls pressed together"});
  return keys;
}

constexpr int max_lines = 1000000;  // lines of a sheet: more than fit in a file

targets::Key except_key() {
  return {
      "except", value::list(value::map(hinge_part_keys()), "a list of exceptions", 0), targets::no_default,
      "hinges that differ from the rest, such as a living hinge along a crease in a panel of pins. If two "
      "entries name the same hinge, the later one counts"};
}

/// Checks that a file gives a hinge in one way only.
void check_stiffness_keys(const targets::Section& section) {
  const auto refuse = [&](const char* way, std::initializer_list<const char*> others) {
    if (!section.optional(way)) return;
    for (const char* key : others)
      if (const auto node = section.optional(key))
        throw node->key_error(
            fmt::format("cannot be combined with hinge.{}, which also sets the stiffness. Remove one of the "
                        "two keys",
                        way));
  };
  refuse("kind", {"k_point", "k_turn", "k", "reach_mm"});
  refuse("k", {"k_point", "k_turn"});
  if (section.optional("kind")) return;
  for (const char* key : {"material", "gap_mm", "thickness_mm", "height_mm", "diameter_mm", "clearance_mm",
                          "play", "round_caps"})
    if (const auto node = section.optional(key))
      throw node->key_error(
          "only applies to a hinge with a `kind`. Add `kind: pin`, `block`, `film` or `rod`, or remove the "
          "key");
}

model::Material read_material(const targets::Node& node) {
  if (node.kind() != targets::Node::Kind::map) {
    const std::vector<std::string> names = material_names();
    return model::materials()[node.one_of({names.begin(), names.end()})];
  }
  const targets::Section own(node, material_keys());
  model::Material material{.name = ""};
  own.read_into(material);
  return material;
}

/// Checks that no key belongs to another kind. @throws InvalidInput for such a key
void check_kind(const targets::Section& section, HingeKind kind) {
  const auto refuse = [&](std::initializer_list<const char*> keys, const char* why) {
    for (const char* key : keys)
      if (const auto node = section.optional(key)) throw node->key_error(why);
  };
  if (is_pin(kind))
    refuse({"gap_mm", "thickness_mm"},
           "only applies to blocks and living hinges. Remove the key, or change `kind`");
  else
    refuse({"diameter_mm", "clearance_mm", "play", "round_caps"},
           "only applies to pins and rods. Remove the key, or change `kind`");
}

/// Checks that the lengths that the kind needs are given.
void check_lengths(const targets::Section& section, HingeKind kind) {
  if (kind == HingeKind::rod) return;
  section.node().required(kind == HingeKind::pin ? "diameter_mm" : "gap_mm", "a length in mm");
  if (kind == HingeKind::film) section.node().required("thickness_mm", "a length in mm");
}

/// Checks a made hinge. The message of validate() begins with the field. If the file gives that key, the error is at
/// the key and does not repeat the name.
void check_manufactured_hinge(const targets::Section& section, const model::ManufacturedHinge& hinge,
                              const model::CellSize& size) {
  try {
    validate(hinge, size);
  } catch (const InvalidInput& e) {
    const std::string field = e.reason().substr(0, e.reason().find(' '));
    const auto node = section.knows(field) ? section.optional(field) : std::nullopt;
    throw node ? node->error(e.reason().substr(field.size() + 1)) : section.error(e.reason());
  }
}

model::ManufacturedHinge read_manufactured_hinge(const targets::Section& section,
                                                 const model::CellSize& size) {
  model::ManufacturedHinge hinge;
  section.read("kind", hinge.kind, kinds);
  check_kind(section, hinge.kind);
  if (const auto material = section.optional("material"))
    hinge.material = read_material(*material);
  else if (is_pin(hinge.kind))
    hinge.material = *model::find_material(hinge.kind == HingeKind::rod ? default_rod : default_pin);
  else
    section.node().required("material", "a name or {E_mpa: ..., nu: ..., strain_max: ...}");
  hinge.height_mm = size.height_mm;
  section.read("height_mm", hinge.height_mm, {0, size.height_mm, false, true, "mm (the wall's)"});
  check_lengths(section, hinge.kind);
  if (hinge.kind == HingeKind::rod) hinge.diameter_mm = model::usual_rod_mm;
  if (is_pin(hinge.kind))
    hinge.clearance_mm = default_clearance_mm;
  else
    hinge.thickness_mm = size.thickness_mm;
  section.read("thickness_mm", hinge.thickness_mm, {0, size.thickness_mm, false, true, "mm (the wall's)"});
  section.read_into(hinge, size.edge_mm);
  check_manufactured_hinge(section, hinge, size);
  return hinge;
}

/// Reads all of the section except the model.
HingeSection read_stiffness_or_shape(const targets::Section& section, const model::CellSize& size,
                                     HingeSection hinge) {
  check_stiffness_keys(section);
  section.read(
      "k_turn", hinge.k_turn,
      hinge.model == Model::elastic ? targets::above(0, "N mm/rad") : targets::at_least(0, "N mm/rad"));
  section.read_into(hinge, size.edge_mm);
  if (const auto k = section.section("k"); k.given()) k.read_into(hinge.k.emplace());
  if (section.optional("kind")) hinge.made = read_manufactured_hinge(section, size);
  return hinge;
}

HingeSection read_section(const targets::Section& root, const model::CellSize& size, HingeSection hinge) {
  if (const auto kind = read_open_kind(root)) {
    hinge.kind = kind;
    return hinge;
  }
  const targets::Section section = root.section("hinge");
  const bool has_parts = section.knows("except") && section.optional("except");
  if (section.optional("kind") || section.optional("k") || has_parts) hinge.model = Model::elastic;
  if (const auto node = section.optional("model")) hinge.model = read_word(*node, models);
  if (hinge.model == Model::rotary && has_parts)
    throw section.optional("model")->error(
        "`rotary` hinges cannot stretch, and `except` lists hinges that do. Give `model: elastic`");
  return read_stiffness_or_shape(section, size, hinge);
}

std::string text(double number) { return targets::shortest_text(number); }

std::string material_text(const model::Material& m) {
  if (!m.name.empty()) return m.name;
  return "{" + material_keys().text(m) + "}";
}

std::string format_manufactured_hinge(const model::ManufacturedHinge& h) {
  const std::string start =
      fmt::format("kind: {}, material: {}, ", to_string(h.kind), material_text(h.material));
  const std::string shape =
      is_pin(h.kind)
          ? fmt::format("diameter_mm: {}, clearance_mm: {}", text(h.diameter_mm), text(h.clearance_mm))
          : fmt::format("gap_mm: {}, thickness_mm: {}", text(h.gap_mm), text(h.thickness_mm));
  return start + shape + ", height_mm: " + text(h.height_mm) + (h.with_play ? ", play: true" : "") +
         (h.caps ? ", " + single_hinge_keys().at("round_caps").written_name() + ": true" : "");
}

std::string stiffness_text(const HingeSection& hinge) {
  if (!hinge.k) return fmt::format("k_point: {}, k_turn: {}", text(hinge.k_point), text(hinge.k_turn));
  return "k: {" + stiffness_keys().text(*hinge.k) + "}";
}

}  // namespace

std::optional<model::HingeStiffness> framed_stiffness(const HingeSection& hinge) {
  return hinge.made ? stiffness(*hinge.made) : hinge.k;
}

const targets::KeyTable& hinge_keys() {
  static const targets::KeyTable keys(
      [] {
        std::vector<targets::Key> all = keys_with(
            {"model", value::choice(models),
             targets::otherwise("`rotary`; `elastic` with `k`, `kind` or `except`, here or at a wall"),
             "`rotary`: revolute joints that cannot stretch. `elastic`: joints with the stiffnesses below"});
        all.push_back(except_key());
        return all;
      }(),
      {}, "Section hinge");
  return keys;
}

targets::KeyTable elastic_hinge_keys() {
  return targets::KeyTable(keys_with({"model", value::choice({"elastic"}), targets::by_default("elastic"),
                                      "joints with the stiffnesses below"}));
}

const targets::KeyTable& single_hinge_keys() {
  static const targets::KeyTable keys(stiffness_and_shape());
  return keys;
}

const targets::KeyTable& hinge_line_keys() {
  static const targets::KeyTable keys(
      {{"column", value::integer(0, max_lines), {}, "for squares: the walls along x of this column"},
       {"row", value::integer(0, max_lines), {}, "for squares: the walls along y of this row"}});
  return keys;
}

const targets::KeyTable& hinge_part_keys() {
  static const targets::KeyTable keys([] {
    std::vector<targets::Key> all = stiffness_and_shape();
    all.insert(all.begin(), {"at", value::either({value::choice({"creases"}), value::map(hinge_line_keys())}),
                             targets::needed,
                             "`creases`: all tilted hinges. In designs of squares also a column or a row"});
    return all;
  }());
  return keys;
}

std::optional<model::HingeKind> read_open_kind(const targets::Section& root) {
  const targets::Section section = root.section("hinge");
  if (!section.given() || !section.optional("kind")) return std::nullopt;
  for (const std::string_view key : hinge_keys().names())
    if (key != "kind" && section.knows(key) && section.optional(key)) return std::nullopt;
  HingeKind kind{};
  section.read("kind", kind, kinds);
  return kind;
}

HingeSection read_hinge_section(const targets::Section& root, const model::CellSize& size) {
  return read_section(root, size, {});
}

HingeSection read_elastic_hinge_section(const targets::Section& root, const model::CellSize& size) {
  const HingeSection hinge = read_section(root, size, {.model = Model::elastic, .reach_mm = {}});
  if (hinge.model == Model::rotary)
    throw root.section("hinge").optional("model")->error(
        "`rotary` hinges cannot stretch, which this goal needs. Give `model: elastic`");
  return hinge;
}

HingeSection read_single_hinge(const targets::Section& section, const model::CellSize& size) {
  return read_stiffness_or_shape(section, size, {.model = Model::elastic, .reach_mm = {}});
}

std::string offset_limit_text(const model::ManufacturedHinge& hinge, const model::CellSize& size) {
  return fmt::format(
      "this kind of hinge fits in walls of {:.4g} mm at most {:.3g} mm off their middle. Give a "
      "smaller offset, or thicker walls",
      size.thickness_mm, largest_offset_mm(hinge, size));
}

std::string hinge_text(const HingeSection& hinge) {
  const std::string reach = hinge.reach_mm ? ", reach_mm: " + text(*hinge.reach_mm) : "";
  return hinge.made ? format_manufactured_hinge(*hinge.made) : stiffness_text(hinge) + reach;
}

namespace {

using PartPlace = HingePart::Place;

constexpr double min_lean = 1e-9;  // rad: smaller tilts are rounding

const char* line_name_of_place(const HingePart& part) {
  return part.place == PartPlace::column ? "column" : "row";
}

void read_place(const targets::Node& at, HingePart& part) {
  if (at.kind() != targets::Node::Kind::map) {
    at.one_of({"creases"});
    return;
  }
  const targets::Section line(at, hinge_line_keys());
  const bool is_column = line.optional("column").has_value();
  if (is_column == line.optional("row").has_value())
    throw at.error("the part is not clear. Give either `column: k` or `row: k`");
  part.place = is_column ? PartPlace::column : PartPlace::row;
  line.read(line_name_of_place(part), part.line);
}

std::vector<targets::Node> entries(const targets::Section& root) {
  const auto list = root.section("hinge").optional("except");
  return list ? list->list("a list of exceptions, e.g. `- {at: creases, kind: film, ...}`")
              : std::vector<targets::Node>{};
}

HingePart read_part(const targets::Node& node, const model::CellSize& size) {
  const targets::Section entry(node, hinge_part_keys());
  HingePart part;
  read_place(entry.required("at", "creases, {column: k} or {row: k}"), part);
  part.hinge = read_single_hinge(entry, size);
  return part;
}

std::vector<int> leaning_hinges(const model::Lattice& sheet) {
  std::vector<int> out;
  for (int h = 0; h < sheet.hinges(); ++h)
    if (std::abs(sheet.hinge(h).beta) > min_lean) out.push_back(h);
  return out;
}

std::vector<int> hinges_of_part(const model::Lattice& sheet, const HingePart& part) {
  if (part.place == PartPlace::creases) return leaning_hinges(sheet);
  const model::Structure* squares = sheet.squares();
  if (!squares) throw InvalidInput("only a sheet of squares has columns and rows. List single walls instead");
  const model::Axis axis = part.place == PartPlace::column ? model::Axis::x : model::Axis::y;
  const int count = line_count(*squares, axis);
  if (part.line >= count)
    throw InvalidInput(fmt::format("the sheet has no {} {}. Give one of the {} 0 to {}",
                                   line_name_of_place(part), part.line,
                                   part.place == PartPlace::column ? "columns" : "rows", count - 1));
  return hinges_on_line(*squares, axis, part.line);
}

/// Returns the largest strain that the material of a block or film withstands; 0 for all other hinges.
double bearable_strain(const HingeSection& hinge) {
  const bool bends = hinge.made && !is_pin(hinge.made->kind);
  return bends ? hinge.made->material.strain_max : 0;
}

}  // namespace

const HingeSection& hinge_at(const HingeSection& common, const std::map<int, HingeSection>& own, int hinge) {
  const auto at = own.find(hinge);
  return at == own.end() ? common : at->second;
}

std::vector<HingePart> read_hinge_parts(const targets::Section& root, const model::CellSize& size) {
  std::vector<HingePart> parts;
  for (const targets::Node& entry : entries(root)) parts.push_back(read_part(entry, size));
  return parts;
}

std::map<int, HingeSection> hinge_overrides_of(const model::Lattice& sheet,
                                               const std::vector<HingePart>& parts) {
  std::map<int, HingeSection> own;
  for (const HingePart& part : parts)
    for (const int h : hinges_of_part(sheet, part)) own[h] = part.hinge;
  return own;
}

std::map<int, HingeSection> read_hinge_overrides(const targets::Section& root, const model::Lattice& sheet) {
  std::map<int, HingeSection> own;
  for (const targets::Node& entry : entries(root)) {
    const HingePart part = read_part(entry, sheet.size());
    const targets::Node at = *entry.optional("at");
    std::vector<int> hinges;
    at.located([&] { hinges = hinges_of_part(sheet, part); });
    if (hinges.empty()) throw at.error("no hinge of this sheet is tilted. Remove the entry");
    for (const int h : hinges) own[h] = part.hinge;
  }
  return own;
}

void refuse_lines(const targets::Section& root, const std::vector<HingePart>& parts) {
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].place != PartPlace::creases)
      throw entries(root)[k].optional("at")->error(fmt::format(
          "only a design has a known {}. Give `creases` in a target", line_name_of_place(parts[k])));
}

std::vector<targets::Key> hinge_limit_keys(const std::string& instead,
                                           const targets::Default& default_strain) {
  return {{"force_N", &HingeLimits::force_N, value::number(targets::above(0, "N")),
           "limit of the drive's force over the whole motion. " + instead},
          {"strain", &HingeLimits::strain, value::number({0, 10, false, true, {}}), default_strain,
           "limit of the strain of a block or living hinge over the whole motion"}};
}

HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge,
                              const std::vector<HingePart>& parts) {
  HingeLimits limits;
  tolerance.read_into(limits);
  double most = bearable_strain(hinge);
  for (const HingePart& part : parts) most = std::max(most, bearable_strain(part.hinge));
  if (const auto strain = tolerance.optional("strain"); strain && most == 0)
    throw strain->key_error(
        "only applies to blocks and living hinges. Add `hinge: {kind: block, ...}` or `film`, or remove the "
        "key");
  if (limits.strain && *limits.strain > most)
    throw tolerance.optional("strain")->error(fmt::format(
        "{:g} is more than the material of `hinge` withstands. Give at most {:g}", *limits.strain, most));
  return limits;
}

}  // namespace kinetix::app
