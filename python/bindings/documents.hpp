#pragma once

#include "model/base/invalid_input.hpp"
#include "targets/document/document.hpp"

namespace kinetix::python {

/// Reads the text of a Python dict as a document. Errors name the key alone, since a dict has no lines.
/// @param read takes the document; errors in other files keep their place
/// @param file relative paths start from its folder; its name names documents without a `name`
template <class Read>
auto read_dict(const std::string& text, const std::string& file, Read read) {
  try {
    return read(targets::parse_document(text, file));
  } catch (const InvalidInput& e) {
    if (e.place().file != file) throw;
    throw InvalidInput(e.reason(), {"", 0, 0, e.place().key});
  }
}

}  // namespace kinetix::python
