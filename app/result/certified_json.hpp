#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Relation of a run's states to the closed form that the certified range applies to.
/// same: there is no equilibrium, so states are exact. near: the last equilibrium is close to the closed form.
/// left: the equilibrium path left the closed form, or no closed form fits the drive.
enum class NearExact { same, near, left };

/// Determines this relation for a run.
NearExact near_exact(const Run& run);

/// Returns the section `certified` of result.json. @param theta of the reported state, rad
nlohmann::ordered_json certified_json(const ProvenRanges& certified, const model::Lattice& sheet,
                                      double theta, NearExact states);

/// Returns the lines for the summary and for `check`. @param theta of the reported state, rad
std::vector<SummaryLine> certified_lines(const ProvenRanges& certified, const model::Lattice& sheet,
                                         double theta, NearExact states);

}  // namespace kinetix::app
