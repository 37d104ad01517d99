#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <string>

namespace kinetix::app::studio {

/// A message for pages, all of which share its bytes.
struct Text {
  std::string type;  ///< of the message
  std::shared_ptr<const std::string> bytes;
};

/// Texts that wait for a page. Messages that describe the present (docs/studio.md, "What the page is told") wait once: a newer one
/// takes the place of the older. Only the others add up, and are counted.
class WaitingTexts {
 public:
  void add(Text text);
  bool empty() const { return texts_.empty(); }
  /// Removes the first. @pre not empty
  Text take();
  /// Bytes of the messages that add up.
  std::size_t counted_bytes() const { return counted_; }

 private:
  std::list<Text> texts_;
  std::size_t counted_ = 0;
};

}  // namespace kinetix::app::studio
