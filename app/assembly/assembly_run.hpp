#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/assembly/assembly_file.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/assembly_motion.hpp"
#include "sim/contact_parts.hpp"

namespace kinetix::app {

/// One forward run of a design of general bodies.
struct AssemblyRun {
  AssemblyFile file;
  model::Linkage linkage;
  Model model = Model::exact;
  int driven = -1;                 ///< hinge
  double theta = 0;                ///< of the drive, rad: half the turn of its hinge
  model::AssemblyMotion motion;    ///< closed states on the way
  std::vector<NamedState> states;  ///< the last one of each model first, then those of the motion
  std::optional<model::EquilibriumPath> equilibrium;
  std::optional<Verification> verification;
  std::size_t pieces = 0;  ///< convex ones, of all bodies, that collide in the physics run
  double pieces_s = 0;     ///< that they took, s
  double closure_s = 0, equilibrium_s = 0, load_s = 0;  ///< seconds

  /// Whether the model came to the drive's end.
  bool reached() const;
};

/// @param theta in place of the file's own drive, rad
/// @throws InvalidInput for a drive that turns a hinge which cannot turn at rest
AssemblyRun run_assembly(AssemblyFile file, Model model, std::optional<double> theta,
                         const RunOptions& options);

/// Stiffnesses of the hinges of an assembly, each its own.
model::Elasticity elasticity_of(const model::Assembly& assembly);

/// What its bodies collide with in the physics run. @param threads 0: as many as there are
sim::ContactParts contact_parts_of(const model::Assembly& assembly, int threads);

/// Its bodies and hinges, as in results.
nlohmann::ordered_json assembly_structure(const model::Assembly& assembly);
/// Of schema kinetix-result/1.
nlohmann::ordered_json assembly_result(const AssemblyRun& run);
/// What a person reads on stdout.
std::string assembly_summary(const AssemblyRun& run);

}  // namespace kinetix::app
