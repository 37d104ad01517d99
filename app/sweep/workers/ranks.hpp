#pragma once

#include <functional>
#include <string>

#include "app/sweep/workers/thread_pool.hpp"

namespace kinetix::app {

/// The processes that mpirun (or a batch system's launcher) started together. Without one, a single process
/// that never touches MPI. Make one, in main's thread, and keep it to the end.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// How many of them are on this machine.
  int on_this_machine() const { return here_; }

  /// Rank 0's text, on all ranks. Each must call it.
  std::string from_first(std::string text) const;

  /// Rank 0: hands out samples to the other ranks until each has said farewell. Ends without an exception:
  /// what the source throws is kept, and thrown when all have left. A rank gets its next samples before its
  /// rows are stored, and computes meanwhile.
  /// @param notice hears what went wrong on a rank that left early
  void serve(const WorkSource& source, const std::function<void(const std::string&)>& notice) const;

  /// Other ranks: work until rank 0 has none left.
  void work(const SweepPlan& plan, int threads) const;
  /// Other ranks: say farewell without working.
  void leave(const std::string& why) const;

 private:
  int rank_ = 0, size_ = 1, here_ = 1;
  bool started_ = false;
};

}  // namespace kinetix::app
