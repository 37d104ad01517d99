#include "app/sweep/workers/ranks.hpp"

// Leaves out the C++ bindings, which MPI has removed.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <cstdlib>
#include <exception>

namespace kinetix::app {
namespace {

constexpr int request_tag = 1, answer_tag = 2;  // tags of MPI messages; any two different numbers
// Time between two polls for a request. It is short against chunks of a tenth of a second (thread_pool.cpp),
// and long enough to leave the core to the work.
constexpr std::chrono::microseconds poll_interval{200};

/// Returns whether the environment has a variable that launchers of the common implementations set.
bool is_launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "MPI_LOCALNRANKS"})
    if (std::getenv(name)) return true;
  return false;
}

void send(const std::string& bytes, int to, int tag) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

std::string receive(MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return bytes;
}

std::string exchange(const std::string& request) {
  send(request, 0, request_tag);
  MPI_Status status;
  MPI_Probe(0, answer_tag, MPI_COMM_WORLD, &status);
  return receive(status);
}

/// Returns the next request of any rank. Waits without keeping a core busy.
std::string next_request(int& from) {
  MPI_Status status;
  for (int there = 0;; std::this_thread::sleep_for(poll_interval)) {
    MPI_Iprobe(MPI_ANY_SOURCE, request_tag, MPI_COMM_WORLD, &there, &status);
    if (there) break;
  }
  from = status.MPI_SOURCE;
  return receive(status);
}

}  // namespace

Ranks::Ranks() {
  if (!is_launched()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  started_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &here_);
  MPI_Comm_free(&machine);
}

Ranks::~Ranks() {
  if (started_) MPI_Finalize();
}

std::string Ranks::from_first(std::string text) const {
  if (size_ == 1) return text;
  auto length = static_cast<unsigned long>(text.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_BYTE, 0, MPI_COMM_WORLD);
  return text;
}

void Ranks::serve(const WorkSource& source, const std::function<void(const std::string&)>& notice) const {
  std::exception_ptr failure;
  const auto attempt = [&](const auto& action) {
    try {
      if (!failure) action();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  for (int others = size_ - 1; others > 0;) {
    int from = 0;
    WorkRequest request = read_request(next_request(from));
    if (!request.farewell.empty()) notice("rank " + std::to_string(from) + ": " + request.farewell);
    if (request.wanted > 0) {
      std::vector<std::int64_t> samples;
      attempt([&] { samples = source.take(request.wanted); });
      send(to_bytes(samples), from, answer_tag);
    } else {
      --others;
    }
    if (!request.rows.empty()) attempt([&] { source.give(std::move(request.rows)); });
  }
  if (failure) std::rethrow_exception(failure);
}

void Ranks::work(const SweepPlan& plan, int threads) const {
  work_for(plan, threads, exchange, [](const std::string& request) { send(request, 0, request_tag); });
}

void Ranks::leave(const std::string& why) const {
  send(to_bytes(WorkRequest{.farewell = why}), 0, request_tag);
}

}  // namespace kinetix::app
