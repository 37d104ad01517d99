#pragma once

#include "optim/ribs/ribs_layout.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// How far a folded fishbone is from the surface plus the clearance; of its bodies, mm.
struct RibsError {
  std::vector<double> of_body;  ///< distance from the surface less the clearance, > 0 outside
  double rms = 0, max = 0;      ///< max of the magnitude
  std::vector<double> of_ribs;  ///< rms of each rib's midline from its section curve, in its plane
};

/// A fishbone fitted to a surface.
struct RibsDesign {
  RibsLayout layout;
  model::Fishbone fishbone;  ///< its structure has the tilts found
  RibsShape shape;
  model::State state;  ///< folded on the surface
  RibsError error;
  SolveResult search;
  double tilt_limit = 0;                ///< that walls do not meet under, rad, at most the spec's
  int trimmed = 0;                      ///< cells taken off ribs whose walls met others when folded
  std::vector<std::string> collisions;  ///< walls that meet on the way all the same, some of them by name
};

/// Fits tilts, theta and place of a fishbone that was planned, and shortens ribs whose walls meet those of others while it
/// folds; where walls of one rib meet (over bumps and hollows), fits anew with gentler tilts.
/// @param surface in a frame with z up, y along the spine, mm   @param crown a point of the spine's plane x = const, mm
RibsDesign fit_layout(const RibsLayout& layout, const targets::MeshDistance& surface,
                      const Eigen::Vector3d& crown, const RibsSpec& spec, const SolverOptions& options);

/// What a planned fishbone is fitted to. @param crown a point of the spine's plane x = const, mm
RibsGoal ribs_goal(const RibsLayout& layout, const targets::MeshDistance& surface,
                   const Eigen::Vector3d& crown, const RibsSpec& spec);

/// State (mm) of a fishbone with tilts, its root where `shape` has it, at any theta, rad.
model::State placed_fishbone(const model::Fishbone& fishbone, const RibsShape& shape, double theta);

/// @param state of the fishbone's structure, in the goal's frame, mm
RibsError ribs_error(const model::Fishbone& fishbone, const model::State& state,
                     const targets::MeshDistance& surface, double clearance_mm);

}  // namespace kinetix::optim
