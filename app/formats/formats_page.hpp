#pragma once

#include <string>
#include <vector>

#include "targets/document/keys.hpp"

namespace kinetix::app {

/// The text of the schema of a name, "result" or "sweep".
using SchemaText = std::string (*)(const std::string& name);

/// docs/formats.md: a template's prose with the tables of keys in their places.
/// @param page lines `{{keys NAME}}`, NAME of all_keys(), stand for a table; `{{metrics}}` for the metrics
/// of all kinds of goals; `{{json NAME}}` for the keys of app/schema/NAME.schema.json
/// @throws InvalidInput for a mark that is not known, a table that the page leaves out, and a key without
/// meaning
std::string formats_page(const std::string& page, SchemaText schema);

/// A map whose keys the page of formats lists together: a whole file, or a section that several files share.
struct KeyList {
  std::string name;  ///< "target curve", "design", "doe", "Section physics"
  const targets::KeyTable* keys;
};

/// Every key of every file that the program reads, in the order of the documentation. The readers read by
/// the same tables.
std::vector<KeyList> all_keys();

}  // namespace kinetix::app
