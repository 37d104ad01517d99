#pragma once

#include <nlohmann/json.hpp>

#include "app/studio/assembly/assembly_player.hpp"

namespace kinetix::app::studio {

/// The message `hello` of docs/studio.md, of a design of bodies.
nlohmann::ordered_json assembly_hello(const std::string& name);
/// `meshes`: the surfaces of bodies and soft parts at rest.
nlohmann::ordered_json meshes_message(const model::Assembly& assembly);
/// What is known of the way of the driven hinge: it is found first, and then looked through for bodies that meet.
struct WayKnown {
  bool followed = false, looked_through = false;
  std::array<std::optional<Meeting>, 2> meets = {};  ///< on the way back and forth
};

/// `design`
nlohmann::ordered_json assembly_design(const AssemblyPlayer& player, int revision, const WayKnown& known);
/// `state`
nlohmann::ordered_json assembly_state(const AssemblyPlayer& player);

}  // namespace kinetix::app::studio
