#pragma once

#include "app/run/plan.hpp"
#include "optim/doe/sampling.hpp"
#include "targets/document/edit_document.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// One path of a factor. A sample writes `times` the factor's value `plus` a constant in the key's unit. Two
/// keys can therefore vary together (`plus: 1, times: -1` gives 1 - k).
struct FactorPath {
  targets::DocumentPath path;
  double times = 1, plus = 0;
};

/// One entry of `factors:`.
struct DoeFactor {
  std::string name;  ///< heading of its column; default: the first path as written
  std::vector<FactorPath> paths;
  /// In the units of the key that it varies; without a name. Levels of a grid include both ends, >= 2; 0: not
  /// given.
  optim::Factor values;
  bool each = false;   ///< every number that the path matches is a separate factor
  bool add = false;    ///< values are added to the base's value
  bool scale = false;  ///< values multiply the base's value
  targets::Node node;  ///< for messages
};

/// The `method:` section.
struct DoeMethod {
  optim::SamplingOptions options = {};  ///< no base point; factorial and one_factor ignore `samples`
  std::optional<int> levels = {};       ///< default of ranges without levels
  targets::Node node;                   ///< for messages
};

/// A doe.yaml.
struct DoeFile {
  std::string name;                 ///< default: the file's name without its ending
  std::string base;                 ///< path of a design or target, from the working directory
  std::optional<std::string> goal;  ///< curve target; shape_rms of designs is measured against it
  Model model = Model::exact;
  /// For the equilibrium model: samples start from the base's state at the drive's goal and find the nearby
  /// equilibrium, instead of following the load from flat. Meant for small errors, which must not change the
  /// branch.
  bool from_base = false;
  DoeMethod method;
  std::vector<DoeFactor> factors;        ///< at least 1, with different names
  std::vector<targets::Node> responses;  ///< names of metrics; at least 1, none twice
  targets::Node root;
};

/// Rows of a table: ten levels of seven factors. The limit rejects a mistyped grid before it is laid out.
inline constexpr std::int64_t max_samples = 10'000'000;

/// Returns every key of a doe.yaml.
const targets::KeyTable& doe_keys();

/// Reads a doe.yaml. @throws InvalidInput for anything that formats.md does not allow. SweepPlan checks paths
/// and values against the base.
DoeFile read_doe(const std::string& file);

}  // namespace kinetix::app
