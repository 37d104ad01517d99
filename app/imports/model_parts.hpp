#pragma once

#include <string>
#include <vector>

#include "app/imports/import_request.hpp"
#include "model/assembly/assembly.hpp"

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

}  // namespace kinetix::app
