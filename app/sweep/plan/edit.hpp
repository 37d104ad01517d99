#pragma once

#include "app/files/design_file.hpp"
#include "app/run/goal.hpp"
#include "app/sweep/plan/doe_file.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// File that a sweep varies: a design (forward runs) or a target (a search in every sample).
struct SweepBase {
  targets::Node root;
  std::optional<Design> design;
  std::optional<Target> target;  ///< empty if the file is a design

  /// Returns whether the base is a design of imported bodies.
  bool has_bodies() const { return design && design->structure.assembly(); }
};

/// @param changes of the base, which options name
/// @throws InvalidInput as read_design and read_target
SweepBase read_base(const std::string& file, const targets::DocumentChanges& changes = {});

/// Lists the numbers that a file of the base's kind may hold, also those that this file leaves out.
std::vector<std::string> optional_keys(const SweepBase& base);

/// Returns a message such as "the base has no number at `design.tetha_deg`. Did you mean `design.theta_deg`?".
std::string describe_unknown_path(const SweepBase& base, const targets::DocumentEditor& editor,
                                  const targets::DocumentPath& path);

/// A number of the base that a factor writes.
struct Edit {
  enum class Kind { document, theta_deg, t, t_mm, alpha_deg, beta_deg, offset_mm };

  Kind kind = Kind::document;
  int index = 0;  ///< item of the document, or hinge of the structure
  /// Uses t -> 1 - t, alpha -> 180 - alpha, beta -> -beta, offset -> -offset, as the alternation over a sheet
  /// requires.
  bool flipped = false;
  int factor = 0;              ///< column of the factor
  double times = 1, plus = 0;  ///< see FactorPath; plus in units of the edit's key
  double base = 0;             ///< with `add`: the base's value in the unit of the edit's key
  double unit = 1;             ///< with `scale`: the base's value in the unit of the edit's key

  /// Computes the number to write from a value of the factor. Both are in the unit of the key; with `scale`
  /// the factor has no unit.
  double value(double of_factor) const { return base + unit * (times * of_factor + plus); }
};

/// Number of the base that varies separately, under a path that names it alone. It has more than one edit if
/// a column or a row of walls moves as one.
struct Match {
  std::string path;
  std::vector<Edit> edits;
};

/// Finds the numbers that a factor's path matches. A path may name any number that the file holds. It may
/// also name:
/// - Keys that a file may leave out, such as `hinge.k_point`.
/// - `design.walls[k]`: hinge k of the structure (in result.json's order), with `hinge_position`, `hinge_position_mm`,
/// `alpha_deg`, `tilt_deg` or `offset_mm`.
/// - `design.columns[c]`: x-walls of a column of cells. `design.rows[r]`: y-walls of a row. They alternate as
/// in the exact families: t is the part of the vertex of sublattice A, tilts and offsets change their sign
/// from wall to wall.
/// - `design.hinges[n].hinge_position_mm`: hinge_position times cell_mm.
/// Keys may have their current or their earlier names.
/// @param editor a copy of the base's document. Keys that the file leaves out are added to it.
/// @throws InvalidInput without a place if the path names nothing. The message gives the nearest path that
/// exists.
std::vector<Match> find_matches(const SweepBase& base, targets::DocumentEditor& editor,
                                const targets::DocumentPath& path);

/// Returns the base's number in the unit of the edit's key; empty if the file leaves it out.
std::optional<double> base_value(const SweepBase& base, const targets::DocumentEditor& editor,
                                 const Edit& edit);

/// Writes a number of the structure or its theta. @param value in the unit of the edit's key @pre kind !=
/// document
/// @throws InvalidInput without a place for a value out of range
void apply(const Edit& edit, double value, Design& design);

}  // namespace kinetix::app
