#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "model/lattice/planar/planar_structure.hpp"
#include "model/lattice/sodalite/sodalite.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

struct Assembly;

/// Imported bodies of any shape, at rest, with their linkage. There are no cells, and no parameters choose a hinge.
struct ImportedBodies {
  std::shared_ptr<const Assembly> assembly;
  std::shared_ptr<const Linkage> linkage;
  CellSize size;
  std::vector<HingeParameters> hinges;  ///< the basic ones, which say nothing of these hinges

  operator Linkage() const { return *linkage; }
};

/// A flat sheet of any lattice, a block of one in space, with the parameters of its hinges, or imported bodies: what files, results and
/// sweeps handle. Bodies, hinges and cells are counted from 0, in the order of the linkage that it makes.
class Lattice {
 public:
  Lattice() = default;
  Lattice(Structure squares) : of_(std::move(squares)) {}
  Lattice(PlanarStructure planar) : of_(std::move(planar)) {}
  Lattice(SodaliteStructure block) : of_(std::move(block)) {}
  explicit Lattice(Assembly bodies);

  const CellSize& size() const;
  int bodies() const;
  int hinges() const;
  int cells() const;

  const HingeParameters& hinge(int index) const;
  HingeParameters& hinge(int index);
  HingedWall wall(int hinge) const;
  /// Of a cell, counter-clockwise: bodies, and the hinges that join each to the next.
  std::span<const int> cell_bodies(int cell) const;
  std::span<const int> cell_hinges(int cell) const;
  Eigen::Vector3d rest_position(int body) const;  ///< mm

  operator Linkage() const;

  /// What only one lattice has; nothing of any other.
  const Structure* squares() const { return std::get_if<Structure>(&of_); }
  Structure* squares() { return std::get_if<Structure>(&of_); }
  const PlanarStructure* planar() const { return std::get_if<PlanarStructure>(&of_); }
  PlanarStructure* planar() { return std::get_if<PlanarStructure>(&of_); }
  const SodaliteStructure* sodalite() const { return std::get_if<SodaliteStructure>(&of_); }
  SodaliteStructure* sodalite() { return std::get_if<SodaliteStructure>(&of_); }
  const Assembly* assembly() const;

 private:
  std::variant<Structure, PlanarStructure, SodaliteStructure, ImportedBodies> of_;
};

/// "square", the name of the lattice that it is drawn by, "graph" or "bodies".
std::string lattice_name(const Lattice& sheet);

/// What results call a body and a cell: as many integers as the lattice needs.
std::vector<int> body_label(const Lattice& sheet, int body);
std::vector<int> cell_label(const Lattice& sheet, int cell);
/// A wall by its two vertices, as files have it; of imported bodies the hinge by its name.
std::string wall_name(const Lattice& sheet, int hinge);

/// Bodies that lie on one line along y at rest, from the left; in a line from below.
std::vector<std::vector<int>> body_columns(const Lattice& sheet);

/// @throws InvalidInput, naming wall and value, for hinge parameters outside their ranges (NaN included)
void validate_hinges(const Lattice& sheet);

}  // namespace kinetix::model
