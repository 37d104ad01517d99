#include "app/sweep/plan/edit.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "app/files/design_file.hpp"
#include "app/files/wall_node.hpp"
#include "app/sweep/plan/nearest_path.hpp"
#include "model/lattice/square/crease.hpp"
#include "model/lattice/square/lines.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {
namespace {

using Kind = Edit::Kind;

// Keys of a hinge that a path may end with.
constexpr std::pair<const char*, Kind> hinge_keys[] = {{"t", Kind::t},
                                                       {"t_mm", Kind::t_mm},
                                                       {"alpha_deg", Kind::alpha_deg},
                                                       {"beta_deg", Kind::beta_deg},
                                                       {"offset_mm", Kind::offset_mm}};

std::optional<Kind> hinge_key(const std::string& key) {
  for (const auto& [name, kind] : hinge_keys)
    if (key == name) return kind;
  return std::nullopt;
}

bool selects(const targets::PathStep& step, int position) {
  return step.position == targets::PathStep::every || step.position == position;
}

/// `design.GROUP[n].KEY` with a key of hinges.
bool is_hinge_path(const targets::DocumentPath& path, const char* group) {
  return path.size() == 4 && path[0].key == "design" && path[1].key == group && path[2].key.empty() &&
         hinge_key(path[3].key).has_value();
}

std::string entry(const targets::DocumentPath& path, int position) {
  return fmt::format("design.{}[{}].{}", path[1].key, position, path[3].key);
}

std::vector<Match> walls(const model::Sheet& structure, const targets::DocumentPath& path) {
  std::vector<Match> matches;
  for (int k = 0; k < structure.hinges(); ++k)
    if (selects(path[2], k)) matches.push_back({entry(path, k), {{*hinge_key(path[3].key), k}}});
  return matches;
}

/// Hinges by the column (axis x) or row (axis y) of their walls.
std::vector<Match> lines(const model::Structure& structure, const targets::DocumentPath& path,
                         model::Axis axis) {
  const Kind kind = *hinge_key(path[3].key);
  std::vector<Match> matches;
  const auto add = [&](int line) {
    Match match{entry(path, line), {}};
    for (const int k : hinges_on_line(structure, axis, line)) {
      const model::Wall& wall = structure.hinges[k].wall;
      const bool by_class = kind == Kind::t || kind == Kind::t_mm || kind == Kind::offset_mm;
      match.edits.push_back({kind, k, by_class ? starts_in_class_b(wall) : alternation(wall) < 0});
    }
    if (!match.edits.empty()) matches.push_back(std::move(match));
  };
  for (int line = 0; line < line_count(structure, axis); ++line)
    if (selects(path[2], line)) add(line);
  return matches;
}

/// Hinges that the file names, in its order.
std::vector<Match> named_hinges(const SweepBase& base, const targets::DocumentPath& path) {
  const auto section = base.root.optional("design");
  const auto list = section ? section->optional("hinges") : std::nullopt;
  std::vector<Match> matches;
  if (!list) return matches;
  const WallReader walls(base.design->structure);
  const auto entries = list->list("hinges");
  for (int n = 0; n < static_cast<int>(entries.size()); ++n) {
    if (!selects(path[2], n)) continue;
    const int hinge = walls.hinge_of(targets::Section(entries[n], hinge_entry_keys()));
    matches.push_back({entry(path, n), {{*hinge_key(path[3].key), hinge}}});
  }
  return matches;
}

std::vector<Match> structural(const SweepBase& base, const targets::DocumentPath& path) {
  if (!base.design || base.has_bodies()) return {};
  const model::Sheet& structure = base.design->structure;
  if (path == targets::parse_path("design.theta_deg")) return {{"design.theta_deg", {{Kind::theta_deg}}}};
  if (is_hinge_path(path, "walls")) return walls(structure, path);
  const model::Structure* squares = structure.squares();
  if (squares && is_hinge_path(path, "columns")) return lines(*squares, path, model::Axis::x);
  if (squares && is_hinge_path(path, "rows")) return lines(*squares, path, model::Axis::y);
  if (is_hinge_path(path, "hinges")) return named_hinges(base, path);
  return {};
}

bool is_optional_key(const SweepBase& base, const targets::DocumentPath& path) {
  const std::string text = to_string(path);
  for (const std::string& key : optional_keys(base))
    if (key == text) return true;
  return false;
}

/// As a file has it: 30, where the angle in radians gives 30.000000000000004.
double degrees_of(double radians) {
  const std::string text = targets::degrees_text(radians);
  double degrees = to_degrees(radians);
  std::from_chars(text.data(), text.data() + text.size(), degrees);
  return degrees;
}

const targets::Bounds& bounds_of(Kind kind) {
  static const targets::Bounds fraction = targets::between(0, 1),
                               in_plane = targets::between(0, 180, "degrees"),
                               tilt = targets::between(-90, 90, "degrees"),
                               offset = targets::between(-0.5, 0.5, "cell edges");
  if (kind == Kind::t || kind == Kind::t_mm) return fraction;
  if (kind == Kind::offset_mm) return offset;
  return kind == Kind::alpha_deg ? in_plane : tilt;
}

}  // namespace

