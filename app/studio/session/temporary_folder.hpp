#pragma once

#include <filesystem>
#include <memory>

namespace kinetix::app::studio {

/// A folder that goes with its last owner. @throws InvalidInput where none can be made
std::shared_ptr<const std::filesystem::path> make_temporary_folder();
/// Those that are there, at an end of the program that owners do not see.
void remove_temporary_folders();

}  // namespace kinetix::app::studio
