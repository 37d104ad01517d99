#pragma once

#include "app/files/design_file.hpp"
#include "model/material/manufactured_hinge.hpp"

namespace kinetix::app {

/// Returns the section of a hinge: its override, or that of all others.
const HingeSection& hinge_section(const Design& design, int hinge);

/// Lists how hinges are made, each kind once. Empty if the design does not say.
std::vector<model::ManufacturedHinge> manufactured_hinges(const Design& design);

/// Checks whether the design leaves the kind of some hinge open.
bool leaves_hinges_open(const Design& design);

/// Checks whether all hinges are pins with known sizes.
bool has_pins_alone(const Design& design);

/// Checks whether a drive is the one of a design that names none: the same plates or the same hinge.
bool is_usual_drive(const model::LinkageDrive& drive, const Design& design);

/// Returns the design with these hinges in place of those that it leaves open.
/// @param made by hinge; those of hinges that the design describes do not count
Design with_manufactured_hinges(const Design& design, const std::vector<model::ManufacturedHinge>& made);

/// Returns the design with all hinges left open if they are computed as joints: their motion does not depend on how they
/// are manufactured.
Design with_open_joints(Design design);

/// Returns the pin with the largest clearance among those that do not move freely within it.
std::optional<model::ManufacturedHinge> loosest_pin(const Design& design);

/// Returns by how much walls of prints are out of place and lean: errors of the process and clearance of the loosest pin.
model::PrintError wall_error(const Design& design);

/// Whether the material of every block and film withstands its strain in a state.
bool withstands_strain(const Design& design, const model::State& state);

/// Describes the hinge that is strained farthest beyond the limit of its material in a state. Empty if none is.
std::optional<std::string> describe_overstrain(const Design& design, const model::State& state);
/// Describes the strain of a hinge against the limit of its material. @param wall its name   @param when "" or what
/// follows the strain, such as " on the way to the fold"
std::string describe_strain(const model::StrainedHinge& worst, const std::string& wall,
                            const char* when = "");

/// Lists what the process of the design cannot print, each problem once.
std::vector<model::PrintProblem> print_problems(const Design& design);

}  // namespace kinetix::app
