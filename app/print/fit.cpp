#include "app/print/fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

#include "app/print/folding_card.hpp"
#include "app/print/sheet/lock.hpp"
#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

constexpr double largest_scale = 100;    // times the sheet: walls of millimetres would be too thin in it
constexpr double step_mm = 0.5;          // mm: cell edges are proposed in whole steps
constexpr double growth = 1.3;           // factor from one tried cell edge to the next, until one fits
constexpr double reported_size = 0.005;  // relative change of size: less is rounding to three digits.
// Heights of pins over their wall's, tried in this order: higher pins are stiffer.
constexpr double lower_shares[] = {0.8, 0.6, 0.4};

std::string named(const PrintSheet& sheet, const LeastDistance& d) {
  return fmt::format("bodies {} and {}", part_name(sheet, d.first), part_name(sheet, d.second));
}

/// Describes parts that come too near: from which fold angle on, and how near.
std::string words(const PrintSheet& sheet, const PathClearance& clearance) {
  const LeastDistance &first = *clearance.first_violation, &least = clearance.least();
  const std::string what = first.required_mm > 0
                               ? fmt::format("come nearer to each other than {:g} mm", first.required_mm)
                               : "run into each other";
  const std::string deepest =
      least.mm > 0 ? fmt::format("; {} are within {:.3f} mm", named(sheet, least), least.mm)
      : first.mm > 0 || first.required_mm > 0 ? fmt::format("; {} run into each other", named(sheet, least))
                                              : "; most of all " + named(sheet, least);
  return fmt::format(
      "{} {} from a fold angle of {:.1f} deg on, near [{:.1f}, {:.1f}, {:.1f}] mm{} at {:.1f} deg",
      named(sheet, first), what, to_degrees(first.theta), first.place.x(), first.place.y(), first.place.z(),
      deepest, to_degrees(least.theta));
}

/// Sheet that can be printed, or the reason why there is none.
struct Attempt {
  std::optional<PreparedPrint> print;
  std::string reason;
  bool is_bed_too_small = false;  // larger cells make that worse
};

/// Design to print, with its path to the fold.
struct Order {
  const Design& design;
  const model::Process& process;
  bool folded;
  PrintPath path = print_path(design);
};

/// Makes a sheet and checks its path. @param look with `least` the reason names the parts that come too near
Attempt attempt(const Order& order, const PrintChoice& choice, ClearanceSearch search) {
  try {
    PrintSheet sheet = make_print_sheet(order.design, order.path, order.process, choice);
    const PathClearance clearance = path_clearance(sheet, search);
    if (has_required_clearance(clearance))
      return {PreparedPrint{{std::move(sheet), order.folded}, clearance}, ""};
    return {std::nullopt, search == ClearanceSearch::least ? words(sheet, clearance) : ""};
  } catch (const BedTooSmall& e) {
    return {std::nullopt, e.reason(), true};
  } catch (const InvalidInput& e) {
    return {std::nullopt, e.reason()};
  }
}

/// Returns the first hinge whose axis leans; empty without.
std::optional<int> first_leaning_hinge(const Design& design) {
  const model::Linkage linkage(design.structure);
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h)
    if (!is_vertical(linkage.hinges[h])) return h;
  return std::nullopt;
}

/// Checks that a process that cuts flat sheets can make the design in some size. @param kinds tried for open hinges
/// @throws NotPrintable for walls that lean, and for hinges that are not living hinges
void check_cuttable(const Design& design, const model::Process& process,
                    std::vector<model::HingeKind> kinds) {
  if (!process.cuts_sheets()) return;
  if (const auto hinge = first_leaning_hinge(design)) {
    const model::HingeParameters& at = design.structure.hinge(*hinge);
    throw NotPrintable(fmt::format(
        "{} cuts flat sheets with upright walls, and wall {} is tilted (alpha {:.3g}, tilt {:.3g} degrees). "
        "Print the sheet instead (--process fdm), or design a panel such as `kind: outline`",
        process.name, wall_name(design.structure, *hinge), to_degrees(at.alpha), to_degrees(at.beta)));
  }
  if (!leaves_hinges_open(design)) kinds.clear();
  for (const model::ManufacturedHinge& made : manufactured_hinges(design)) kinds.push_back(made.kind);
  for (const model::HingeKind kind : kinds)
    if (kind != model::HingeKind::film)
      throw NotPrintable(fmt::format(
          "{} cuts walls and hinges in one piece, and the hinges are {}s. Make them bridges (`hinge: {{kind: "
          "film}}`, or leave them open), or print the sheet instead (--process fdm)",
          process.name, to_string(kind)));
}

