#include "app/exports/design_export.hpp"

#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

/// What the fold was asked for, rad, wherever its equilibrium came to. Plates on a sheet of another lattice than squares, for which
/// the file has no drive, need not close in by the cosine of it.
double asked_theta(const Run& run) {
  if (!run.equilibrium) return run.theta;
  const model::LinkageDrive& drive = run.equilibrium->drive;
  const bool is_by_cosine =
      run.drive || run.structure.squares() || drive.kind != model::LinkageDrive::Kind::plates;
  if (is_by_cosine || !run.plan.exact) return drive.theta();
  try {
    return run.plan.exact.theta_of(drive);
  } catch (const InvalidInput&) {
    return drive.theta();
  }
}

}  // namespace

DesignFile written_design(const Run& run) {
  DesignFile design;
  design.name = run.name;
  design.structure = run.structure;
  design.theta = asked_theta(run);
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
