#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/sweep/plan/doe_file.hpp"
#include "app/sweep/plan/sweep_base.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// One number of the base that a factor writes.
struct Edit {
  enum class Kind { document, theta_deg, t, t_mm, alpha_deg, beta_deg, offset_mm };

  Kind kind = Kind::document;
  int index = 0;  ///< item of the document, or hinge of the structure
  /// t -> 1 - t, alpha -> 180 - alpha, beta -> -beta, offset -> -offset: what the alternation over a sheet requires.
  bool flipped = false;
  int factor = 0;              ///< column of the factor
  double times = 1, plus = 0;  ///< as of FactorPath; plus in units of the edit's key
  double base = 0;             ///< added: the base's own value, in the unit of the edit's key, as value()
  double unit = 1;             ///< multiplied: the base's own value, in the unit of the edit's key

  /// What is written, for a value of the factor; both in the unit of the key, or of scaled ones the factor by itself.
  double value(double of_factor) const { return base + unit * (times * of_factor + plus); }
};

/// A number of the base that varies by itself, under its own path; more than one edit where a column or a row
/// of walls moves as one.
struct Match {
  std::string path;
  std::vector<Edit> edits;
};

/// What a factor's path may name beside the numbers that a file holds:
/// - keys that a file may leave out, such as `hinge.k_point`;
/// - `design.walls[k]`: hinge k of the structure (in result.json's order), `t`, `t_mm`, `alpha_deg`,
/// `beta_deg`, `offset_mm`;
/// - `design.columns[c]`: x-walls of a column of cells, `design.rows[r]`: y-walls of a row, as the exact
/// families
///   alternate them: t is the part of the class-A vertex, tilts and offsets change their sign from wall to wall;
/// - `design.hinges[n].t_mm`: t times cell_mm.
/// @param editor a copy of the base's document; keys that the file leaves out are added to it
/// @throws InvalidInput without a place for a path that names nothing, with the nearest that does
std::vector<Match> find_matches(const SweepBase& base, targets::DocumentEditor& editor,
                                const targets::DocumentPath& path);

/// The number as the base has it, in the unit of the edit's key; nothing where the file leaves it out.
std::optional<double> base_value(const SweepBase& base, const targets::DocumentEditor& editor,
                                 const Edit& edit);

/// Writes a structural edit. @param value in the unit of the edit's key @pre kind != document
/// @throws InvalidInput without a place for a value out of range
void apply(const Edit& edit, double value, Design& design);

}  // namespace kinetix::app
