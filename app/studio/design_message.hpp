#pragma once

#include <nlohmann/json.hpp>

#include "app/studio/player.hpp"

namespace kinetix::app::studio {

/// The message `hello` of docs/studio.md.
nlohmann::ordered_json hello_message(const std::string& name);
/// `design`, without what the session alone knows: revision, undo, redo, unsaved.
nlohmann::ordered_json design_message(const DesignFile& design, const Moving& moving);
/// `state`, without whether a search is going on.
nlohmann::ordered_json state_message(const Player& player);

}  // namespace kinetix::app::studio
