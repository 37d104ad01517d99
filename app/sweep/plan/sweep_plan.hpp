#pragma once

#include "app/sweep/plan/edit.hpp"
#include "app/sweep/plan/metric.hpp"
#include "optim/doe/sampling.hpp"

namespace kinetix::app {

/// A design of experiments checked against its base: every path is found, every value in range.
struct SweepPlan {
  DoeFile doe;
  SweepBase base;
  targets::DocumentEditor document;  ///< the base's, plus the keys that factors add
  std::vector<Edit> edits;           ///< edits of a sample, with the column of their factor
  std::vector<std::size_t> entries;  ///< per column of the samples' factors: its index in doe.factors
  optim::SamplePlan samples;
  std::vector<Metric> responses;
  Target goal;  ///< measures the samples; empty without a `goal`
  std::uint64_t seed = 0;
  targets::DocumentChanges changes = {};  ///< of the base, which options name

  std::int64_t size() const { return static_cast<std::int64_t>(samples.size()); }
  const DoeFactor& entry_of(std::size_t column) const { return doe.factors[entries[column]]; }
  bool searches() const { return base.target.has_value(); }
  /// Returns whether the document is read again for every sample.
  bool edits_document() const;
  /// Returns whether samples may run on several threads of a process: only if the project's code does all the
  /// work.
  bool is_thread_safe() const { return !searches() && doe.model != Model::bullet && !presses_bodies(); }
  /// Returns whether bodies of any shape press on each other in equilibrium; the engine finds contacts at
  /// rest.
  bool presses_bodies() const { return base.has_bodies() && doe.model == Model::equilibrium; }
};

/// Reads and checks a doe.yaml.
/// @param seed empty: the file's seed.
/// @param changes of the base, which options name.
/// @throws InvalidInput for paths that match nothing, unknown responses, too many samples, or a base that
/// does not fit the model.
/// @throws InvalidInput if the base's format does not allow the ends of a factor's range
SweepPlan make_sweep_plan(const std::string& file, std::optional<std::uint64_t> seed,
                          const targets::DocumentChanges& changes = {});

/// Makes the design or the target of a sample: the base with the factors' values written into it.
class SampleMaker {
 public:
  /// @param plan must outlive it
  explicit SampleMaker(const SweepPlan& plan);

  /// Makes the sample with these values of the factors, in their units; design() or target() then returns it.
  /// @throws InvalidInput if the base's format does not allow it
  void make(std::span<const double> values);

  const Design& design() const { return *design_; }
  const Target& target() const { return *target_; }

 private:
  const SweepPlan& plan_;
  bool reads_document_;
  targets::DocumentEditor document_;
  std::optional<Design> design_;
  std::optional<Target> target_;
};

}  // namespace kinetix::app
