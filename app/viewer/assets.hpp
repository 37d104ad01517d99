#pragma once

#include <span>
#include <string_view>

namespace kinetix::app {

/// File that the studio's server offers.
struct Asset {
  std::string_view path;  ///< path in a browser's request; "/" for the page
  std::string_view type;  ///< content type
  std::string_view content;
};

/// Returns the studio's page with its script and style; empty if the program was built without npm.
std::span<const Asset> studio_assets();

/// Returns the script of the three-dimensional view, which defines `KinetixScene`; empty if the program was
/// built without npm.
std::string_view scene_script();

}  // namespace kinetix::app
