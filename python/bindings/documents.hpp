#pragma once

#include <string>

#include "model/base/invalid_input.hpp"
#include "targets/document/document.hpp"

namespace kinetix::python {

/// Text that stands for a dict of Python: what is wrong with it is told by its key alone, since its user knows no lines.
/// @param read takes the document; whatever is wrong in other files keeps its place
/// @param file whose folder relative paths start from; its name names what has no `name`
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
