#include "app/io/own_input.hpp"

#include <filesystem>
#include <system_error>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {

void refuse_own_input(const std::string& input, const std::string& folder) {
  namespace fs = std::filesystem;
  for (const char* name : {"design.yaml", "result.json"}) {
    std::error_code missing;  // of a file that is not there yet, which is not the input
    if (fs::equivalent(input, fs::path(folder) / name, missing))
      throw InvalidInput("results in " + folder + " would replace this file; give another folder: -o DIR",
                         {input});
  }
}

}  // namespace kinetix::app
