#pragma once

#include <string>

namespace kinetix::targets {

/// Guard that stops in_ticks() of this thread from quoting a file outside the folder of the document that names it. A
/// stranger's target may name any file of the machine, and messages are sent to strangers.
class HiddenQuotes {
 public:
  /// @param file as it is opened   @param folder of the document that names it; empty: the working folder
  HiddenQuotes(const std::string& file, const std::string& folder);
  ~HiddenQuotes();
  HiddenQuotes(const HiddenQuotes&) = delete;
  HiddenQuotes& operator=(const HiddenQuotes&) = delete;

 private:
  bool before_;
};

}  // namespace kinetix::targets
