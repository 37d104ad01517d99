#pragma once

#include <nlohmann/json.hpp>

#include "app/studio/play/player.hpp"
#include "app/studio/play/shape.hpp"

namespace kinetix::app::studio {

/// Returns the message `hello` of docs/studio.md.
nlohmann::ordered_json hello_message(const std::string& name);
/// Returns the message `design` without what only the session knows: revision, undo, redo, unsaved.
nlohmann::ordered_json design_message(const Design& design, const Moving& moving);
/// Returns the message `state` without whether a search is running.
nlohmann::ordered_json state_message(const Player& player);
/// Returns the message `error`.
/// @param id id of the command that it answers; 0: none   @param about type of the command that failed;
/// empty: none
nlohmann::ordered_json error_message(const std::string& what, double id, const std::string& about);
/// Returns the message `progress` without the time left. @param done 0 to 1; negative: not known
nlohmann::ordered_json progress_message(const char* job, const std::string& stage, double done,
                                        const std::string& so_far);

/// Returns the message `meshes`: the surfaces of bodies and soft parts at rest.
nlohmann::ordered_json meshes_message(const model::Assembly& assembly);
/// Returns the message `design` of a design of bodies, without what only the session knows. @pre
/// moving.bodies
nlohmann::ordered_json bodies_message(const Design& design, const Moving& moving);

}  // namespace kinetix::app::studio
