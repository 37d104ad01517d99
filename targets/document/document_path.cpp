#include "targets/document/document_path.hpp"

#include <algorithm>

#include "model/base/invalid_input.hpp"
#include "targets/document/number.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

constexpr int max_position = 100'000'000;  // in a list: beyond any that a file can hold, within int

InvalidInput malformed(std::string_view text, const std::string& why) {
  return InvalidInput(in_ticks(text) + " is not a path: " + why +
                      "; write keys with points and positions in brackets, e.g. `design.hinges[3].t` or "
                      "`design.hinges[*].t`");
}

PathStep parse_position(std::string_view text, std::string_view inside) {
  if (inside == "*") return {"", PathStep::every};
  const bool digits = !inside.empty() && inside.find_first_not_of("0123456789") == std::string_view::npos;
  if (!digits) throw malformed(text, in_ticks(inside) + " stands in brackets");
  return {"", parse_integer(inside, 0, max_position)};
}

}  // namespace

DocumentPath parse_path(std::string_view text) {
  DocumentPath path;
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == '[') {
      const std::size_t end = text.find(']', at);
      if (end == std::string_view::npos) throw malformed(text, "a `]` is missing");
      if (path.empty()) throw malformed(text, "it starts with a position");
      path.push_back(parse_position(text, text.substr(at + 1, end - at - 1)));
      at = end + 1;
      continue;
    }
    if (!path.empty() && text[at++] != '.') throw malformed(text, "a point is missing");
    const std::size_t end = std::min(text.find_first_of(".[", at), text.size());
    if (end == at) throw malformed(text, "a key is empty");
    path.push_back({std::string(text.substr(at, end - at)), 0});
    at = end;
  }
  if (path.empty()) throw malformed(text, "it is empty");
  return path;
}

std::string to_string(const DocumentPath& path) {
  std::string text;
  for (const PathStep& step : path) {
    if (step.key.empty())
      text += "[" + (step.position == PathStep::every ? "*" : std::to_string(step.position)) + "]";
    else
      text += (text.empty() ? "" : ".") + step.key;
  }
  return text;
}

}  // namespace kinetix::targets
