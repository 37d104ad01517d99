#pragma once

#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

/// Source of samples and sink of rows for workers. Called by one thread at a time.
struct WorkSource {
  std::function<std::vector<std::int64_t>(std::size_t count)> take;  ///< empty: the work is done
  std::function<void(std::vector<SampleRow>)> give;                  ///< may throw: then all workers stop
};

/// Runs all samples on several threads (OpenMP). Rows do not depend on the number of threads.
/// @param threads >= 1
/// @throws exceptions of `give`
void run_on_threads(const SweepPlan& plan, int threads, const WorkSource& source);

/// Hands out the samples that are not done yet, in order.
class WorkQueue {
 public:
  explicit WorkQueue(std::vector<bool> done) : done_(std::move(done)) {}

  /// Returns the next samples, at most `count`; empty when all are handed out. Returns fewer towards the end
  /// to balance the workers.
  std::vector<std::int64_t> take(std::size_t count);
  /// Ends the queue: take() returns nothing after this.
  void stop() { next_ = done_.size(); }

 private:
  std::vector<bool> done_;
  std::size_t next_ = 0;
};

/// Computes the number of samples for a worker's next chunk. Large chunks cost little overhead; small ones
/// limit losses and waiting. Starts with one.
class ChunkSize {
 public:
  std::size_t next() const { return size_; }
  /// @param seconds duration of the last chunk
  void took(std::size_t samples, double seconds);

 private:
  std::size_t size_ = 1;
};

/// Message of a worker in another process: its rows, and the number of samples that it wants; 0: it is
/// leaving. Values are in the sender's byte order; all processes of a sweep must run on machines of one kind.
struct WorkRequest {
  std::vector<SampleRow> rows = {};
  std::size_t wanted = 0;
  std::string farewell = {};  ///< error of a worker that leaves; empty without one
};

std::string to_bytes(const WorkRequest& request);
std::string to_bytes(const std::vector<std::int64_t>& samples);
WorkRequest read_request(std::string_view bytes);
std::vector<std::int64_t> read_samples(std::string_view bytes);

/// Computes samples on threads of this process for a source in another one, and sends a farewell at the end.
/// Throws nothing.
/// @param exchange sends a request and returns the answer
/// @param tell sends a request without an answer
void work_for(const SweepPlan& plan, int threads,
              const std::function<std::string(const std::string&)>& exchange,
              const std::function<void(const std::string&)>& send_to_root);

/// Runs all samples in separate processes, one at a time in each, for models that keep global state. If a
/// process dies, its sample fails and another process replaces it.
/// @param processes >= 1   @param make makes the evaluator of each process.
/// @pre no other thread of this process allocates or writes during a fork; the console's thread does not.
/// @throws exceptions of the source
void run_in_processes(const SweepPlan& plan, int processes, const WorkSource& source,
                      const EvaluatorMaker& make = make_evaluator);

}  // namespace kinetix::app
