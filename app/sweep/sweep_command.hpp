#pragma once

#include <string>

#include "app/console/console.hpp"

namespace kinetix::app {

/// `kinetix-opt sweep DOE.yaml`: runs or resumes a design of experiments and writes DIR/sweep.sqlite and
/// DIR/samples.csv. Under mpirun every rank calls this.
/// @param share K/N: that part of the samples alone (shares.hpp); empty: all
int sweep_command(const CommandOptions& options, const std::string& share);

}  // namespace kinetix::app
