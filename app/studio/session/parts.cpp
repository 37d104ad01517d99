#include "app/studio/session/parts.hpp"

#include <fmt/format.h>

#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {

void Parts::add(const std::string& name, int at, const std::string& content) {
  if (at == 0) files_.erase(name);
  const auto here = files_.find(name);
  const std::size_t came = here == files_.end() ? 0 : here->second.size();
  if (static_cast<std::size_t>(at) != came)
    throw InvalidInput(
        fmt::format("at: {} of the {} bytes of {} that came; send it again from 0", at, came, name));
  std::size_t all = content.size();
  for (const auto& [other, text] : files_) all += text.size();
  if (all > most_part_bytes) {
    files_.clear();
    throw InvalidInput(
        fmt::format("content: files of a search may have {} MiB in all; name larger ones in a target file "
                    "and start the studio with that",
                    most_part_bytes >> 20));
  }
  files_[name] += content;
}

}  // namespace kinetix::app::studio
