#pragma once

/// Public interface of the library in one include and one namespace: kinetix::fit_curve,
/// kinetix::trace_equilibrium, ... Lengths in mm, angles in rad, forces in N. Names that are not listed here
/// are in the namespace and the folder of their room, such as kinetix::model::null_space in
/// model/closure/mobility.hpp.

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/elastic/path/stable_states.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/planar/planar_structure.hpp"
#include "model/lattice/planar/regular_lattices.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "model/linkage/state.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "model/opening/cell_opening.hpp"
#include "optim/curve/fit_curve.hpp"
#include "optim/display/fit_display.hpp"
#include "optim/doe/analysis.hpp"
#include "optim/doe/sampling.hpp"
#include "optim/fold/fit_fold.hpp"
#include "optim/outline/fit_outline.hpp"
#include "optim/ribs/fit_ribs.hpp"
#include "optim/solvers/multi_start.hpp"
#include "optim/solvers/nlopt_solver.hpp"
#include "optim/space_curve/fit_space_curve.hpp"
#include "optim/surface/fit_surface.hpp"
#include "sim/physics_run.hpp"
#include "targets/curve/read_curve.hpp"
#include "targets/display/display_goal.hpp"
#include "targets/fold/fold_goal.hpp"
#include "targets/helmet/head.hpp"
#include "targets/outline/outline.hpp"
#include "targets/space_curve/space_goal.hpp"
#include "targets/surface/surface_patch.hpp"

// Memory is passed between a program and the library, so both need the same alignment. Eigen aligns it by the
// widest vectors that it sees; the library and Debian's libceres are built for those of SSE.
static_assert(EIGEN_DEFAULT_ALIGN_BYTES == 16 && EIGEN_MAX_STATIC_ALIGN_BYTES == 16,
              "kinetix needs Eigen to align memory to 16 bytes. Link the CMake target kinetix::kinetix, or "
              "compile with "
              "-U__AVX__ -U__AVX2__ -U__AVX512F__ -U__FMA__ beside -mavx2 or -march=native.");

namespace kinetix {

/// @name Structures: cells, walls, hinges, and the poses of their bodies
/// @{
using model::Axis;
using model::Cell;
using model::CellSize;
using model::Hinge;
using model::hinge_gaps;
using model::HingeGaps;
using model::HingeParameters;
using model::lattice_graph;
using model::make_planar_structure;
using model::make_structure;
using model::PlanarGraph;
using model::PlanarStructure;
using model::Pose;
using model::rectangle;
using model::rest_state;
using model::square_graph;
using model::State;
using model::Structure;
using model::Vertex;
using model::Wall;
/// @}

/// @name Motion: exact families, degrees of freedom, collisions
/// @{
using model::aligned_distance;
using model::apply;
using model::area;
using model::area_ratio;
using model::classify;
using model::CordPull;
using model::crease_fold;
using model::crease_tilt;
using model::Drive;
using model::drive_on;
using model::drive_to;
using model::driven;
using model::ExactDesign;
using model::Family;
using model::fold;
using model::HingeTurn;
using model::mobility;
using model::opening;
using model::Plates;
using model::ShapeMemory;
using model::shear_angle;
using model::theta_range;
using model::twist_angle;
using model::Verdict;
/// @}

/// @name Equilibrium of elastic hinges, walls in contact
/// @{
using model::Elasticity;
using model::elasticity_of;
using model::EquilibriumPath;
using model::EquilibriumPathOptions;
using model::EquilibriumStep;
using model::find_material;
using model::find_stable_states;
using model::HingeKind;
using model::HingeStiffness;
using model::ManufacturedHinge;
using model::Material;
using model::PathEvent;
using model::search_drives;
using model::trace_equilibrium;
/// @}

/// @name Goals and their errors
/// @{
using targets::box_goal;
using targets::cap_patch;
using targets::Curve;
using targets::curve_error;
using targets::DisplayGoal;
using targets::FoldGoal;
using targets::Head;
using targets::Outline;
using targets::read_curve_csv;
using targets::rows_goal;
using targets::saddle_patch;
using targets::SpaceGoal;
using targets::SurfacePatch;
/// @}

/// @name Searches: for the goals above, and for custom problems
/// @{
using optim::AngleRange;
using optim::CurveDesign;
using optim::CurveVariables;
using optim::DisplayOptions;
using optim::fit_curve;
using optim::fit_display;
using optim::fit_fold;
using optim::fit_free_curve;
using optim::fit_helmet;
using optim::fit_outline;
using optim::fit_space_curve;
using optim::fit_surface;
using optim::FoldOptions;
using MadeHinge [[deprecated("ManufacturedHinge")]] = model::ManufacturedHinge;
using HelmetSpec [[deprecated("RibsSpec")]] = optim::RibsSpec;
using optim::LeastSquaresProblem;
using optim::multi_start;
using optim::MultiStartOptions;
using optim::MultiStartResult;
using optim::OutlineDesign;
using optim::OutlineOptions;
using optim::ScalarProblem;
using optim::solve;
using optim::SolveResult;
using optim::SolverName;
using optim::SolverOptions;
using optim::SolveStatus;
using optim::SpaceDesign;
using optim::SpaceVariables;
using optim::SurfaceDesign;
using optim::SurfaceOptions;
/// @}

/// @name Designs of experiments
/// @{
using optim::Factor;
using optim::main_effects;
using optim::morris_effects;
using optim::NormalSpread;
using optim::SamplePlan;
using optim::SamplingMethod;
using optim::SamplingOptions;
using optim::sobol_indices;
using optim::TableRows;
using optim::UniformRange;
using optim::ValueList;
/// @}

/// @name Simulation
/// @{
using sim::PhysicsOptions;
using sim::PhysicsResult;
using sim::run_compression;
/// @}

}  // namespace kinetix
