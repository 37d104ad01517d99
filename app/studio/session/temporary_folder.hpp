#pragma once

#include <filesystem>
#include <memory>

namespace kinetix::app::studio {

/// Makes a folder that is removed with its last owner. @throws InvalidInput if it cannot be made
std::shared_ptr<const std::filesystem::path> make_temporary_folder();
/// Removes all temporary folders that still exist, if the program ends without its owners' destructors.
void remove_temporary_folders();

}  // namespace kinetix::app::studio
