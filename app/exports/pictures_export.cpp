#include "app/exports/pictures_export.hpp"

namespace kinetix::app {
namespace {

std::vector<NamedContent> write_pictures(const Run& run, const nlohmann::ordered_json&) {
  if (!run.goal) return {};
  return run.goal->pictures(run, false);
}

}  // namespace

// Name, extensions, whether every run writes it, and how: the pictures.
const Exporter pictures_export = {"pictures", {"svg", "png"}, false, write_pictures};

}  // namespace kinetix::app