bool has_leaning_hinges(const Design& design) { return !all_vertical(model::Linkage(design.structure)); }

/// Returns other choices for hinges that the design leaves open. Leaning pins may be lower. Elastomer and living
/// hinges may each be as long as needed.
std::vector<PrintChoice> others(const Design& design, const PrintChoice& choice) {
  std::vector<PrintChoice> all;
  if (!leaves_hinges_open(design)) return all;
  if (!is_pin(choice.kind)) {
    all.push_back(choice);
    all.back().alike = false;
  } else if (has_leaning_hinges(design)) {
    for (const double share : lower_shares) {
      all.push_back(choice);
      all.back().height_share = share;
    }
  }
  return all;
}

/// Makes the sheet by the first choice that leaves clearance. On failure the reason is that of the choice itself.
Attempt best_attempt(const Order& order, const PrintChoice& choice,
                     ClearanceSearch search = ClearanceSearch::least) {
  Attempt first = attempt(order, choice, search);
  if (first.print || first.is_bed_too_small) return first;
  const bool is_verdict = search == ClearanceSearch::verdict;
  for (const PrintChoice& other : others(order.design, choice)) {
    Attempt found = attempt(order, other, is_verdict ? search : ClearanceSearch::until_violation);
    if (found.print) return found;
  }
  return first;
}

/// Adds the lock that the design names. @throws LockDoesNotFit
PreparedPrint with_lock(PreparedPrint print, const Design& design, ClearanceSearch search) try {
  if (!design.lock || *design.lock == LockKind::none) return print;
  add_lock(print.job.sheet, *design.lock);
  if (search == ClearanceSearch::least) print.clearance = path_clearance(print.job.sheet);
  return print;
} catch (const InvalidInput& e) {
  throw LockDoesNotFit(e.reason());
}

/// Checks whether there is a print, with room for the lock that the design names.
bool has_room(Attempt found, const Design& design) try {
  if (!found.print) return false;
  with_lock(std::move(*found.print), design, ClearanceSearch::verdict);
  return true;
} catch (const NotPrintable&) {
  return false;
}

/// Returns a cell edge that fits, mm; empty: none up to largest_scale. It is the refused one if larger walls are enough.
/// Otherwise one step smaller does not fit, and most larger edges do.
std::optional<double> enough_mm(const Order& order, PrintChoice choice) {
  choice.bed_mm.reset();
  const model::CellSize& size = order.design.structure.size();
  const double refused_mm = choice.edge_mm > 0 ? choice.edge_mm : size.edge_mm;
  const auto prints = [&](double edge_mm) {
    choice.edge_mm = edge_mm;
    return has_room(best_attempt(order, choice, ClearanceSearch::verdict), order.design);
  };
  const auto fits = [&](double steps) { return prints(steps * step_mm); };
  if (prints(refused_mm)) return refused_mm;
  double low = std::floor(refused_mm / step_mm), high = low + 1;  // steps
  while (!fits(high)) {
    low = high;
    high = std::ceil(high * growth);
    if (high * step_mm > largest_scale * size.edge_mm) return std::nullopt;
  }
  while (high - low > 1) {
    const double middle = std::floor((low + high) / 2);
    (fits(middle) ? high : low) = middle;
  }
  return high * step_mm;
}

bool has_custom_pins(const Design& design) {
  const auto hinges = hinge_sections(design);
  return std::any_of(hinges.begin(), hinges.end(),
                     [](const HingeSection* hinge) { return hinge->made && is_pin(hinge->made->kind); });
}

/// Suggests a replacement for pins whose hinges stretch. Empty if they do not stretch, or if there are no pins.
std::string instead_of_pins(const Order& order, const PrintChoice& choice) {
  if (order.path.is_exact) return "";
  if (has_custom_pins(order.design))
    return ": its hinges stretch during the motion, and pins cannot. The design sets pins, and --hinge does "
           "not replace them. Change its `hinge:` to `kind: block`, or remove it and give --hinge block";
  if (!is_pin(choice.kind) || !leaves_hinges_open(order.design)) return "";
  return ": its hinges stretch during the motion, and pins cannot. Give --hinge block";
}

