#include "app/exports/design_export.hpp"

#include "app/files/bodies_section.hpp"

namespace kinetix::app {
namespace {

std::vector<NamedContent> write_design(const Run& run, const nlohmann::ordered_json&) {
  return design_files(written_design(run));
}

}  // namespace

// Name, extensions, whether every run writes it, and how: design.yaml, and meshes of imported bodies.
const Exporter design_export = {"design", {"yaml", "stl"}, true, write_design};

}  // namespace kinetix::app
