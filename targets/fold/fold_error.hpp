#pragma once

#include <vector>

#include "model/linkage/state.hpp"
#include "targets/fold/net_layout.hpp"

namespace kinetix::targets {

/// A fold of angle phi spread evenly over k bending columns replaces the solid's edge by a chamfer: the
/// planes of its two faces meet this far beyond the last vertices of each, in pitches L cos(theta) of the
/// lattice: tan(phi / 2) / (2 tan(phi / 2k)). Half a pitch for one column; no limit as phi comes to 180
/// degrees. @param angle phi, rad @return pitches
double edge_inset(double angle, int columns);

/// Positions, mm, of the vertices of each face (as bodies_of orders them) on the ideal solid: flat faces of
/// pitch `pitch`, mm, placed by the net's angles. The first face lies in the plane z = 0.
std::vector<Eigen::Matrix3Xd> ideal_faces(const FoldNet& net, const NetLayout& layout, double pitch);

/// The first crease whose two faces, placed by the other creases, do not meet as it asks, half folded or
/// folded; -1 where every ring of faces closes.
int open_crease(const FoldNet& net, const NetLayout& layout);

/// How a state of a net keeps the goal.
struct FoldError {
  std::vector<double> fold;      ///< angle of each crease, rad, by the mean directions of its faces' lattices
  std::vector<double> face_rms;  ///< of each face: vertices from the ideal solid over the face's mean side
  double rms = 0;                ///< the same over the vertices of all faces
};

/// Where a vertex of a face would be on the ideal solid, mm.
struct IdealPoint {
  int body = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

/// The ideal solid laid over a state by the best proper rigid motion of all faces together.
/// @param theta fold parameter, rad, which gives the pitch of the ideal faces   @pre the state is finite
std::vector<IdealPoint> ideal_vertices(const FoldNet& net, const NetLayout& layout,
                                       const model::Structure& structure, const model::State& state,
                                       double theta);

/// The solid is aligned with all faces together by a proper rigid motion. NaN in the state gives NaN.
/// @param theta fold parameter, rad, which gives the pitch of the ideal faces
FoldError fold_error(const FoldNet& net, const NetLayout& layout, const model::Structure& structure,
                     const model::State& state, double theta);

}  // namespace kinetix::targets
