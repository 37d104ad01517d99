#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/files/design_file.hpp"

namespace kinetix::app {
struct Run;
}

namespace kinetix::app::studio {

/// The result that a design is of.
struct Finding {
  std::shared_ptr<const Run> run = {};  ///< of a search of this session; null: of none
  nlohmann::ordered_json told = {};     ///< the message of the result; null: none is known
  double theta = 0;                     ///< of the design as it was found, rad
};

/// A design and those that it came from, each with the number of the thing that it is a state of: edits stay with theirs.
class DesignHistory {
 public:
  explicit DesignHistory(Design first);

  const Design& current() const { return designs_[at_].design; }
  int thing() const { return designs_[at_].thing; }
  const Finding& finding() const { return designs_[at_].finding; }
  /// Of the present design, which keeps it while others are undone and redone.
  void set_finding(Finding finding) { designs_[at_].finding = std::move(finding); }
  /// The next design, in the place of those that were undone.
  void add(Design design, int thing, Finding finding = {});
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
    Design design;
    int thing;
    Finding finding;
  };

  std::vector<Entry> designs_;
  std::size_t at_ = 0;
  int saved_ = 0;  ///< index of the one that is on the disk; -1: none of these
};

}  // namespace kinetix::app::studio
