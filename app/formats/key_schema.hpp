#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "targets/document/keys.hpp"

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

/// What a value may be, with its range and unit; Markdown.
std::string type_text(const targets::ValueType& type);

/// What holds where the key is not given, or when it must be; Markdown.
std::string default_text(const targets::Key& key, const targets::Alternatives& ways);

/// Meaning, unit and rule of the default without marks, for an editor's hint.
std::string plain_text(const targets::Key& key);

/// The anchor that a heading gets, as GitHub makes it.
std::string anchor(const std::string& heading);

}  // namespace kinetix::app
