#pragma once

#include <span>
#include <string_view>

namespace kinetix::app {

struct Asset {
  std::string_view path, type, content;
};
std::span<const Asset> studio_assets();

}  // namespace kinetix::app
