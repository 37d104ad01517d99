#pragma once

#include <string>

#include "app/files/structure_section.hpp"
#include "model/lattice/lattice.hpp"

namespace kinetix::app {

/// The key `structure` of a file that may name any lattice.
targets::Key lattice_structure_key();

/// The flat sheet, all hinges basic.
/// @throws InvalidInput for whatever formats.md does not allow: among others cells that do not hang together, a
/// graph with crossing walls or a loop of an odd number of them, and a key that the lattice does not take
model::Lattice read_sheet(const targets::Node& structure);

/// The section's text, from which read_sheet draws the same sheet.
std::string structure_text(const model::Lattice& sheet);

/// A lattice as a goal asks for it, without its cells.
struct LatticeChoice {
  const model::PlanarLattice* lattice = nullptr;  ///< nothing: squares
  double angle = model::LatticeSheet{}.angle;     ///< rad, of lattices that take one
  bool closed_rim = false;                        ///< not of squares

  std::string name() const;
  /// Distance of neighbouring columns over that of neighbouring rows: 1 of squares, 2 of bricks.
  double cell_shape() const;
};

/// Its keys: `lattice`, `angle_deg`, `rim`. @param closed whether the rim is closed where the file says nothing
std::vector<targets::Key> lattice_choice_keys(bool closed);
/// @throws InvalidInput for an unknown lattice, and an angle or a rim that it does not take
LatticeChoice read_lattice_choice(const targets::Section& structure, bool closed);

/// The flat sheet of some cells of it, all hinges basic. @throws InvalidInput as read_sheet
model::Lattice make_sheet(const LatticeChoice& choice, const std::vector<model::LatticeCell>& cells,
                          const model::CellSize& size);

}  // namespace kinetix::app
