#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace kinetix {

/// Writes a whole file or nothing: beside its place under the name `.NAME.kinetix-part-XXXXXX`, flushed to
/// the disk, then renamed. A file that was there before is replaced in one step; on failure it stays and the
/// part is removed.
/// @throws InvalidInput naming the folder or file and the reason
void write_file(const std::string& file, std::string_view content);

/// Takes the next piece of a file.
using FileSink = std::function<void(std::string_view)>;
/// The same for content that comes in pieces. Whatever `produce` throws leaves the file as it was.
void write_file(const std::string& file, const std::function<void(const FileSink&)>& produce);

/// From now on an interrupt, a hangup or a request to terminate removes the part that is being written, then
/// ends the program as it would have. For programs that write from one thread: the one that calls this.
void remove_parts_when_interrupted();

/// A folder for results. It is created with its parents where it does not exist, and proven writable, before
/// any work is done; what was created goes again, if still empty, unless keep() is called.
class OutputFolder {
 public:
  /// @throws InvalidInput naming the folder and the reason
  explicit OutputFolder(const std::string& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::string& path() const { return path_; }
  void keep() { created_.clear(); }

 private:
  void remove_created();

  std::string path_;
  std::vector<std::string> created_;  // innermost first
};

}  // namespace kinetix
