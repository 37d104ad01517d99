#pragma once

#include "optim/ribs/ribs_layout.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Distance of a folded fishbone's bodies from the surface plus the clearance, mm.
struct RibsError {
  std::vector<double> of_body;  ///< distance from the surface minus the clearance, > 0 outside
  double rms = 0, max = 0;      ///< max of the magnitude
  std::vector<double> of_ribs;  ///< rms of each rib's midline from its section curve, in its plane
};

/// Fishbone fitted to a surface.
struct RibsDesign {
  RibsLayout layout;
  model::Fishbone fishbone;  ///< its structure has the tilts found
  RibsShape shape;
  model::State state;  ///< folded on the surface
  RibsError error;
  SolveResult search;
  double tilt_limit = 0;                ///< limit under which walls do not meet, rad, at most the spec's
  int trimmed = 0;                      ///< cells removed from ribs whose walls met others when folded
  std::vector<std::string> collisions;  ///< walls that still meet during the motion, some of them by name
};

/// Fits tilts, theta and place of a planned fishbone, and shortens ribs whose walls meet those of others
/// while it folds. If walls of one rib meet (over bumps and hollows), it fits again with gentler tilts.
/// @param surface in a frame with z up, y along the spine, mm   @param crown a point of the spine's plane x = const, mm
RibsDesign fit_layout(const RibsLayout& layout, const targets::MeshDistance& surface,
                      const Eigen::Vector3d& crown, const RibsSpec& spec, const SolverOptions& options);

/// Returns the goal of a planned fishbone. @param crown a point of the spine's plane x = const, mm
RibsGoal ribs_goal(const RibsLayout& layout, const targets::MeshDistance& surface,
                   const Eigen::Vector3d& crown, const RibsSpec& spec);

/// Returns the state (mm) of a fishbone with tilts at any theta, rad, with its root placed by `shape`.
model::State placed_fishbone(const model::Fishbone& fishbone, const RibsShape& shape, double theta);

/// Computes the error. @param state of the fishbone's structure, in the goal's frame, mm
RibsError ribs_error(const model::Fishbone& fishbone, const model::State& state,
                     const targets::MeshDistance& surface, double clearance_mm);

}  // namespace kinetix::optim
