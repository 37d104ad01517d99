#include <fmt/format.h>

#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

constexpr int most_changes = 6;              // of larger cells: with fewer cells, hinges turn and lean more
constexpr int most_changes_of_displays = 3;  // of those that stretch: their searches take seconds
// Ratio of cell edges from the second change on. Each search of a display finds other hinges. The size that the last
// ones need may just be too small for them.
constexpr double growth_of_displays = 1.1;
constexpr double nearest_edges = 1.05;  // ratio of cell edges: sizes between nearer ones are not searched

bool is_refused(const SearchResult& found) { return found.print && !found.print->is_accepted; }

bool has_joints(const SearchResult& found) { return found.design.hinge.model == HingeSection::Model::rotary; }

/// Checks whether the search leaves the drive open: in sheets of joints, and in panels of pins.
bool has_open_drive(const SearchResult& found) { return has_joints(found) || has_pins_alone(found.design); }

/// Checks whether the file does not say how stiff hinges are.
bool has_usual_stiffness(const HingeSection& hinge) {
  return hinge == HingeSection{.model = hinge.model, .reach_mm = {}, .made = hinge.made, .kind = hinge.kind};
}

/// Checks whether hinges may be chosen after the search: joints, and panels in which no hinge stretches.
bool has_free_choice(const SearchResult& found) {
  const bool is_exact = found.known && found.known->model == Model::exact;
  return has_joints(found) || (is_exact && has_usual_stiffness(found.design.hinge));
}

/// Checks whether the search counted on the stiffness of hinges, and the file does not say how they are made. No hinge
/// that is printed has the stiffness that it assumed.
bool needs_hinges(const SearchResult& found) {
  const bool depends = found.known && found.known->model == Model::equilibrium;
  return depends && has_usual_stiffness(found.design.hinge) && !has_joints(found);
}

/// Returns the design with all hinges left open. @pre has_free_choice(found), and the file leaves them open
Design open_design(const SearchResult& found) {
  Design out = requested_design(found);
  out.hinge.made.reset();
  out.hinge_overrides.clear();
  return out;
}

bool can_have_pins(const SearchResult& found) {
  const std::vector<model::HingeKind>& kinds = found.design.process.hinges;
  return std::find(kinds.begin(), kinds.end(), model::HingeKind::pin) != kinds.end();
}

/// Returns the search with how its sheet is folded.
SearchResult with_folding(SearchResult found, const RunOptions& options) {
  options.progress("drive", -1);
  const SearchResult complete = planned(found, true);
  found.folding = find_folding(requested_design(complete), complete.plan.exact, options.stop);
  return found;
}

constexpr int most_fits =
    6;  // each round lengthens hinges by a few percent, until their gaps stay as they are

/// Returns the design that a file of this search has, with the drive that folds it.
Design with_found_drive(Design design, const SearchResult& found) {
  if (!design.drive) design.drive = found.folding->drive;
  return design;
}

/// Fits hinges to the drive that folds them. Where hinges are soft the sheet lags behind a hinge that is turned, which
/// turns further than the exact motion does. Hinges are as long as that turn needs, and the print is that of `export`
/// with this drive.
SearchResult fitted_to_drive(SearchResult found, const RunOptions& options) {
  const auto has_drive = [&] {
    return found.folding && found.folding->drive && !found.folding->turns_freely;
  };
  for (int k = 0; k < most_fits && has_drive() && !options.stop.stop_requested(); ++k) {
    const PrintAnswer answer = options.printable(with_found_drive(open_design(found), found));
    const bool is_same = answer.made == found.print->made;
    found.print = answer;
    if (is_same || !answer.is_accepted) return found;
    found.design = with_manufactured_hinges(open_design(found), answer.made);
    found = with_folding(std::move(found), options);
  }
  // The last drive may turn further than the one that its hinges were made for.
  if (has_drive()) found.print = options.printable(with_found_drive(requested_design(found), found));
  return found;
}

/// Searches, and gives open joints the hinges that `export` would print. All that follows reads the design. Drives are
/// found at once for processes that cannot print pins, since hinges fit their drive.
SearchResult searched(const Goal& goal, const RunOptions& options) {
  SearchResult found = goal.search(options);
  found.design.name = goal.name;
  if (!options.printable || !leaves_hinges_open(found.design) || options.stop.stop_requested()) return found;
  if (needs_hinges(found)) {
    found.print =
        PrintAnswer{.hinges = {},
                    .why =
                        "hinges stretch in this design, so it depends on their stiffness, and the file does "
                        "not describe how "
                        "they are made: remove `variables.offset_mm`, so that no hinge stretches, or give "
                        "`hinge: {kind: block, ...}` with sizes"};
    return found;
  }
  found.print = options.printable(requested_design(found));
  if (!found.print->is_accepted || !has_free_choice(found)) return found;
  found.design = with_manufactured_hinges(found.design, found.print->made);
  if (!has_joints(found) || has_pins_alone(found.design)) return found;
  return can_have_pins(found) ? found : fitted_to_drive(with_folding(std::move(found), options), options);
}

/// Checks the state that the search found. It does not depend on the hinges that were chosen after it.
bool meets_goal(Searched one, const RunOptions& options) {
  if (has_free_choice(one.found)) one.found.design = open_design(one.found);
  return held(std::move(one.found), one.goal.get(), options).met();
}

/// Goal with cells that its process can print.
struct Printable {
  Goal::Changed resized;
  Searched searched;
};

/// Checks whether a search is complete: its hinges can be printed, and are pins or of the kind that the file or the
/// process leaves. Soft hinges are the second choice, since a drive seldom folds a whole sheet of them.
bool is_complete(const SearchResult& found) {
  const bool is_settled = !has_free_choice(found) || found.design.hinge.kind ||
                          has_pins_alone(found.design) || !can_have_pins(found);
  return !is_refused(found) && is_settled;
}

