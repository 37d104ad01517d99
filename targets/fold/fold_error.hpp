#pragma once

#include "model/linkage/state.hpp"
#include "targets/fold/fold_net.hpp"

namespace kinetix::targets {

/// Returns tan(phi / 2) / (2 tan(phi / 2k)): the distance of the solid's edge from the last vertices of its faces, in
/// pitches L cos(theta) of the lattice. A fold of angle phi spread evenly over k bending columns replaces the edge by
/// a chamfer. The planes of both faces meet at that distance. It is half a pitch for one column. For more columns it
/// has no limit as phi approaches 180 degrees.
/// @param angle phi, rad. @return pitches
double edge_inset(double angle, int columns);

/// Returns the positions, mm, of the vertices of each face (as bodies_of orders them) on the ideal solid. Its flat
/// faces have pitch `pitch`, mm, and are placed by the net's angles. The first face lies in the plane z = 0.
std::vector<Eigen::Matrix3Xd> ideal_faces(const FoldNet& net, const NetLayout& layout, double pitch);

/// Returns the first crease whose two faces, placed by the other creases, do not meet as it requires, half folded or
/// folded. Returns -1 if every ring of faces closes.
int open_crease(const FoldNet& net, const NetLayout& layout);

/// Deviation of a net's state from its goal.
struct FoldError {
  std::vector<double> fold;      ///< angle of each crease, rad, by the mean directions of its faces' lattices
  std::vector<double> face_rms;  ///< of each face: vertices from the ideal solid over the face's mean side
  double rms = 0;                ///< over the vertices of all faces, each over its face's mean side
};

/// Place of a face's vertex on the ideal solid, mm.
struct IdealPoint {
  int body = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

/// Lays the ideal solid over a state by the best proper rigid motion of all faces together.
/// @param theta fold parameter, rad, which gives the pitch of the ideal faces   @pre the state is finite
std::vector<IdealPoint> ideal_vertices(const FoldNet& net, const NetLayout& layout,
                                       const model::Structure& structure, const model::State& state,
                                       double theta);

/// Computes the error after a proper rigid motion aligns the solid with all faces together. NaN in the state gives
/// NaN.
/// @param theta fold parameter, rad, which gives the pitch of the ideal faces
FoldError fold_error(const FoldNet& net, const NetLayout& layout, const model::Structure& structure,
                     const model::State& state, double theta);

}  // namespace kinetix::targets
