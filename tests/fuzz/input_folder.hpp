#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "model/base/invalid_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::fuzz {

/// A folder for input files, with links to all files of targets/shapes and targets/sweeps, which inputs may name. It is
/// in TMPDIR, preferably in memory. It is removed with the process, except after a crash.
class InputFolder {
 public:
  InputFolder() {
    namespace fs = std::filesystem;
    for (const char* shipped : {"targets/shapes", "targets/sweeps"})
      for (const auto& file : fs::directory_iterator(fs::path(KINETIX_SOURCE) / shipped))
        fs::create_symlink(file.path(), folder_.path(file.path().filename().string()));
  }

  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string write(const std::string& name, const std::string& content) const {
    return folder_.write(name, content);
  }
  std::string write(const std::string& name, const std::uint8_t* data, std::size_t size) const {
    return write(name, std::string(reinterpret_cast<const char*>(data), size));
  }

 private:
  testing::TemporaryFolder folder_;
};

inline const InputFolder& input_folder() {
  static const InputFolder folder;
  return folder;
}

/// Ends the process, so that the fuzzer keeps the input.
[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

/// Reads an input. An invalid input must give an InvalidInput of one line: any other exception ends the process.
template <class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const InvalidInput& e) {
    const std::string message = e.what();
    if (message.empty() || message.find('\n') != std::string::npos) fail("not one line: '" + message + "'");
  }
}

}  // namespace kinetix::fuzz
