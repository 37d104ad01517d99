#include "app/studio/messages/waiting_texts.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace kinetix::app::studio {
namespace {

constexpr std::array<std::string_view, 7> present = {"hello", "meshes", "design",  "state",
                                                     "path",  "result", "progress"};

bool adds_up(const Text& text) {
  return std::find(present.begin(), present.end(), text.type) == present.end();
}

}  // namespace

void WaitingTexts::add(Text text) {
  if (adds_up(text)) {
    counted_ += text.bytes->size();
    texts_.push_back(std::move(text));
    return;
  }
  const auto first = [this](std::string_view type) {
    return std::find_if(texts_.begin(), texts_.end(), [&](const Text& one) { return one.type == type; });
  };
  const auto older = first(text.type);
  // Results and paths must follow the design that they belong to, and a design must follow its meshes.
  if (older != texts_.end() && (text.type == "design" || text.type == "meshes")) {
    *older = std::move(text);
    return;
  }
  texts_.insert(text.type == "meshes" ? first("design") : texts_.end(), std::move(text));
  if (older != texts_.end()) texts_.erase(older);
}

Text WaitingTexts::take() {
  Text first = std::move(texts_.front());
  texts_.pop_front();
  if (adds_up(first)) counted_ -= first.bytes->size();
  return first;
}

}  // namespace kinetix::app::studio
