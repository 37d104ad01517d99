#pragma once

#include <span>
#include <string_view>

namespace kinetix::app {

/// A file that the studio's server gives out.
struct Asset {
  std::string_view path;  ///< as the browser asks for it, "/" for the page
  std::string_view type;  ///< content type
  std::string_view content;
};

/// The studio's page with its script and style; empty where the program was built without npm.
std::span<const Asset> studio_assets();

/// The script of the three-dimensional view, which defines `KinetixScene`; empty where the program was built without npm.
std::string_view scene_script();

}  // namespace kinetix::app
