#include "targets/document/json_depth.hpp"

#include "targets/document/document.hpp"

namespace kinetix::targets {

std::optional<std::size_t> find_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_string && c == '\\') ++k;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if ((c == '[' || c == '{') && ++depth > max_document_depth) return k;
    if (c == ']' || c == '}') --depth;
  }
  return std::nullopt;
}

}  // namespace kinetix::targets
