#pragma once

#include <string>
#include <vector>

#include "app/imports/import_request.hpp"
#include "model/assembly/assembly.hpp"
#include "targets/document/keys.hpp"

namespace kinetix::app {

/// The shells of a model, mm, and how they were read.
struct ModelParts {
  std::vector<model::ModelPart> parts;  ///< names of letters, digits, `_`, `-` and `.`, each once
  std::string unit;                     ///< in words: "millimetres, as the file says"
  std::string softness;                 ///< in words: what made parts soft
  std::string source;                   ///< the files
};

/// Reads the files of a request, brings them to mm, takes their meshes apart and tells hard parts from soft ones.
/// @throws InvalidInput for files that cannot be read, sizes that no unit explains, and materials of which none says that it is soft
ModelParts read_model_parts(const ImportRequest& request);

/// Keys of the side file of an import.
const targets::KeyTable& hinge_choice_keys();

/// What a side file says of hinges: `hinges: [{hinge: NAME, axis: [x, y, z]}, {bodies: [A, B], axis: ...}]`, and `towards: [x, y, z]` for all
/// ambiguous ones that it does not name. @throws InvalidInput with the place in the file
model::HingeChoices read_hinge_choices(const std::string& file);

}  // namespace kinetix::app
