#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/linkage/cell_size.hpp"
#include "model/linkage/plate.hpp"
#include "model/linkage/rest_hinge.hpp"

namespace kinetix::model {

/// A rigid body: the half walls that meet at one vertex.
struct LinkageBody {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its vertex at rest, cell edges
  /// +1 or -1: which way it turns about z as theta grows from flat. The two bodies of a hinge differ.
  int sense = 1;
  /// How it turns as theta grows from flat, rad per rad, where that is not `sense` about z.
  std::optional<Eigen::Vector3d> spin = {};

  Eigen::Vector3d first_turn() const { return spin ? *spin : Eigen::Vector3d(0, 0, sense); }
};

/// A loop of bodies, each joined to the next by a hinge and the last to the first. Of even length, since the
/// senses of neighbours differ.
struct LinkageCell {
  std::vector<int> bodies;  ///< counter-clockwise
  std::vector<int> hinges;  ///< hinge k joins bodies k and k + 1
};

/// Rigid bodies, the hinges that join them, and their walls, flat at rest: all that elastic model, closure,
/// contact and physics know of a structure. Lattices make linkages (model/lattice/); nothing here tells which
/// lattice a linkage came from.
struct Linkage {
  CellSize size;
  std::vector<LinkageBody> bodies;
  std::vector<RestHinge> hinges;
  std::vector<Plate> plates;  ///< two a hinge, at 2 hinge (the lower body's) and 2 hinge + 1
  std::vector<LinkageCell> cells;
  std::function<std::string(int hinge)> wall_name;   ///< as messages name the wall of a hinge
  std::function<std::string(int body)> vertex_name;  ///< likewise the vertex of a body

  Eigen::Vector3d rest_position(int body) const;  ///< mm
};

/// Whether all hinge axes stand along z at rest: then the structure moves in the plane.
bool all_vertical(const Linkage& linkage);

}  // namespace kinetix::model
