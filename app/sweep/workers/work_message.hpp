#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/sweep/workers/thread_pool.hpp"

namespace kinetix::app {

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
              const std::function<void(const std::string&)>& tell);

}  // namespace kinetix::app
