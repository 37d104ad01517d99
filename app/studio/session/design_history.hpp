#pragma once

#include <vector>

#include "app/files/design_file.hpp"

namespace kinetix::app::studio {

/// A design and those that it came from, each with the number of the thing that it is a state of: edits stay with theirs.
class DesignHistory {
 public:
  explicit DesignHistory(DesignFile first) : designs_{{std::move(first), 0}} {}

  const DesignFile& current() const { return designs_[at_].design; }
  int thing() const { return designs_[at_].thing; }
  /// The next design, in the place of those that were undone.
  void add(DesignFile design, int thing);
  bool can_undo() const { return at_ > 0; }
  bool can_redo() const { return at_ + 1 < designs_.size(); }
  /// @return whether there was anything to undo
  bool undo();
  /// @return whether there was anything to redo
  bool redo();
  void mark_saved() { saved_ = static_cast<int>(at_); }
  bool is_saved() const { return saved_ == static_cast<int>(at_); }

 private:
  struct Entry {
    DesignFile design;
    int thing;
  };

  std::vector<Entry> designs_;
  std::size_t at_ = 0;
  int saved_ = 0;  ///< index of the one that is on the disk; -1: none of these
};

}  // namespace kinetix::app::studio
