#pragma once

#include "app/imports/import_command.hpp"
#include "model/assembly/assembly.hpp"
#include "targets/document/keys.hpp"

namespace kinetix::app {

/// Shells of a model, mm, with notes on how they were read.
struct ModelParts {
  std::vector<model::ModelPart> parts;  ///< names of letters, digits, `_`, `-` and `.`, each once
  std::string unit;                     ///< in words: "millimetres, as the file says"
  std::string softness;                 ///< in words: how soft parts were recognised
  /// Fault of a file of several materials, none of which is known to be soft; empty: none. Its parts are hard, so it is
  /// a fault only if there are no pins.
  std::string unclear = {};
  std::string source;  ///< the files
};

/// Reads the files of a request, scales them to mm, splits their meshes into parts and decides which are soft.
/// @throws InvalidInput for unreadable files, unknown units, unknown soft materials and repeated parts.
ModelParts read_model_parts(const ImportRequest& request);

/// Returns the keys of an import's side file.
const targets::KeyTable& hinge_choice_keys();

/// Reads the axes of hinges from a side file: `hinges: [{hinge: NAME, axis: [x, y, z]}, {bodies: [A, B], axis: ...}]`.
/// `towards: [x, y, z]` is for all ambiguous hinges that it does not name. @throws InvalidInput with the place in the
/// file
model::HingeChoices read_hinge_choices(const std::string& file);

}  // namespace kinetix::app
