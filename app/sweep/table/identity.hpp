#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

/// What a sweep's table says of itself, in the order of its table `meta`:
/// schema, kinetix_version, name, model, method, samples, seed, factors and responses (JSON lists of
/// columns), doe_sha256, base_sha256, files_sha256 (of all files that these two name), doe and base (their
/// text).
using SweepIdentity = std::vector<std::pair<std::string, std::string>>;

SweepIdentity identify(const SweepPlan& plan);

/// Why a table with identity `there` is not of the sweep `asked`; empty where it is.
std::string difference(const SweepIdentity& there, const SweepIdentity& asked);

}  // namespace kinetix::app