std::vector<Match> find_matches(const SweepBase& base, targets::DocumentEditor& editor,
                                const targets::DocumentPath& path) {
  std::vector<Match> matches = structural(base, path);
  if (!matches.empty()) return matches;
  const auto items = is_optional_key(base, path) ? editor.find_or_add(path) : editor.find(path);
  for (const int item : items) matches.push_back({editor.path(item), {{Kind::document, item}}});
  if (matches.empty()) throw InvalidInput(no_such_path(base, editor, path));
  return matches;
}

std::optional<double> base_value(const SweepBase& base, const targets::DocumentEditor& editor,
                                 const Edit& edit) {
  if (edit.kind == Kind::document) return editor.number(edit.index);
  const Design& design = *base.design;
  if (edit.kind == Kind::theta_deg) return degrees_of(design.theta);
  const model::HingeParameters& p = design.structure.hinge(edit.index);
  switch (edit.kind) {
    case Kind::t:
      return edit.flipped ? 1 - p.t : p.t;
    case Kind::t_mm:
      return (edit.flipped ? 1 - p.t : p.t) * design.structure.size().edge_mm;
    case Kind::alpha_deg:
      return degrees_of(edit.flipped ? pi - p.alpha : p.alpha);
    case Kind::offset_mm:
      return (edit.flipped ? -p.offset : p.offset) * design.structure.size().edge_mm;
    default:
      return degrees_of(edit.flipped ? -p.beta : p.beta);
  }
}

void apply(const Edit& edit, double value, Design& design) {
  if (edit.kind == Kind::t_mm || edit.kind == Kind::offset_mm) value /= design.structure.size().edge_mm;
  const targets::Bounds& bounds = bounds_of(edit.kind);
  if (!bounds.contains(value))
    throw InvalidInput(fmt::format("{} is out of range; allowed: {}", value, bounds.describe()));
  if (edit.kind == Kind::theta_deg) {
    design.theta = targets::radians_of(value);
    return;
  }
  model::HingeParameters& p = design.structure.hinge(edit.index);
  switch (edit.kind) {
    case Kind::alpha_deg:
      p.alpha = edit.flipped ? pi - targets::radians_of(value) : targets::radians_of(value);
      break;
    case Kind::beta_deg:
      p.beta = edit.flipped ? -targets::radians_of(value) : targets::radians_of(value);
      break;
    case Kind::offset_mm:
      p.offset = edit.flipped ? -value : value;
      if (const auto why = why_offset_does_not_fit(design, edit.index)) throw InvalidInput(*why);
      break;
    default:
      p.t = edit.flipped ? 1 - value : value;
  }
}

}  // namespace kinetix::app
