#pragma once

#include "app/console/console.hpp"

namespace kinetix::app {

/// Runs `kinetix-opt TARGET.yaml`: searches, verifies, writes.
int optimise_command(const CommandOptions& options);
/// Runs `kinetix-opt verify DESIGN.yaml`: simulates a design and compares it with the model, if one applies.
int verify_command(const CommandOptions& options);
/// Runs `kinetix-opt simulate DESIGN.yaml`: computes one folded state.
int simulate_command(const CommandOptions& options);
/// Runs `kinetix-opt check FILE.yaml`: validates a target, a design or a sweep. Writes nothing.
int check_command(const CommandOptions& options);

}  // namespace kinetix::app