/// Finds cells that bring a search nearer to one that is complete, mm: those for pins first. Empty if there are none.
std::optional<model::CellSize> find_next_size(const SearchResult& found, const RunOptions& options) {
  Design design = has_free_choice(found) ? open_design(found) : requested_design(found);
  if (!has_free_choice(found) || design.hinge.kind || !can_have_pins(found))
    return options.printable_size(design);
  design.hinge.kind = model::HingeKind::pin;
  const std::optional<model::CellSize> size = options.printable_size(design);
  if (size || !is_refused(found)) return size;
  design.hinge.kind.reset();
  return options.printable_size(design);
}

double rounded_up_mm(double edge_mm) { return std::ceil(10 * edge_mm - 1e-9) / 10; }

/// Searches a goal with cells of another size. Empty if the goal cannot have such cells.
std::optional<Printable> search_resized(const Goal& goal, const model::CellSize& before,
                                        const model::CellSize& size, const RunOptions& options) try {
  const std::optional<Goal::Changed> resized = goal.resize(before, size);
  if (!resized) return std::nullopt;
  return Printable{*resized, {resized->goal, searched(*resized->goal, options)}};
} catch (const InvalidInput&) {
  return std::nullopt;  // too few cells for the goal, or too small ones for their walls
}

/// Searches with other cells until they can be printed and the goal is met. Where cells are so large that it is missed,
/// smaller ones are searched. Empty if none are found.
std::optional<Printable> find_printable(const Goal& goal, const SearchResult& given,
                                        const RunOptions& options) {
  std::optional<Printable> last;             // its cells are too small for the process
  std::optional<model::CellSize> too_large;  // for the goal
  std::optional<model::CellSize> next = find_next_size(given, options);
  const int most = has_free_choice(given) ? most_changes : most_changes_of_displays;
  for (int k = 0; k < most && next && !options.stop.stop_requested(); ++k) {
    const SearchResult& found = last ? last->searched.found : given;
    const model::CellSize before = found.design.structure.size();
    if (k > 0 && !has_joints(given))
      next->edge_mm = std::max(next->edge_mm, rounded_up_mm(growth_of_displays * before.edge_mm));
    if (too_large && !(next->edge_mm * nearest_edges < too_large->edge_mm)) {
      next = too_large;
      next->edge_mm = rounded_up_mm(std::sqrt(before.edge_mm * too_large->edge_mm));
    }
    if (too_large && !(before.edge_mm * nearest_edges < next->edge_mm)) return std::nullopt;
    std::optional<Printable> one = search_resized(last ? *last->resized.goal : goal, before, *next, options);
    if (one && !is_complete(one->searched.found)) {
      last = std::move(one);
      next = find_next_size(last->searched.found, options);
    } else if (one && meets_goal(one->searched, options)) {
      return one;
    } else {
      too_large = next;
    }
  }
  return std::nullopt;
}

/// Finds how a sheet is folded, and fits its hinges to that, if it can be printed and neither is known.
SearchResult complete_folding(SearchResult found, const RunOptions& options) {
  if (!found.print || is_refused(found) || !has_open_drive(found) || found.folding) return found;
  return fitted_to_drive(with_folding(std::move(found), options), options);
}

bool can_be_folded(const SearchResult& found) {
  return !is_refused(found) && (!found.folding || describe_effort(*found.folding) != "no");
}

/// Names pins as a change of the file if they fold the sheet and the soft hinges that it names do not. Empty if they were
/// not found to.
std::string advise_pins(const Goal& goal, const SearchResult& given, const RunOptions& options) try {
  const auto& kind = given.design.hinge.kind;
  if (is_refused(given) || can_be_folded(given) || !kind || is_pin(*kind) || !goal.change) return "";
  constexpr const char* pins = "{kind: pin}";
  const Goal::Changed changed = goal.change({{"hinge", pins}});
  const Searched other = search_printable(*changed.goal, options);
  if (!has_pins_alone(other.found.design) || !can_be_folded(other.found) || !meets_goal(other, options))
    return "";
  return fmt::format("; with `hinge: {}` (`--hinge pin`) the goal is met and it can be folded", pins);
} catch (const InvalidInput&) {
  return "";  // the goal allows no pins
}

}  // namespace

Searched search_printable(const Goal& goal, const RunOptions& options) {
  Searched given{{std::shared_ptr<const Goal>{}, &goal}, searched(goal, options)};
  if (!given.found.print || !options.printable_size) return given;
  const bool is_worthwhile =
      !is_complete(given.found) && !needs_hinges(given.found) && goal.resize && meets_goal(given, options);
  std::optional<Printable> other = is_worthwhile ? find_printable(goal, given.found, options) : std::nullopt;
  if (other) other->searched.found = complete_folding(std::move(other->searched.found), options);
  if (other && !other->resized.changes_given) {
    other->searched.found.notes.push_back("sizes that the process needs: " + other->resized.keys);
    other->searched.found.print->advice = advise_pins(goal, other->searched.found, options);
    return std::move(other->searched);
  }
  const std::string advice =
      other && can_be_folded(other->searched.found)
          ? fmt::format("; with `{}` the goal is met and can be printed", other->resized.keys)
      : is_worthwhile && can_have_pins(given.found)
          ? "; larger cells and walls were searched, and none both prints with pins and meets the goal"
      : is_worthwhile
          ? "; larger cells and walls were searched, and none both can be printed and meets the goal"
          : "";
  given.found = complete_folding(std::move(given.found), options);
  given.found.print->advice = advice.empty() ? advise_pins(goal, given.found, options) : advice;
  return given;
}

}  // namespace kinetix::app
