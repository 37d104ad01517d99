#pragma once

#include "app/console/console.hpp"

namespace kinetix::app {

/// Runs or resumes a design of experiments (`kinetix-opt sweep DOE.yaml`). Writes DIR/sweep.sqlite and
/// DIR/samples.csv. Every rank under mpirun calls this.
/// @param share K/N: computes only this part of the samples (shares.hpp); empty: all
int sweep_command(const CommandOptions& options, const std::string& share);

}  // namespace kinetix::app
