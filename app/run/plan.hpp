#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::app {

/// Model that computes a scene's state.
enum class Model { exact, equilibrium, bullet };

std::string to_string(Model model);

/// Decisions on how to compute a scene, made before anything is computed.
struct Plan {
  model::ExactMotion exact;  ///< motion of its family; without a motion outside the exact families
  Model model = Model::exact;
  bool planar = false;  ///< all hinges stand upright: an equilibrium stays in the plane z = 0
  std::optional<model::Mobility> mobility;  ///< empty if not computed, as for large structures
  std::optional<model::ContactRange>
      free_range;                ///< theta without contact of walls; empty outside the exact families
  std::vector<std::string> why;  ///< one sentence per decision
  std::size_t decided = 0;       ///< number of sentences in `why` by make_plan; a scene adds the others

  /// Whether it is known to have several degrees of freedom.
  bool is_floppy() const { return mobility && mobility->dofs_along > 1; }
};

/// Plans a scene. @param model empty: exact if a family fits, otherwise bullet
/// @param exact motion of the sheet, if known
Plan make_plan(const model::Lattice& sheet, std::optional<Model> model = {}, model::ExactMotion exact = {});
/// Plans only what computes the state: no mobility, range or sentences.
Plan make_brief_plan(const model::Lattice& sheet, std::optional<Model> model = {},
                     model::ExactMotion exact = {});

}  // namespace kinetix::app
