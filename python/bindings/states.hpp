#pragma once

#include "app/run/run.hpp"

namespace kinetix::python {

/// State of a run, which it keeps alive. Its table of poses is made once.
class RunState {
 public:
  RunState(std::shared_ptr<const app::Run> run, std::size_t index) : run_(std::move(run)), index_(index) {}

  const app::NamedState& named() const { return run_->states[index_]; }
  const model::State& poses() const { return named().poses; }
  /// Seven numbers per body (write_poses).
  const std::vector<double>& table();

 private:
  std::shared_ptr<const app::Run> run_;
  std::size_t index_ = 0;
  std::vector<double> table_;
};

}  // namespace kinetix::python
