#pragma once

#include <optional>
#include <span>

#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

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
