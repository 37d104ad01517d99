#pragma once

#include "app/console/command_options.hpp"

namespace kinetix::app {

/// `kinetix-opt sweep DOE.yaml`: runs or resumes a design of experiments and writes DIR/sweep.sqlite and
/// DIR/samples.csv. Under mpirun every rank calls this.
int sweep_command(const CommandOptions& options);

}  // namespace kinetix::app