/// Suggests a cell edge: "; with walls of 0.8 x 6 mm a cell_mm of 12.5 would do (kinetix-opt export --cell-mm 12.5)".
/// Empty if the bed is too small.
std::string describe_alternative(const Order& order, const Attempt& refused, PrintChoice choice) {
  if (refused.is_bed_too_small) return "";
  const std::optional<double> edge = enough_mm(order, choice);
  if (!edge) return ". No larger cell fits either" + instead_of_pins(order, choice);
  choice.edge_mm = *edge;
  const model::CellSize size = resized(order.design.structure.size(), choice, order.process);
  const bool is_on_bed = !choice.bed_mm || best_attempt(order, choice, ClearanceSearch::verdict).print;
  const auto larger = describe_resizing(order.design.structure.size().edge_mm, *edge);
  return fmt::format(". With walls of {:.3g} x {:.3g} mm a cell_mm of {:g} fits: give --cell-mm {:g}{}{}",
                     size.thickness_mm, size.height_mm, *edge, *edge, is_on_bed ? "" : ", on a larger bed",
                     larger ? ": " + *larger : "");
}

/// Returns the kinds of hinges to try, in order.
std::vector<model::HingeKind> kinds_of(const Design& design, const model::Process& process) {
  const auto& kind = design.hinge.kind;
  return kind ? std::vector{*kind} : process.hinges;
}

std::vector<model::HingeKind> kinds_of(const Order& order) { return kinds_of(order.design, order.process); }

/// Returns the choice of which cells are suggested: pins if some cells have room for them, since a drive seldom folds a
/// whole sheet of soft hinges. @param last that was tried
PrintChoice advised_choice(const Order& order, const PrintChoice& last) {
  const std::vector<model::HingeKind> kinds = kinds_of(order);
  if (!leaves_hinges_open(order.design) || kinds.front() == last.kind || !is_pin(kinds.front())) return last;
  PrintChoice pins = last;
  pins.kind = kinds.front();
  return enough_mm(order, pins) ? pins : last;
}

/// Refuses a print: by InvalidInput for a bed, an option of the command, and by NotPrintable for what the design sets.
[[noreturn]] void refuse(const Order& order, const Attempt& refused, const PrintChoice& choice) {
  if (refused.is_bed_too_small) throw InvalidInput(refused.reason);
  throw NotPrintable(refused.reason + describe_alternative(order, refused, choice));
}

/// First kind of hinge that fits, or the last that was tried.
struct Fitted {
  PrintChoice choice;
  Attempt attempt;
  std::vector<std::string> refused = {};  ///< why kinds that were tried before do not fit, one sentence each
};

std::string plural_kind(model::HingeKind kind) {
  return kind == model::HingeKind::film ? "living hinges" : to_string(kind) + "s";
}

/// Tries the kinds of the process (model::Process::hinges). @param choice its kind does not count
Fitted fitted(const Order& order, PrintChoice choice, ClearanceSearch search) {
  Fitted out;
  for (const model::HingeKind kind : kinds_of(order)) {
    if (!out.attempt.reason.empty())
      out.refused.push_back(plural_kind(out.choice.kind) + " do not fit: " + out.attempt.reason);
    choice.kind = kind;
    out.choice = choice;
    out.attempt = best_attempt(order, choice, search);
    if (out.attempt.print || !leaves_hinges_open(order.design)) break;
  }
  return out;
}

/// Names the kinds that do not fit, before the reason of the last one. Empty for hinges of the design itself.
std::string describe_refused_kinds(const Order& order) {
  if (!leaves_hinges_open(order.design)) return "";
  std::vector<std::string> kinds;
  for (const model::HingeKind kind : kinds_of(order)) kinds.push_back(plural_kind(kind));
  if (kinds.size() == 1) return fmt::format("{} do not fit: ", kinds.front());
  return fmt::format("neither {} fit: with {} ", fmt::join(kinds, " nor "), kinds.back());
}

