#include "app/studio/messages/failure_message.hpp"

#include <filesystem>
#include <new>
#include <system_error>

#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {

std::string failure_message(const std::exception& error) {
  if (dynamic_cast<const InvalidInput*>(&error)) return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return "There is not enough memory for this. Take a smaller sheet, or close other programs.";
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    const std::string path =
        file->path1().empty() ? "the folder that the studio was started in" : file->path1().string();
    return path + ": " + file->code().message() + ". Check that it is there and can be written.";
  }
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again)
    return "No further thread or process can be started. Close other programs.";
  return std::string("internal error: ") + error.what();
}

}  // namespace kinetix::app::studio
