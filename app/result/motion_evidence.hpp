#pragma once

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Classifies a force on plates, N: "fingers", "a hand", "both arms", "a vice". The limits are from ergonomics
/// handbooks, rounded down to what most adults can do without strain.
std::string classify_force(double newtons);
/// Classifies the moment of a driven hinge, N mm, by the same words.
std::string classify_moment(double newton_mm);
/// Describes the peak actuation load. Shape-memory drives need none: "its own springs".
std::string classify_load(const Equilibrium& equilibrium);
/// Describes one of these classes as a hint next to a load: "light finger pressure".
std::string describe_effort_class(const std::string& effort);
/// Describes how a sheet is folded, one sentence: "by hand with 3.2 N, plates normal to y".
std::string describe_folding(const Folding& folding);

/// Returns the load of a folding in result.json; null if it is of the other unit, and without one.
/// @param is_force N, else N mm
nlohmann::ordered_json load_json(const std::optional<Folding>& folding, bool is_force);

/// Returns the section `manufacture` of result.json: how a design is printed and folded. @param hinge of most hinges
nlohmann::ordered_json manufacture_json(const Design& design, const model::ManufacturedHinge& hinge,
                                        const std::optional<Folding>& folding,
                                        const std::optional<Lock>& lock);

/// Returns a lock as result.json and print.json have it; null without one.
nlohmann::ordered_json lock_json(const std::optional<Lock>& lock);

/// Returns the section `equilibrium` of result.json.
nlohmann::ordered_json equilibrium_json(const Equilibrium& equilibrium);

/// Returns the mean moment of shape-memory springs at the end of the path, N mm.
double mean_moment(const Equilibrium& equilibrium);

/// Adds an equilibrium's numbers to `metrics`.
void add_equilibrium_metrics(const Equilibrium& equilibrium, nlohmann::ordered_json& metrics);

/// Returns the section `matter` of result.json.
nlohmann::ordered_json compensation_json(const CompensationResult& compensation);

/// Returns the summary lines of the compensation for elastic hinges: distance from the goal before and after it. Empty
/// without run.matter.
std::vector<SummaryLine> compensation_lines(const Run& run);

/// Relation of a run's states to the closed form that the certified range applies to.
/// same: there is no equilibrium, so states are exact. near: the last equilibrium is close to the closed form.
/// left: the equilibrium path left the closed form, or no closed form fits the drive.
enum class ClosedFormRelation { same, near, left };

/// Determines this relation for a run.
ClosedFormRelation closed_form_relation(const Run& run);

/// Returns the section `certified` of result.json. @param theta of the reported state, rad
nlohmann::ordered_json certified_json(const ProvenRanges& certified, const model::Lattice& sheet,
                                      double theta, ClosedFormRelation states);

/// Returns the lines for the summary and for `check`. @param theta of the reported state, rad
std::vector<SummaryLine> certified_lines(const ProvenRanges& certified, const model::Lattice& sheet,
                                         double theta, ClosedFormRelation states);

}  // namespace kinetix::app
