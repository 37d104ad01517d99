#pragma once

#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/fishbone.hpp"
#include "optim/ribs/ribs_problem.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::optim {

/// Walls of a fishbone that collide while it folds, checked in sixteen states from flat to theta.
class RibsCollisions {
 public:
  /// @param fishbone with its tilts   @param theta rad
  RibsCollisions(const model::Fishbone& fishbone, double theta);

  /// Shortens one rib of each pair of walls, unless both are on the same side of one rib.
  /// @return number of removed cells
  int trim(model::FishboneLayout& spine_and_ribs) const;
  /// Names the first three pairs and counts the others; empty if none collide.
  std::vector<std::string> describe() const;

 private:
  const model::FishbonePlace& place_of_plate(int half) const { return places_[walls_[half].body]; }

  std::vector<model::HalfWall> walls_;
  std::vector<model::FishbonePlace> places_;  // of each body
  std::vector<model::WallPair> pairs_;
  std::vector<std::string> names_;  // of each hinge's wall
};

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

/// Plans a fishbone on any surface. Its spine is the surface's line, with ribs in planes normal to it. They
/// extend to the end of the surface or to their neighbours.
/// @param spec clearance, tilts, theta, ribs; its coverage has no meaning
/// @throws InvalidInput as layout_along
RibsLayout plan_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec);

/// Fits tilts, theta and place of a fishbone (optim/ribs/fit_ribs.hpp), in the frame of the ribs.
RibsDesign fit_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                    const SolverOptions& options);

/// Returns the share of a surface that cells folded to theta leave bare, (-inf, 1]. A cell covers the square
/// of its folded pitch.
double open_area(int cells, const model::CellSize& size, double theta, double area);

/// Ribs of a plan as separate pieces. Each is an exact strip on the curve where its plane cuts the surface.
struct LooseRibs {
  int pieces = 0;
  double rms = 0, max = 0;  ///< distance of bodies from the surface at the clearance, mm
  double open = 0;          ///< share of the surface left bare
};
LooseRibs fit_loose_ribs(const targets::RibbedSurface& surface, const RibsSpec& spec,
                         const SolverOptions& options);

/// Plans the spine along the plane x = crown.x, from rim to rim over the crown. Ribs are evenly spaced along
/// it, each in the plane normal to the spine. They end at the rim or where they would meet their neighbours.
/// @throws InvalidInput if the ribs would overlap flat, if a ray from within does not hit the head, or if
/// cells are larger than the area to cover
RibsLayout plan_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const RibsSpec& spec);

/// Plans a fishbone, fits tilts, theta and place, and shortens ribs whose walls meet those of other ribs
/// while it folds. If walls of one rib meet (over bumps and hollows), it fits again with gentler tilts.
/// @param crown of the head, in its frame, mm
/// @throws InvalidInput as plan_helmet
RibsDesign fit_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const RibsSpec& spec,
                      const SolverOptions& options);

}  // namespace kinetix::optim
