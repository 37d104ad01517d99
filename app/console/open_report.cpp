#include "app/console/open_report.hpp"

#include <spawn.h>

#include <cstring>
#include <iostream>

extern char** environ;

namespace kinetix::app {

void open_report(const std::string& path) {
  std::string program = "xdg-open", file = path;
  char* words[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, words[0], nullptr, nullptr, words, environ);
  if (error != 0) std::cerr << path << " cannot be shown: xdg-open: " << std::strerror(error) << "\n";
}

}  // namespace kinetix::app
