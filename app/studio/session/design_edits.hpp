#pragma once

#include "app/files/design_file.hpp"
#include "app/studio/messages/message.hpp"

namespace kinetix::app::studio {

/// Designs after a command of the page (docs/studio.md): `hinge`, `paint`, `sheet`, `made`, `driven`.
/// @throws InvalidInput if the design cannot be changed so
Design with_hinges(Design design, const Message& message);
Design with_cell(Design design, const Message& message);
Design with_sheet(Design design, const Message& message);
Design with_made_hinges(Design design, const Message& message);
Design with_driven_hinge(Design design, const Message& message);

}  // namespace kinetix::app::studio
