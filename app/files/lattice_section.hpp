#pragma once

#include "app/files/structure_section.hpp"
#include "model/lattice/lattice.hpp"

namespace kinetix::app {

/// Returns the key `structure` of a file that may name any lattice.
targets::Key lattice_structure_key();

/// Reads the flat sheet, all hinges basic. @param notes set to changes to files that it names, one sentence each
/// @throws InvalidInput for all that formats.md does not allow. Examples: cells that are not connected, a graph with
/// crossing walls or with a loop of an odd number of them, and a key that the lattice does not take.
model::Lattice read_sheet(const targets::Node& structure, std::vector<std::string>& notes);

/// Returns the structure of a file whose walls are drawn; empty for other files.
std::optional<targets::Section> find_drawn_structure(const targets::Node& root);

/// Returns the section's text, from which read_sheet draws the same sheet.
std::string structure_text(const model::Lattice& sheet);

/// Lattice that a goal requests, without its cells.
struct LatticeChoice {
  const model::PlanarLattice* lattice = nullptr;  ///< null: squares
  double angle = model::LatticeSheet{}.angle;     ///< rad, of lattices that take one
  bool closed_boundary = false;                   ///< whether the boundary is closed; not of squares

  std::string name() const;
  /// Returns the distance of neighbouring columns over that of neighbouring rows: 1 for squares, 2 for bricks.
  double cell_shape() const;
};

/// Returns the keys of a LatticeChoice: `lattice`, `angle_deg`, `rim`. @param closed whether the boundary is closed
/// by default
std::vector<targets::Key> lattice_choice_keys(bool closed);
/// Reads a lattice. @throws InvalidInput for an unknown lattice, and for an angle or a boundary that it does not take
LatticeChoice read_lattice_choice(const targets::Section& structure, bool closed);

/// Makes the flat sheet of some cells of the lattice, all hinges basic. @throws InvalidInput as read_sheet
model::Lattice make_sheet(const LatticeChoice& choice, const std::vector<model::LatticeCell>& cells,
                          const model::CellSize& size);

}  // namespace kinetix::app
