#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run/goal_outcome.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/deployment.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// A design of general bodies, as `import` writes it: design.yaml with a mesh beside it for every body and soft part.
struct AssemblyFile {
  std::string name;
  model::Assembly assembly;
  std::optional<int> driven =
      {};            ///< the hinge that is turned; nothing: the one that turns most in the first motion
  double angle = 0;  ///< by which it is turned in the end, rad, in (-pi, pi); 0: at rest
  std::optional<model::State> poses = {};  ///< instead: where bodies are pulled to, mm
  std::optional<double> expand = {};  ///< or: times their distance from the middle, as far as they go, > 0
  double pull_tolerance = 0.05;       ///< rms from `poses` that counts as there, cell edges, > 0

  bool is_pulled() const { return poses || expand; }
  /// What pulls the bodies, moved to where they are; nothing where a hinge is turned.
  std::optional<model::Pull> pull() const;
};

/// Keys of such a file, of which design.schema.json knows nothing: assembly.schema.json does.
const targets::KeyTable& assembly_keys();

/// Whether a design lists bodies: its `structure` has the key `bodies`.
bool is_assembly(const targets::Node& root);

/// @throws InvalidInput for whatever the keys do not allow, names that are not there or there twice, and meshes that are no solids
AssemblyFile read_assembly(const targets::Node& root);

/// design.yaml and the meshes, names and content: they read back to the same, coordinates of meshes rounded to float.
std::vector<NamedContent> assembly_files(const AssemblyFile& file);

}  // namespace kinetix::app
