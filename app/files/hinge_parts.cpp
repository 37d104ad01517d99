#include "app/files/hinge_parts.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "model/lattice/square/lines.hpp"
#include "targets/document/bound_key.hpp"

namespace kinetix::app {
namespace {

using PartPlace = HingePart::Place;

constexpr double least_lean = 1e-9;  // rad: smaller tilts are rounding

const char* line_word(const HingePart& part) { return part.place == PartPlace::column ? "column" : "row"; }

void read_place(const targets::Node& at, HingePart& part) {
  if (at.kind() != targets::Node::Kind::map) {
    at.one_of({"creases"});
    return;
  }
  const targets::Section line(at, hinge_line_keys());
  const bool is_column = line.optional("column").has_value();
  if (is_column == line.optional("row").has_value())
    throw at.error("names a part by one of `column: k` and `row: k`");
  part.place = is_column ? PartPlace::column : PartPlace::row;
  line.read(line_word(part), part.line);
}

std::vector<targets::Node> entries(const targets::Section& root) {
  const auto list = root.section("hinge").optional("except");
  return list
             ? list->list("a list of hinges that are made otherwise, e.g. `- {at: creases, kind: film, ...}`")
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
    if (std::abs(sheet.hinge(h).beta) > least_lean) out.push_back(h);
  return out;
}

std::vector<int> hinges_of_part(const model::Lattice& sheet, const HingePart& part) {
  if (part.place == PartPlace::creases) return leaning_hinges(sheet);
  const model::Structure* squares = sheet.squares();
  if (!squares) throw InvalidInput("only a sheet of squares has columns and rows; name single walls");
  const model::Axis axis = part.place == PartPlace::column ? model::Axis::x : model::Axis::y;
  const int count = line_count(*squares, axis);
  if (part.line >= count)
    throw InvalidInput(fmt::format("{} {} is not there; the sheet has {} 0 to {}", line_word(part), part.line,
                                   part.place == PartPlace::column ? "columns" : "rows", count - 1));
  return hinges_on_line(*squares, axis, part.line);
}

/// Returns the largest strain that the material of a block or film withstands; 0 for all other hinges.
double bearable_strain(const HingeSection& hinge) {
  const bool bends = hinge.made && hinge.made->kind != model::HingeKind::pin;
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
    if (hinges.empty()) throw at.error("names no hinge of this sheet: none leans");
    for (const int h : hinges) own[h] = part.hinge;
  }
  return own;
}

void refuse_lines(const targets::Section& root, const std::vector<HingePart>& parts) {
  const std::vector<targets::Node> all = entries(root);
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].place != PartPlace::creases)
      throw all[k].optional("at")->error(
          fmt::format("a {} is named in designs, whose columns are known; allowed in targets: creases",
                      line_word(parts[k])));
}

namespace value = targets::value;

std::vector<targets::Key> hinge_limit_keys(const std::string& instead, const targets::Default& usual_strain) {
  return {{"force_N", &HingeLimits::force_N, value::number(targets::above(0, "N")),
           "most that the drive may take on the way; " + instead},
          {"strain", &HingeLimits::strain, value::number({0, 10, false, true, {}}), usual_strain,
           "most that a hinge made as a block or film may be strained, likewise"}};
}

HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge,
                              const std::vector<HingePart>& parts) {
  HingeLimits limits;
  tolerance.read_into(limits);
  double most = bearable_strain(hinge);
  for (const HingePart& part : parts) most = std::max(most, bearable_strain(part.hinge));
  if (const auto strain = tolerance.optional("strain"); strain && most == 0)
    throw strain->key_error("applies to hinges made as blocks or films; give hinge.kind as well");
  if (limits.strain && *limits.strain > most)
    throw tolerance.optional("strain")->error(
        fmt::format("{:g} contradicts the material of `hinge`, which bears {:g}; allowed: up to that",
                    *limits.strain, most));
  return limits;
}

}  // namespace kinetix::app
