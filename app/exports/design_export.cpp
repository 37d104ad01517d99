#include "app/exports/design_export.hpp"

namespace kinetix::app {

DesignFile written_design(const Run& run) {
  DesignFile design;
  design.name = run.name;
  design.structure = run.structure;
  design.theta = run.equilibrium ? run.equilibrium->drive.theta() : run.theta;
  design.physics = run.physics;
  design.hinge = run.hinge;
  design.own_hinges = run.own_hinges;
  design.drive = run.drive;
  design.side = run.side;
  if (run.process != model::processes().front()) design.process = run.process;
  return design;
}

namespace {

std::vector<NamedContent> write_design(const Run& run) {
  return {{"design.yaml", design_text(written_design(run))}};
}

}  // namespace

// Name, extensions, whether every run writes it, and how: design.yaml.
const Exporter design_export = {"design", {"yaml"}, true, write_design};

}  // namespace kinetix::app
