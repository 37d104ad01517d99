#pragma once

#include "app/files/design_file.hpp"

namespace kinetix::app::studio {

/// Flat design with rigid hinges, to start from.
struct Template {
  std::string_view name, about;
  Design (*make)();
};

const std::vector<Template>& templates();
/// @throws InvalidInput for an unknown name
Design template_design(std::string_view name);

}  // namespace kinetix::app::studio
