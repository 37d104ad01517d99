#pragma once

#include <string>
#include <string_view>

namespace kinetix {

/// Writes a whole file or nothing: beside its place under the name `.NAME.kinetix-part-XXXXXX`, flushed to
/// the disk, then renamed. A file that was there before is replaced in one step; on failure it stays and the
/// part is removed.
/// @throws InvalidInput naming the folder or file and the reason
void write_file(const std::string& file, std::string_view content);

/// From now on an interrupt, a hangup or a request to terminate removes the part that is being written, then
/// ends the program as it would have. For programs that write from one thread.
void remove_parts_when_interrupted();

/// Creates the folder with its parents where it does not exist, and proves that files can be written in it.
/// Meant to be called before any work is done. @throws InvalidInput naming the folder and the reason
void prepare_output_folder(const std::string& folder);

}  // namespace kinetix
