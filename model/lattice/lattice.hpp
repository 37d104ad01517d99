#pragma once

#include <memory>
#include <span>
#include <variant>

#include "model/lattice/planar/planar_structure.hpp"
#include "model/lattice/sodalite.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

struct Assembly;

/// Imported bodies of any shape, at rest, with their linkage. They have no cells, and no parameters set their hinges.
struct ImportedBodies {
  std::shared_ptr<const Assembly> assembly;
  std::shared_ptr<const Linkage> linkage;
  CellSize size;
  std::vector<HingeParameters> hinges;  ///< basic ones, which do not describe these hinges

  operator Linkage() const { return *linkage; }
};

/// A flat sheet of any lattice, a spatial block, each with the parameters of its hinges, or imported bodies. Files,
/// results and sweeps use this type. Bodies, hinges and cells are counted from 0, in the order of its linkage.
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
  /// Returns the bodies of a cell, counter-clockwise, and the hinges that join each to the next.
  std::span<const int> cell_bodies(int cell) const;
  std::span<const int> cell_hinges(int cell) const;
  Eigen::Vector3d rest_position(int body) const;  ///< mm

  operator Linkage() const;

  /// Returns the structure of one kind of lattice; null for any other kind.
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

/// Returns "square", the name of the lattice from which it was drawn, "graph" or "bodies".
std::string lattice_name(const Lattice& sheet);

/// Returns the label of a body or cell in results: as many integers as the lattice needs.
std::vector<int> body_label(const Lattice& sheet, int body);
std::vector<int> cell_label(const Lattice& sheet, int cell);
/// Returns a wall by its two vertices, as in files; for imported bodies the name of the hinge.
std::string wall_name(const Lattice& sheet, int hinge);

/// Returns bodies on one line along y at rest, lines from the left; within a line from below.
std::vector<std::vector<int>> body_columns(const Lattice& sheet);

/// Checks the hinge parameters. @throws InvalidInput, naming wall and value, for one outside its range (NaN included)
void validate_hinges(const Lattice& sheet);

/// Returns a hinge of a sheet at rest, as in its linkage.
RestHinge rest_hinge(const Lattice& sheet, int hinge);

}  // namespace kinetix::model
