#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <string>

namespace kinetix::app::studio {

/// Message for pages; all of them share its bytes.
struct Text {
  std::string type;  ///< of the message
  std::shared_ptr<const std::string> bytes;
};

/// Messages that wait for a page. A message that describes the present (docs/studio.md, "What the page is
/// told") replaces an older one of its type. All others accumulate, and their bytes are counted.
class WaitingTexts {
 public:
  void add(Text text);
  bool empty() const { return texts_.empty(); }
  /// Removes and returns the first. @pre not empty
  Text take();
  /// Returns the bytes of the messages that accumulate.
  std::size_t counted_bytes() const { return counted_; }

 private:
  std::list<Text> texts_;
  std::size_t counted_ = 0;
};

}  // namespace kinetix::app::studio
