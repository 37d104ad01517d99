#include "app/viewer/assets.hpp"
namespace kinetix::app {
std::span<const Asset> studio_assets() {
  static const Asset all[] = {{"/", "text/html; charset=utf-8", "<!DOCTYPE html><title>studio</title>"}};
  return all;
}
}  // namespace kinetix::app
