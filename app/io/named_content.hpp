#pragma once

#include <string>

namespace kinetix::app {

/// A file of a folder: its path there, and its content.
struct NamedContent {
  std::string name, content;
};

}  // namespace kinetix::app
