#pragma once

#include "app/files/design_file.hpp"
#include "app/studio/messages/message.hpp"

namespace kinetix::app::studio {

/// Designs after a command of the page (studio-protocol.md): `hinge`, `paint`, `sheet`, `made`, `driven`.
/// @throws InvalidInput if the design cannot be changed so
Design with_hinges(Design design, const Message& message);
Design with_cell(Design design, const Message& message);
Design with_sheet(Design design, const Message& message);
Design with_manufactured_hinges(Design design, const Message& message);
Design with_driven_hinge(Design design, const Message& message);

}  // namespace kinetix::app::studio

namespace kinetix::app {
struct Run;
}

namespace kinetix::app::studio {

/// Result that a design belongs to.
struct DesignResult {
  std::shared_ptr<const Run> run = {};  ///< search of this session; null: none
  nlohmann::ordered_json message = {};  ///< message of the result; null: none
  double theta = 0;                     ///< theta of the design when it was found, rad
};

/// A design and its predecessors. Each has the number of its thing; edits keep that number.
class DesignHistory {
 public:
  explicit DesignHistory(Design first);

  const Design& current() const { return designs_[at_].design; }
  int thing() const { return designs_[at_].thing; }
  const DesignResult& design_result() const { return designs_[at_].design_result; }
  /// Sets the finding of the present design. Undo and redo keep it.
  void set_design_result(DesignResult design_result) {
    designs_[at_].design_result = std::move(design_result);
  }
  /// Adds the next design and drops those that were undone.
  void add(Design design, int thing, DesignResult design_result = {});
  bool can_undo() const { return at_ > 0; }
  bool can_redo() const { return at_ + 1 < designs_.size(); }
  /// @return whether a step could be undone
  bool undo();
  /// @return whether a step could be redone
  bool redo();
  void mark_saved() { saved_ = static_cast<int>(at_); }
  bool is_saved() const { return saved_ == static_cast<int>(at_); }

 private:
  struct Entry {
    Design design;
    int thing;
    DesignResult design_result;
  };

  std::vector<Entry> designs_;
  std::size_t at_ = 0;
  int saved_ = 0;  ///< index of the saved design; -1: none
};

}  // namespace kinetix::app::studio
