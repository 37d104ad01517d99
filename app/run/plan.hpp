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

/// What computes a scene's state.
enum class Model { exact, equilibrium, bullet };

std::string to_string(Model model);

/// What a scene needs to compute, decided before anything is computed.
struct Plan {
  model::ExactMotion exact;  ///< of its family; without a motion where there is none
  Model model = Model::exact;
  bool planar = false;  ///< all hinges stand upright: an equilibrium stays in the plane z = 0
  std::optional<model::Mobility> mobility;  ///< empty for structures too large to be worth it
  std::optional<model::ContactRange>
      free_range;                ///< theta without walls touching; empty outside the exact families
  std::vector<std::string> why;  ///< one sentence per decision
  std::size_t decided = 0;       ///< of `why`: the first of them are make_plan's, others what a scene adds

  /// Whether it is known to move in more than one way.
  bool is_floppy() const { return mobility && mobility->dofs_along > 1; }
};

/// Plans a scene. @param model nothing: exact where a family fits, else bullet   @param exact motion of the sheet, where it is known
Plan make_plan(const model::Lattice& sheet, std::optional<Model> model = {}, model::ExactMotion exact = {});
/// Plans no more than what computes the state: without mobility, range and sentences.
Plan make_brief_plan(const model::Lattice& sheet, std::optional<Model> model = {},
                     model::ExactMotion exact = {});

}  // namespace kinetix::app
