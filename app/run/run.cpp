#include "app/run/run.hpp"

#include <fmt/format.h>
#include <cmath>

#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

/// Returns the requested theta, rad, which the equilibrium need not have reached. Plates on lattices other than
/// squares need not approach each other by the cosine of theta. Files have no drive for such lattices.
double requested_theta(const Run& run) {
  if (!run.equilibrium) return run.theta;
  const model::LinkageDrive& drive = run.equilibrium->drive;
  const bool is_by_cosine = run.design.drive || run.design.structure.squares() || !drive.has_plates();
  if (is_by_cosine || !run.plan.exact) return drive.theta();
  try {
    return run.plan.exact.theta_of(drive);
  } catch (const InvalidInput&) {
    return drive.theta();
  }
}

}  // namespace

std::string describe(StateOf of) {
  constexpr std::array words = {"model", "equilibrium", "simulation"};
  return words[static_cast<std::size_t>(of)];
}

Design requested_design(const SearchResult& found) {
  Design design = found.design;
  design.theta = found.theta;
  return design;
}

SearchResult planned(SearchResult found, bool brief) {
  if (found.goal && !found.hinge_parts.empty())
    found.design.hinge_overrides = hinge_overrides_of(found.design.structure, found.hinge_parts);
  found.plan =
      (brief ? make_brief_plan : make_plan)(found.design.structure, found.model, std::move(found.plan.exact));
  if (!found.goal || found.plan.model == Model::equilibrium) return found;
  if (!found.plan.exact)
    throw InvalidInput("the design that was found has no analytic motion: " + found.plan.exact.why);
  found.own = found.motion ? found.motion(found.theta) : found.plan.exact.at(found.theta);
  return found;
}

namespace {

// N and N mm: by hand, and with a clamp or a tool.
constexpr std::array most_by_hand = {100.0, 3000.0}, most_by_clamp = {1000.0, 30000.0};

}  // namespace

std::string describe_effort(const Folding& folding) {
  if (folding.is_unaided) return "unaided";
  const std::size_t unit = folding.is_force ? 0 : 1;
  if (!folding.is_possible() || !(folding.load <= most_by_clamp[unit])) return "no";
  return folding.load <= most_by_hand[unit] ? "by hand" : "with a clamp";
}

Design written_design(const Run& run) {
  Design design = run.design;
  design.theta = requested_theta(run);
  if (design.drive || !run.folding || !run.folding->drive || run.equilibrium) return design;
  // Soft hinges lag behind their drive, which therefore ends beyond the theta of the design.
  if (!run.folding->turns_freely ||
      !is_usual_drive(drive_on(design.structure, *run.folding->drive, design.theta), design))
    design.drive = run.folding->drive;
  return design;
}

std::array<std::string, 2> wall_names(const model::WallPair& walls, const model::Lattice& sheet) {
  return {wall_name(sheet, walls.first / 2), wall_name(sheet, walls.second / 2)};
}

std::string describe_overlap(const model::WallPair& walls, const model::Lattice& sheet) {
  const auto [first, second] = wall_names(walls, sheet);
  return fmt::format(
      "walls {} and {} overlap in the flat sheet. Use lower or thinner walls, less tilt or larger cells",
      first, second);
}

std::string describe_overlap(const model::ContactLimit& limit, double theta, const model::Lattice& sheet) {
  const auto [first, second] = wall_names(limit.walls, sheet);
  return fmt::format("walls {} and {} overlap at {:.3g} deg, before the fold angle {:.3g} deg", first, second,
                     to_degrees(*limit.contact), to_degrees(theta));
}

std::optional<std::string> contact_reason(const Run& run) {
  const bool is_proven = run.certified && run.certified->designed;
  if (!is_proven && !run.plan.free_range) return std::nullopt;
  const model::ContactRange& range = is_proven ? run.certified->designed : *run.plan.free_range;
  const model::ContactLimit& limit = range.to(run.theta);
  if (!limit.contact || std::abs(*limit.contact) >= std::abs(run.theta)) return std::nullopt;
  if (range.overlaps_as_built()) return describe_overlap(limit.walls, run.design.structure);
  return describe_overlap(limit, run.theta, run.design.structure);
}

std::vector<std::string> collisions_during_motion(const Run& run, const std::string& instead) {
  const auto reason = contact_reason(run);
  return reason ? std::vector{*reason + ": " + instead} : std::vector<std::string>{};
}

std::string describe_other_side(const Equilibrium& equilibrium, double theta) {
  return fmt::format("folded to {:.2f} deg instead of the requested {:.2f} deg", to_degrees(theta),
                     to_degrees(equilibrium.drive.theta()));
}

std::string describe(model::EquilibriumPath::Stop stop) {
  return stop == model::EquilibriumPath::Stop::overstretched ? "joint separated" : to_string(stop);
}

std::string describe_missed_drive(const Equilibrium& equilibrium, double theta) {
  if (equilibrium.reached()) return "opposite side: " + describe_other_side(equilibrium, theta);
  return describe(equilibrium.path.stop) + ": " + equilibrium.path.why;
}

std::string drive_stop_reason(const model::EquilibriumPath& path) {
  return "the drive stops before the fold, " + describe(path.stop) + ": " + path.why;
}

void follow(const RunOptions& run, double mm, optim::SolverOptions& search) {
  search.stop = run.stop;
  search.on_progress = [progress = run.progress, mm, most = search.max_evaluations](int evaluations,
                                                                                    double least) {
    if (!std::isfinite(least)) return;
    progress("search", -1,
             fmt::format("step {} of at most {}, best {:.2g} mm off", evaluations, most, least * mm));
  };
}

optim::MultiStartOptions followed(optim::MultiStartOptions search, const RunOptions& run,
                                  std::function<std::string(double least)> describe) {
  search.threads = run.threads;
  search.seed = run.seed;
  search.solver.stop = run.stop;
  search.ended = [progress = run.progress, starts = search.starts, describe = std::move(describe)](
                     int ended, double least) {
    progress("search", static_cast<double>(ended) / starts,
             fmt::format("start {} of {}, {}", ended, starts, describe(least)));
  };
  return search;
}

}  // namespace kinetix::app
