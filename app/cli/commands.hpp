#pragma once

#include "app/console/console.hpp"

namespace kinetix::app {

/// `kinetix-opt TARGET.yaml`: search, verify, write.
int optimise_command(const CommandOptions& options);
/// `kinetix-opt verify DESIGN.yaml`: the physics run of a design, compared with the model where one fits.
int verify_command(const CommandOptions& options);
/// `kinetix-opt simulate DESIGN.yaml`: one forward state.
int simulate_command(const CommandOptions& options);
/// `kinetix-opt check FILE.yaml`: validates a target, a design or a sweep, writes nothing.
int check_command(const CommandOptions& options);

}  // namespace kinetix::app
