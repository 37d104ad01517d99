#pragma once

#include <optional>
#include <span>

#include "app/sweep/plan/edit.hpp"
#include "app/sweep/plan/metric.hpp"
#include "optim/doe/sampling.hpp"

namespace kinetix::app {

/// A design of experiments that has met its base: every path found, every value in range.
struct SweepPlan {
  DoeFile doe;
  SweepBase base;
  targets::DocumentEditor document;  ///< the base's, with the keys that factors add
  std::vector<Edit> edits;           ///< what a sample writes, by column of the samples' factors
  std::vector<std::size_t> entries;  ///< by column of the samples' factors: its place in doe.factors
  optim::SamplePlan samples;
  std::vector<Metric> responses;
  Target goal;  ///< to measure samples against; nothing without one
  std::uint64_t seed = 0;

  std::int64_t size() const { return static_cast<std::int64_t>(samples.size()); }
  const DoeFactor& entry_of(std::size_t column) const { return doe.factors[entries[column]]; }
  bool searches() const { return base.target.has_value(); }
  /// Whether the document is read anew for every sample.
  bool edits_document() const;
  /// Whether samples may run on several threads of a process: what is only the project's own code may.
  bool is_thread_safe() const { return !searches() && doe.model != Model::bullet && !presses_bodies(); }
  /// Whether bodies of any shape press on each other in equilibrium: the engine tells which of them touch at rest.
  bool presses_bodies() const { return base.has_bodies() && doe.model == Model::equilibrium; }
};

/// @param seed nothing: the file's own
/// @throws InvalidInput for paths that name nothing, responses that there are not, values that the base's
/// format does not allow at the ends of a factor's range, too many samples, a base that the model does not
/// fit
SweepPlan make_sweep_plan(const std::string& file, std::optional<std::uint64_t> seed);

/// Makes the design or the target of a sample: the base with the factors' values written into it.
class SampleMaker {
 public:
  /// @param plan must outlive it
  explicit SampleMaker(const SweepPlan& plan);

  /// Values of the factors, in their units; design() or target() is then that sample's.
  /// @throws InvalidInput for what the base's format does not allow
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
