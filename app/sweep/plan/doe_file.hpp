#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/run/plan.hpp"
#include "optim/doe/sampling.hpp"
#include "targets/document/document_path.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// One path of a factor. What is written there is `times` the factor's value `plus` a constant in the key's
/// unit, so that two keys can go together (`plus: 1, times: -1` gives 1 - k).
struct FactorPath {
  targets::DocumentPath path;
  double times = 1, plus = 0;
};

/// One entry of `factors:`.
struct DoeFactor {
  std::string name;  ///< heading of its column; default: the first path as written
  std::vector<FactorPath> paths;
  /// In the units of the key that it varies; its name is not set. Levels of a grid, ends included, >= 2; 0: not given.
  optim::Factor values;
  bool each = false;   ///< every number that the path matches varies by itself
  bool add = false;    ///< values are added to the base's own
  bool scale = false;  ///< values multiply the base's own
  targets::Node node;  ///< for messages
};

/// The `method:` section.
struct DoeMethod {
  optim::SamplingOptions options =
      {};  ///< without a base point; of factorial and one_at_a_time the levels decide alone
  std::optional<int> levels = {};  ///< of ranges that give none of their own
  targets::Node node;              ///< for messages
};

/// A doe.yaml.
struct DoeFile {
  std::string name;                 ///< default: the file's name without its ending
  std::string base;                 ///< design or target, as a path from where the program runs
  std::optional<std::string> goal;  ///< curve target that shape_rms of designs is measured against
  Model model = Model::exact;
  /// Of the equilibrium model: samples start from the base's own state at the drive's goal, and find the
  /// equilibrium below it, instead of following the load from flat. For small errors, which must not change
  /// the branch.
  bool from_base = false;
  DoeMethod method;
  std::vector<DoeFactor> factors;        ///< at least 1, no two of one name
  std::vector<targets::Node> responses;  ///< their names; at least 1, none twice
  targets::Node root;
};

/// Rows of a table: ten levels of seven factors. A limit, so that a slip in a grid is refused, not laid out.
inline constexpr std::int64_t most_samples = 10'000'000;

/// Every key of a doe.yaml.
const targets::KeyTable& doe_keys();

/// @throws InvalidInput for whatever formats.md does not allow. What the base has to say about paths and
/// values is for SweepPlan to check
DoeFile read_doe(const std::string& file);

}  // namespace kinetix::app
