#pragma once

#include "app/sweep/workers/worker_pools.hpp"

namespace kinetix::app {

/// Processes that mpirun (or a batch system's launcher) started together. Without a launcher, a single
/// process that never calls MPI. Make one in main's thread and keep it to the end.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Returns the number of ranks on this machine.
  int on_this_machine() const { return here_; }

  /// Returns rank 0's text on all ranks. Each rank must call it.
  std::string from_first(std::string text) const;

  /// Rank 0: hands out samples until all other ranks have left. Exceptions of the source are thrown after
  /// that. A rank gets its next samples before its rows are stored, and computes meanwhile.
  /// @param notice receives the error of a rank that left early
  void serve(const WorkSource& source, const std::function<void(const std::string&)>& notice) const;

  /// Other ranks: compute samples until rank 0 has none left.
  void work(const SweepPlan& plan, int threads) const;
  /// Other ranks: leave without working.
  void leave(const std::string& why) const;

 private:
  int rank_ = 0, size_ = 1, here_ = 1;
  bool started_ = false;
};

}  // namespace kinetix::app
