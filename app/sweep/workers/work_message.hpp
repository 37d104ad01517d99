#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/sweep/workers/thread_pool.hpp"

namespace kinetix::app {

/// What a worker in another process sends: the rows it has, and how many samples it wants; none: it is
/// leaving. Bytes are those of the sender's machine: all processes of a sweep run on alike ones.
struct WorkRequest {
  std::vector<SampleRow> rows = {};
  std::size_t wanted = 0;
  std::string farewell = {};  ///< of one that leaves: what went wrong, empty where nothing did
};

std::string to_bytes(const WorkRequest& request);
std::string to_bytes(const std::vector<std::int64_t>& samples);
WorkRequest read_request(std::string_view bytes);
std::vector<std::int64_t> read_samples(std::string_view bytes);

/// Works on threads of this process for a source in another one, and says farewell at the end. Throws
/// nothing.
/// @param exchange sends a request and brings the answer
/// @param tell sends one that has no answer
void work_for(const SweepPlan& plan, int threads,
              const std::function<std::string(const std::string&)>& exchange,
              const std::function<void(const std::string&)>& tell);

}  // namespace kinetix::app
