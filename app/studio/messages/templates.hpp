#pragma once

#include <string_view>
#include <vector>

#include "app/files/design_file.hpp"

namespace kinetix::app::studio {

/// A design to start from, flat, of stiff hinges.
struct Template {
  std::string_view name, about;
  Design (*make)();
};

const std::vector<Template>& templates();
/// @throws InvalidInput for a name that none has
Design template_design(std::string_view name);

}  // namespace kinetix::app::studio
