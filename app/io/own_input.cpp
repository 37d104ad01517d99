#include "app/io/own_input.hpp"

#include <filesystem>
#include <system_error>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

bool would_replace(const std::string& input, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code missing;  // of a file that is not there yet, which is not the input
  return fs::equivalent(input, fs::path(folder) / "design.yaml", missing) ||
         fs::equivalent(input, fs::path(folder) / "result.json", missing);
}

}  // namespace

std::string folder_beside_input(const std::string& input, const std::string& folder, bool is_given) {
  if (!would_replace(input, folder)) return folder;
  if (is_given)
    throw InvalidInput("results in " + folder + " would replace this file; give another folder: -o DIR",
                       {input});
  return folder + "_2";
}

}  // namespace kinetix::app
