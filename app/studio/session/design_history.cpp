#include "app/studio/session/design_history.hpp"

namespace kinetix::app::studio {
namespace {

constexpr std::size_t longest =
    100;  // steps back: more than anybody remembers, and 100 MB of the largest sheets

}  // namespace

void DesignHistory::add(DesignFile design, int thing) {
  designs_.resize(at_ + 1);
  if (saved_ > static_cast<int>(at_)) saved_ = -1;
  designs_.push_back({std::move(design), thing, {}});
  if (designs_.size() > longest) {
    designs_.erase(designs_.begin());
    saved_ = std::max(saved_ - 1, -1);
  }
  at_ = designs_.size() - 1;
}

bool DesignHistory::undo() {
  if (!can_undo()) return false;
  --at_;
  return true;
}

bool DesignHistory::redo() {
  if (!can_redo()) return false;
  ++at_;
  return true;
}

}  // namespace kinetix::app::studio
