#pragma once

#include <string>

namespace kinetix::app {

/// Rejects a file that a YAML file can name, or that `import` reads: points, pictures, meshes, drawings, crease patterns
/// and 3D models. The message has the lines of a YAML file that uses it.
/// @param file of a command line that expects a YAML file; it need not exist @throws InvalidInput for such a file
void refuse_wrong_file(const std::string& file);

}  // namespace kinetix::app
