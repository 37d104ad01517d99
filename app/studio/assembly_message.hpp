#pragma once

#include <nlohmann/json.hpp>

#include "app/studio/assembly_player.hpp"

namespace kinetix::app::studio {

/// The message `hello` of docs/studio.md, of a design of bodies.
nlohmann::ordered_json assembly_hello(const std::string& name);
/// `meshes`: the surfaces of bodies and soft parts at rest.
nlohmann::ordered_json meshes_message(const model::Assembly& assembly);
/// `design`. @param following whether the way of the driven hinge is still being found
nlohmann::ordered_json assembly_design(const AssemblyPlayer& player, int revision, bool following);
/// `state`
nlohmann::ordered_json assembly_state(const AssemblyPlayer& player);

}  // namespace kinetix::app::studio
