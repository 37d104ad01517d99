#include "app/studio/session/parts.hpp"

#include <fmt/format.h>

#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {

/// Drops all files and refuses further parts.
void Parts::refuse(const std::string& why) {
  files_.clear();
  refusal_ = why;
  throw InvalidInput(why);
}

void Parts::add(const std::string& name, std::int64_t at, const std::string& content) {
  if (at == 0) {
    files_.erase(name);
    refusal_.clear();
  }
  if (!refusal_.empty()) throw InvalidInput(refusal_);
  const auto here = files_.find(name);
  const auto came = static_cast<std::int64_t>(here == files_.end() ? 0 : here->second.size());
  if (at != came)
    throw InvalidInput(
        fmt::format("at: {} of the {} bytes of {} that came; send it again from 0", at, came, name));
  auto all = static_cast<std::int64_t>(content.size());
  for (const auto& [other, text] : files_) all += static_cast<std::int64_t>(text.size());
  if (all > most_part_bytes)
    refuse(
        fmt::format("content: files of a search may have {} MiB in all; name larger ones in a target file "
                    "and start the studio with that",
                    most_part_bytes >> 20));
  if (here == files_.end() && files_.size() >= most_part_files)
    refuse(fmt::format("name: a search takes at most {} files; send those alone that its target names",
                       most_part_files));
  files_[name] += content;
}

}  // namespace kinetix::app::studio
