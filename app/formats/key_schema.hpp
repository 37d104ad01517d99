#pragma once

#include <nlohmann/json_fwd.hpp>

#include "targets/document/keys.hpp"

namespace kinetix::app {

/// A JSON Schema (draft 07) of files that the program reads.
struct FileSchema {
  std::string name;  ///< of app/schema/<name>.schema.json
  std::string text;
};

/// Returns the schemas of target.yaml, design.yaml (of sheets and of bodies), an import's hinges and doe.yaml. They
/// are made from the tables by which the files are read. The program refuses every file that a schema refuses. Schemas
/// do not see keys that depend on each other, nor the content of other files.
std::vector<FileSchema> file_schemas();

/// Describes the allowed values with range and unit, in Markdown.
std::string type_text(const targets::ValueType& type);

/// Describes the default of a key, or when the key is needed, in Markdown.
std::string default_text(const targets::Key& key, const targets::Alternatives& alternatives);

/// Returns meaning, unit and rule of the default without Markdown, for an editor's hint.
std::string plain_text(const targets::Key& key);

/// Returns the meaning of a key with its earlier names, in Markdown.
std::string meaning_text(const targets::Key& key);

/// Returns the anchor that GitHub makes of a heading.
std::string anchor(const std::string& heading);

}  // namespace kinetix::app
