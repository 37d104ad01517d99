#include "app/exports/design_export.hpp"

namespace kinetix::app {
namespace {

std::vector<NamedContent> write_design(const Run& run, const nlohmann::ordered_json&) {
  return {{"design.yaml", design_text(written_design(run))}};
}

}  // namespace

// Name, extensions, whether every run writes it, and how: design.yaml.
const Exporter design_export = {"design", {"yaml"}, true, write_design};

}  // namespace kinetix::app
