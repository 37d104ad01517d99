#pragma once

#include <nlohmann/json.hpp>

#include "app/studio/play/player.hpp"
#include "app/studio/play/shape.hpp"

namespace kinetix::app::studio {

/// The message `hello` of docs/studio.md. @param is_made of what designs are made and made into; of bodies nothing is
nlohmann::ordered_json hello_message(const std::string& name);
/// `design`, without what the session alone knows: revision, undo, redo, unsaved.
nlohmann::ordered_json design_message(const Design& design, const Moving& moving);
/// `state`, without whether a search is going on.
nlohmann::ordered_json state_message(const Player& player);
/// `error`. @param id of the command that it answers; 0: of none   @param about type of the command that failed; empty: none
nlohmann::ordered_json error_message(const std::string& what, double id, const std::string& about);
/// `progress`, without the time that is left. @param done 0 to 1; negative: not known
nlohmann::ordered_json progress_message(const char* job, const std::string& stage, double done,
                                        const std::string& so_far);

/// `meshes`: the surfaces of bodies and soft parts at rest.
nlohmann::ordered_json meshes_message(const model::Assembly& assembly);
/// `design` of bodies, likewise without what the session alone knows. @pre moving.bodies
nlohmann::ordered_json bodies_message(const Design& design, const Moving& moving);

}  // namespace kinetix::app::studio
