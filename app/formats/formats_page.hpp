#pragma once

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

}  // namespace kinetix::app
