#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// What the states of a run are to the closed form that a range is proven of: those of an equilibrium are near it where the last
/// was compared with it, and left it where they did or where no closed form fits the drive.
enum class NearExact { same, near, left };

NearExact near_exact(const Run& run);

/// The section `certified` of result.json.
/// @param theta of the state shown, rad
nlohmann::ordered_json certified_json(const ProvenRanges& certified, const model::Lattice& sheet,
                                      double theta, NearExact states);

/// Lines of the summary, and of `check`. Parameters as above.
std::vector<SummaryLine> certified_lines(const ProvenRanges& certified, const model::Lattice& sheet,
                                         double theta, NearExact states);

}  // namespace kinetix::app
