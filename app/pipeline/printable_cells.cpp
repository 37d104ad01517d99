#include <fmt/format.h>

#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

constexpr int most_changes = 6;              // of larger cells: with fewer cells, hinges turn and lean more
constexpr int most_changes_of_displays = 1;  // of those that stretch: their searches take seconds

bool is_refused(const SearchResult& found) { return found.print && !found.print->is_accepted; }

bool has_joints(const SearchResult& found) { return found.design.hinge.model == HingeSection::Model::rotary; }

/// Checks whether the file does not say how stiff hinges are.
bool has_usual_stiffness(const HingeSection& hinge) {
  return hinge == HingeSection{.model = hinge.model, .reach_mm = {}, .made = hinge.made, .kind = hinge.kind};
}

/// Checks whether hinges may be chosen after the search: joints, and panels in which no hinge stretches.
bool has_free_choice(const SearchResult& found) {
  const bool is_exact = found.known && found.known->model == Model::exact;
  return has_joints(found) || (is_exact && has_usual_stiffness(found.design.hinge));
}

/// Returns the design with all hinges left open. @pre has_free_choice(found), and the file leaves them open
Design open_design(const SearchResult& found) {
  Design out = requested_design(found);
  out.hinge.made.reset();
  out.hinge_overrides.clear();
  return out;
}

/// Returns the search with how its sheet is folded.
SearchResult with_folding(SearchResult found, const RunOptions& options) {
  options.progress("drive", -1);
  const SearchResult complete = planned(found, true);
  found.folding = find_folding(requested_design(complete), complete.plan.exact, options.stop);
  return found;
}

constexpr int most_fits =
    3;  // each round lengthens hinges by a few percent, until their gaps stay as they are

/// Fits hinges to the drive that folds them. Where hinges are soft the sheet lags behind a hinge that is turned, which
/// turns further than the exact motion does. Hinges are as long as that turn needs, and the print is that of `export`
/// with this drive.
SearchResult fitted_to_drive(SearchResult found, const RunOptions& options) {
  for (int k = 0; k < most_fits && !options.stop.stop_requested(); ++k) {
    if (!found.folding || !found.folding->drive || found.folding->turns_freely) return found;
    Design driven = open_design(found);
    if (!driven.drive) driven.drive = found.folding->drive;
    const PrintAnswer answer = options.printable(driven);
    const bool is_same = answer.made == found.print->made;
    found.print = answer;
    if (is_same || !answer.is_accepted) return found;
    found.design = with_manufactured_hinges(open_design(found), answer.made);
    found = with_folding(std::move(found), options);
  }
  return found;
}

/// Searches, and gives open joints the hinges that `export` would print. All that follows reads the design.
SearchResult searched(const Goal& goal, const RunOptions& options) {
  SearchResult found = goal.search(options);
  found.design.name = goal.name;
  if (!options.printable || !leaves_hinges_open(found.design) || options.stop.stop_requested()) return found;
  found.print = options.printable(requested_design(found));
  if (!found.print->is_accepted || !has_free_choice(found)) return found;
  found.design = with_manufactured_hinges(found.design, found.print->made);
  return has_pins_alone(found.design) && has_joints(found) ? with_folding(std::move(found), options) : found;
}

/// Checks the state that the search found. It does not depend on the hinges that were chosen after it.
bool meets_goal(Searched one, const RunOptions& options) {
  if (has_free_choice(one.found)) one.found.design = open_design(one.found);
  return held(std::move(one.found), one.goal.get(), options).met();
}

/// Goal with cells that its process can print.
struct Printable {
  Goal::Resized resized;
  Searched searched;
};

bool can_have_pins(const SearchResult& found) {
  const std::vector<model::HingeKind>& kinds = found.design.process.hinges;
  return std::find(kinds.begin(), kinds.end(), model::HingeKind::pin) != kinds.end();
}

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

/// Searches with other cells until they can be printed and the goal is met. Empty if that does not happen.
std::optional<Printable> find_printable(const Goal& goal, SearchResult found, const RunOptions& options) {
  std::optional<Goal::Resized> last;
  const int most = has_free_choice(found) ? most_changes : most_changes_of_displays;
  for (int k = 0; k < most && !options.stop.stop_requested(); ++k) {
    const std::optional<model::CellSize> size = find_next_size(found, options);
    if (!size) return std::nullopt;
    last = (last ? *last->goal : goal).resize(found.design.structure.size(), *size);
    if (!last) return std::nullopt;
    Searched one{last->goal, searched(*last->goal, options)};
    if (is_complete(one.found))
      return meets_goal(one, options) ? std::optional(Printable{*last, std::move(one)}) : std::nullopt;
    found = std::move(one.found);
  }
  return std::nullopt;
}

}  // namespace

Searched search_printable(const Goal& goal, const RunOptions& options) {
  Searched given{{std::shared_ptr<const Goal>{}, &goal}, searched(goal, options)};
  if (!given.found.print || !options.printable_size) return given;
  const bool is_worthwhile = !is_complete(given.found) && goal.resize && meets_goal(given, options);
  std::optional<Printable> other = is_worthwhile ? find_printable(goal, given.found, options) : std::nullopt;
  if (other && !other->resized.changes_given) {
    other->searched.found.notes.push_back("sizes that the process needs: " + other->resized.keys);
    return std::move(other->searched);
  }
  const std::string advice =
      other ? fmt::format("; with `{}` the goal is met and can be printed", other->resized.keys)
      : is_worthwhile && can_have_pins(given.found)
          ? "; larger cells and walls were searched, and none both prints with pins and meets the goal"
          : "";
  if (!is_refused(given.found) && has_joints(given.found) && !given.found.folding)
    given.found = fitted_to_drive(with_folding(std::move(given.found), options), options);
  given.found.print->advice = advice;
  return given;
}

}  // namespace kinetix::app
