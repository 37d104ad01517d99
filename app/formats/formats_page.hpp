#pragma once

#include <nlohmann/json_fwd.hpp>

#include "targets/document/keys.hpp"

namespace kinetix::app {

/// Function that returns the text of the schema of a name, such as "result" or "sweep".
using SchemaText = std::string (*)(const std::string& name);

/// A page of docs/reference.
struct FormatsPage {
  std::string name;  ///< "design.md"
  std::string text;
};

/// Returns the pages of docs/reference about files: the prose of a template, with tables of keys in place of its marks.
/// @param text template. A line `{{page NAME}}` begins a page. `{{keys NAME}}`, NAME of all_keys(), becomes a table of
/// keys. `{{metrics}}` becomes the metrics of all kinds of goals. `{{json NAME}}` becomes the keys of
/// app/schema/NAME.schema.json. Links to a heading, such as (#verdict), find the page that has it.
/// @throws InvalidInput for an unknown mark or heading, a table that is left out, and a key without meaning
std::vector<FormatsPage> formats_pages(const std::string& text, SchemaText schema);

/// Map whose keys the page of formats lists together: a whole file, or a section that several files share.
struct KeyList {
  std::string name;  ///< "target curve", "design", "doe", "Section physics"
  const targets::KeyTable* keys;
};

/// Returns every key of every file that the program reads, in the order of the documentation. The readers use the same
/// tables.
std::vector<KeyList> all_keys();

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