/// Explains why no kind of hinge fits, or why the design's own hinges do not. @param refused result of a verdict
std::string reason_of(const Order& order, const Fitted& refused) {
  return describe_refused_kinds(order) + attempt(order, refused.choice, ClearanceSearch::least).reason;
}

/// Joins kinds: "block, pin".
std::string named_kinds(const std::set<std::string>& kinds) {
  return fmt::format("{}", fmt::join(kinds, ", "));
}

std::string named_kinds(const PrintSheet& sheet) {
  std::set<std::string> kinds;
  for (const model::HingePrint& hinge : sheet.hinges) kinds.insert(to_string(hinge.made.kind));
  return named_kinds(kinds);
}

/// @param open kind of the hinges that the design leaves open
std::string named_kinds(const Design& design, model::HingeKind open) {
  std::set<std::string> kinds;
  for (const HingeSection* hinge : hinge_sections(design))
    kinds.insert(to_string(hinge->made ? hinge->made->kind : open));
  return named_kinds(kinds);
}

}  // namespace

std::optional<std::string> describe_resizing(double from_mm, double to_mm) {
  const double times = to_mm / from_mm;
  if (std::abs(times - 1) < reported_size) return std::nullopt;
  return fmt::format("flat and folded sheet are {:.3g} times as large", times);
}

PreparedPrint prepared(const Design& design, const model::Process& process, const PrintChoice& choice,
                       bool folded) {
  check_cuttable(design, process, {choice.kind});
  const Order order{design, process, folded};
  Attempt found = best_attempt(order, choice);
  if (found.print) return with_lock(std::move(*found.print), design, ClearanceSearch::least);
  refuse(order, found, choice);
}

PreparedPrint prepare_fitting_print(const Design& design, const model::Process& process, PrintChoice choice,
                                    bool folded) {
  check_cuttable(design, process, kinds_of(design, process));
  const Order order{design, process, folded};
  Fitted found = fitted(order, choice, ClearanceSearch::least);
  if (!found.attempt.print) {
    found.attempt.reason = describe_refused_kinds(order) + found.attempt.reason;
    refuse(order, found.attempt, advised_choice(order, found.choice));
  }
  for (const std::string& why : found.refused)
    found.attempt.print->job.sheet.warnings.push_back(
        fmt::format("hinges are {}, as {}", plural_kind(found.choice.kind), why));
  return with_lock(std::move(*found.attempt.print), design, ClearanceSearch::least);
}

PrintAnswer answer_of_export(const Design& design) try {
  check_cuttable(design, design.process, kinds_of(design, design.process));
  const Order order{design, design.process, false};
  Fitted found = fitted(order, {.bed_mm = requested_bed(design.process)}, ClearanceSearch::verdict);
  if (!found.attempt.print) return {false, named_kinds(design, found.choice.kind), reason_of(order, found)};
  const auto job = std::make_shared<PrintJob>(
      with_lock(std::move(*found.attempt.print), design, ClearanceSearch::verdict).job);
  const PrintSheet& sheet = job->sheet;
  PrintAnswer answer{true, named_kinds(sheet)};
  answer.lock = sheet.lock;
  for (const model::HingePrint& hinge : sheet.hinges) answer.made.push_back(hinge.made);
  answer.add_lock = [job] {
    add_default_lock(job->sheet);
    return job->sheet.lock;
  };
  answer.draw_card = [job](const auto& folding) {
    job->folding = folding;
    return card_json(make_folding_card(*job));
  };
  return answer;
} catch (const InvalidInput& e) {
  return {false, {}, e.reason()};
}

std::optional<model::CellSize> find_printable_size(const Design& design) try {
  check_cuttable(design, design.process, kinds_of(design, design.process));
  const Order order{design, design.process, false};
  std::optional<model::CellSize> least;
  for (const model::HingeKind kind : kinds_of(order)) {
    PrintChoice choice{.kind = kind};
    const std::optional<double> edge_mm = enough_mm(order, choice);
    if (!edge_mm || (least && *edge_mm >= least->edge_mm)) continue;
    choice.edge_mm = *edge_mm;
    least = resized(design.structure.size(), choice, design.process);
  }
  return least;
} catch (const InvalidInput&) {
  return std::nullopt;  // a design that has no print path has none with larger cells
}

}  // namespace kinetix::app
