#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Steps of the equilibrium path of a run, the same for every goal of a drive. Largest loads are those of steps: a forecast of
/// what a run reports takes the same steps.
model::EquilibriumPathOptions path_of_run(bool planar);

/// Follows the equilibrium of run.design.structure with elastic hinges to the drive's goal and adds what came out:
/// the path, its last state, the stable states that a release on the way leads to, the closed form's state
/// of the same drive where there is one, frames of the motion, rows of the speed-against-error table,
/// sentences of the plan. Sets run.theta to where the path ended.
/// Where it is told to stop, all of that of the path so far.
/// @param frames about how many states of the motion to keep, flat and last included, >= 2
void add_equilibrium(Run& run, const model::LinkageDrive& drive, const model::Elasticity& elasticity,
                     int frames, const RunOptions& run_options);

/// Theta of the sheet where a path came to, rad: that of the closed form under the same drive where it is near, else half the turns
/// of its hinges. That of plates, by their distance alone, is another where rows lean; a cord and springs only pull that way.
/// @param exact motion of the sheet, where it has one
double reached_theta(const model::Sheet& sheet, const model::ExactMotion& exact,
                     const model::LinkageDrive& drive, const model::EquilibriumPath& path,
                     const model::Elasticity& elasticity);

}  // namespace kinetix::app
