#pragma once

#include "app/files/design_file.hpp"
#include "app/studio/messages/message.hpp"

namespace kinetix::app::studio {

/// What a command of the page makes of a design (docs/studio.md): `hinge`, `paint`, `sheet`, `made`.
/// @throws InvalidInput for what the design cannot be
DesignFile with_hinges(DesignFile design, const Message& message);
DesignFile with_cell(DesignFile design, const Message& message);
DesignFile with_sheet(DesignFile design, const Message& message);
DesignFile with_made_hinges(DesignFile design, const Message& message);

}  // namespace kinetix::app::studio
