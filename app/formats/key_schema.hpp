#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace kinetix::app {

/// A JSON Schema (draft 07) of files that the program reads.
struct FileSchema {
  std::string name;  ///< of app/schema/<name>.schema.json
  std::string text;
};

/// Those of target.yaml, design.yaml and doe.yaml, made of the tables by which the files are read. A file
/// that they refuse the program refuses, but not the other way round: they know nothing of keys that depend
/// on each other, and of what other files hold.
std::vector<FileSchema> file_schemas();

}  // namespace kinetix::app
