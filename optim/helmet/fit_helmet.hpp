#pragma once

#include "optim/helmet/helmet_layout.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// How far a folded helmet is from the head plus the clearance; of its bodies, mm.
struct HelmetError {
  std::vector<double> of_body;  ///< distance from the head less the clearance, > 0 outside
  double rms = 0, max = 0;      ///< max of the magnitude
  std::vector<double> of_ribs;  ///< rms of each rib's midline from its section curve, in its plane
};

/// A fishbone fitted to a head.
struct HelmetDesign {
  HelmetLayout layout;
  model::Fishbone fishbone;  ///< its structure has the tilts found
  HelmetShape shape;
  model::State state;  ///< folded on the head
  HelmetError error;
  SolveResult search;
  double tilt_limit = 0;                ///< that walls do not meet under, rad, at most the spec's
  int trimmed = 0;                      ///< cells taken off ribs whose walls met others when folded
  std::vector<std::string> collisions;  ///< walls that meet on the way all the same, some of them by name
};

/// Plans a fishbone, fits tilts, theta and place, and shortens ribs whose walls meet those of others while it
/// folds; where walls of one rib meet (over bumps and hollows), fits anew with gentler tilts.
/// @param crown of the head, in its frame, mm
/// @throws InvalidInput as plan_helmet
HelmetDesign fit_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown,
                        const HelmetSpec& spec, const SolverOptions& options);

/// Likewise of a fishbone that was planned. @param crown a point of the spine's plane x = const, mm
HelmetDesign fit_layout(const HelmetLayout& layout, const targets::MeshDistance& head,
                        const Eigen::Vector3d& crown, const HelmetSpec& spec, const SolverOptions& options);

/// The paper's way, on the same fishbone: one tilt for all creases, bent all to the inside.
struct UniformHelmet {
  double tilt = 0, theta = 0;  ///< rad
  HelmetError before;  ///< with the mean of the fitted tilts at the layout's theta, placed on the crown
  HelmetError after;   ///< with the best tilt, theta and place
};
UniformHelmet fit_uniform_helmet(const HelmetDesign& design, const targets::MeshDistance& head,
                                 const Eigen::Vector3d& crown, const HelmetSpec& spec,
                                 const SolverOptions& options);

/// State (mm) of a fishbone with tilts, its root where `shape` has it, at any theta, rad.
model::State placed_fishbone(const model::Fishbone& fishbone, const HelmetShape& shape, double theta);

/// @param state of the fishbone's structure, in the head's frame, mm
HelmetError helmet_error(const model::Fishbone& fishbone, const model::State& state,
                         const targets::MeshDistance& head, double clearance_mm);

}  // namespace kinetix::optim
