#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/assembly/assembly_file.hpp"
#include "app/assembly/body_pieces.hpp"
#include "app/result/verdict.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/assembly_motion.hpp"
#include "model/assembly/deployment.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::app {

/// One forward run of a design of general bodies.
struct AssemblyRun {
  AssemblyFile file;
  model::Linkage linkage;
  Model model = Model::exact;
  int driven = -1;   ///< hinge; -1: bodies are pulled
  double theta = 0;  ///< of the drive, rad: half the turn of its hinge; pulled: mean_half_turn in the end
  model::AssemblyMotion
      motion;  ///< closed states on the way; pulled: its turns are twice their mean_half_turn
  std::optional<model::Deployment> deployment = {};  ///< where bodies are pulled: how far they follow
  std::vector<NamedState> states;  ///< the last one of each model first, then those of the motion
  std::optional<model::EquilibriumPath> equilibrium;
  std::optional<Verification> verification;
  std::shared_ptr<const BodyPieces> pieces;  ///< by which bodies collide; null where nothing asked for them
  double closure_s = 0, equilibrium_s = 0, load_s = 0;  ///< seconds

  /// The way of motion state k, rad: what the drive's theta has come to.
  double theta_of(std::size_t k) const;
  model::LinkageDrive drive() const;
};

/// @param theta in place of the file's own drive, rad
/// @param pieces of a run before with the same bodies, to be used again where they fit; null: none
/// @throws InvalidInput for a drive that turns a hinge which cannot turn at rest; where bodies are pulled, for a theta and for the
/// model equilibrium, which wants hinges with an axis as well
AssemblyRun run_assembly(AssemblyFile file, Model model, std::optional<double> theta,
                         const RunOptions& options, std::shared_ptr<const BodyPieces> pieces = {});

/// Stiffnesses of the hinges of an assembly, each its own.
model::Elasticity elasticity_of(const model::Assembly& assembly);

/// The verdict on a run of bodies: `met` of those that are pulled to poses, within AssemblyFile::pull_tolerance.
RunVerdict verdict_of(const AssemblyRun& run);

/// How far the closed states go, in a sentence.
std::string closure_words(const AssemblyRun& run);

/// Its bodies and hinges, as in results.
nlohmann::ordered_json assembly_structure(const model::Assembly& assembly);

/// Of schema kinetix-result/1.
nlohmann::ordered_json assembly_result(const AssemblyRun& run);
/// What a person reads on stdout.
std::string assembly_summary(const AssemblyRun& run);

}  // namespace kinetix::app
