#include "app/sweep/workers/worker_pools.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <exception>
#include <iterator>

#include "app/io/bytes.hpp"
#include "model/base/parallel_runs.hpp"

namespace kinetix::app {
namespace {

/// Locks a source for many threads, and closes it after the first exception.
class SharedSource {
 public:
  explicit SharedSource(const WorkSource& source) : source_(source) {}

  std::vector<std::int64_t> take(std::size_t count) noexcept {
    const std::lock_guard lock(mutex_);
    if (failure_) return {};
    try {
      return source_.take(count);
    } catch (...) {
      failure_ = std::current_exception();
      return {};
    }
  }

  void give(std::vector<SampleRow> rows) noexcept {
    const std::lock_guard lock(mutex_);
    if (failure_) return;
    try {
      source_.give(std::move(rows));
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  void fail(std::exception_ptr failure) noexcept {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const WorkSource& source_;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

void work(const SweepPlan& plan, SharedSource& source) noexcept {
  try {
    const auto evaluator = make_evaluator(plan);
    ChunkSize size;
    for (auto samples = source.take(size.next()); !samples.empty(); samples = source.take(size.next())) {
      Stopwatch watch;
      std::vector<SampleRow> rows;
      rows.reserve(samples.size());
      for (const std::int64_t sample : samples) rows.push_back(run_sample(plan, *evaluator, sample));
      size.took(samples.size(), watch.lap());
      source.give(std::move(rows));
    }
  } catch (...) {
    source.fail(std::current_exception());
  }
}

constexpr double wanted_seconds = 0.1;  // per chunk: shorter ones queue, longer ones keep others waiting
constexpr double max_chunk_samples = 1 << 16;  // samples per chunk: its rows are sent and stored as one
constexpr double growth = 4;                   // limit over the last chunk: one quick sample is weak evidence
constexpr std::size_t share_of_rest = 4;       // a call takes at most the rest divided by this,
constexpr std::size_t least_of_rest = 256;     // or this number of samples if that is more

}  // namespace

void run_on_threads(const SweepPlan& plan, int threads, const WorkSource& source) {
  SharedSource shared(source);
  model::run_in_parallel(threads, threads, [&](int) { work(plan, shared); });
  shared.rethrow();
}

std::vector<std::int64_t> WorkQueue::take(std::size_t count) {
  std::vector<std::int64_t> samples;
  count = std::min(count, std::max((done_.size() - next_) / share_of_rest, least_of_rest));
  for (; next_ < done_.size() && samples.size() < count; ++next_)
    if (!done_[next_]) samples.push_back(static_cast<std::int64_t>(next_));
  return samples;
}

void ChunkSize::took(std::size_t samples, double seconds) {
  const double fitting = static_cast<double>(samples) * wanted_seconds / std::max(seconds, 1e-9);
  const double most = std::min(growth * static_cast<double>(samples), max_chunk_samples);
  size_ = static_cast<std::size_t>(std::clamp(fitting, 1.0, most));
}

namespace {

void put_row(std::string& bytes, const SampleRow& row) {
  put(bytes, row.sample);
  append_all(bytes, row.factors.data(), row.factors.size());
  append_all(bytes, row.responses.data(), row.responses.size());
  put(bytes, row.status);
  append_all(bytes, row.reason.data(), row.reason.size());
}

SampleRow get_row(ByteReader& reader) {
  SampleRow row;
  row.sample = reader.get<std::int64_t>();
  row.factors = reader.extract_all<std::vector<double>>();
  row.responses = reader.extract_all<std::vector<double>>();
  row.status = reader.get<SampleStatus>();
  row.reason = reader.extract_all<std::string>();
  return row;
}

}  // namespace

std::string to_bytes(const WorkRequest& request) {
  std::string bytes;
  put(bytes, request.wanted);
  append_all(bytes, request.farewell.data(), request.farewell.size());
  put(bytes, request.rows.size());
  for (const SampleRow& row : request.rows) put_row(bytes, row);
  return bytes;
}

std::string to_bytes(const std::vector<std::int64_t>& samples) {
  std::string bytes;
  append_all(bytes, samples.data(), samples.size());
  return bytes;
}

WorkRequest read_request(std::string_view bytes) {
  ByteReader reader(bytes);
  WorkRequest request;
  request.wanted = reader.get<std::size_t>();
  request.farewell = reader.extract_all<std::string>();
  request.rows.resize(reader.get<std::size_t>());
  for (SampleRow& row : request.rows) row = get_row(reader);
  return request;
}

std::vector<std::int64_t> read_samples(std::string_view bytes) {
  return ByteReader(bytes).extract_all<std::vector<std::int64_t>>();
}

void work_for(const SweepPlan& plan, int threads,
              const std::function<std::string(const std::string&)>& exchange,
              const std::function<void(const std::string&)>& send_to_root) {
  std::vector<SampleRow> rows;
  WorkRequest farewell;
  const WorkSource source = {
      [&](std::size_t count) {
        return read_samples(exchange(to_bytes(WorkRequest{std::exchange(rows, {}), count})));
      },
      [&](std::vector<SampleRow> more) {
        if (rows.empty())
          rows = std::move(more);
        else
          std::move(more.begin(), more.end(), std::back_inserter(rows));
      }};
  try {
    run_on_threads(plan, threads, source);
  } catch (const std::exception& e) {
    farewell.farewell = e.what();
  }
  farewell.rows = std::move(rows);
  send_to_root(to_bytes(farewell));
}

namespace {

bool write_all(int to, const void* from, std::size_t size) {
  const auto* at = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t n = ::send(to, at, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool read_all(int from, void* to, std::size_t size) {
  auto* at = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t n = ::read(from, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool send_message(int to, const std::string& bytes) {
  const std::size_t size = bytes.size();
  return write_all(to, &size, sizeof size) && write_all(to, bytes.data(), size);
}

std::optional<std::string> receive_message(int from) {
  std::size_t size = 0;
  if (!read_all(from, &size, sizeof size)) return std::nullopt;
  std::string bytes(size, '\0');
  if (!read_all(from, bytes.data(), size)) return std::nullopt;
  return bytes;
}

/// Runs a worker process until its end: receives samples one by one, returns their rows.
[[noreturn]] void live(const SweepPlan& plan, const EvaluatorMaker& make, int socket, pid_t parent) {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal_number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
  try {
    const auto evaluator = make(plan);
    while (const auto message = receive_message(socket))
      for (const std::int64_t sample : read_samples(*message))
        if (!send_message(socket, to_bytes(WorkRequest{{run_sample(plan, *evaluator, sample)}, 1}))) _exit(0);
  } catch (const std::exception& e) {
    send_message(socket, to_bytes(WorkRequest{.farewell = e.what()}));
  }
  _exit(0);
}

class Process {
 public:
  Process(const SweepPlan& plan, const EvaluatorMaker& make) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw error("no socket for a worker");
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0) {
      close(ends[0]);
      live(plan, make, ends[1], parent);
    }
    close(ends[1]);
    socket_ = ends[0];
    if (pid_ < 0) {
      close(socket_);
      throw error("no worker process");
    }
  }
  /// Kills the process. Closing its socket would not end it, since other processes have copies of the socket.
  ~Process() {
    if (pid_ > 0) kill(pid_, SIGKILL);
    end();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int socket() const { return socket_; }
  std::int64_t sample() const { return sample_; }
  void start(std::int64_t sample) {
    sample_ = sample;
    send_message(socket_, to_bytes(std::vector{sample}));
  }

  /// Waits for the process to end. @return sentence that describes how it ended
  std::string end() {
    if (pid_ <= 0) return {};
    close(socket_);
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
    pid_ = 0;
    if (WIFSIGNALED(status))
      return fmt::format("its process was ended by signal {} ({})", WTERMSIG(status),
                         strsignal(WTERMSIG(status)));
    return fmt::format("its process ended with code {}", WEXITSTATUS(status));
  }

 private:
  static std::runtime_error error(const char* what) {
    return std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno)));
  }

  pid_t pid_ = 0;
  int socket_ = -1;
  std::int64_t sample_ = -1;
};

SampleRow lost_row(const SweepPlan& plan, std::int64_t sample, const std::string& why) {
  SampleRow row;
  row.sample = sample;
  row.factors = plan.samples.sample(static_cast<std::uint64_t>(sample));
  row.responses.assign(plan.responses.size(), std::numeric_limits<double>::quiet_NaN());
  row.status = SampleStatus::failed;
  row.reason = why;
  return row;
}

class ProcessPool {
 public:
  ProcessPool(const SweepPlan& plan, const WorkSource& source, const EvaluatorMaker& make)
      : plan_(plan), source_(source), make_(make) {}

  void run(int processes) {
    for (int k = 0; k < processes; ++k)
      if (!start_next(nullptr)) break;
    while (!pool_.empty()) receive_next(wait());
  }

 private:
  /// Gives a process its next sample; null starts a new process. @return false if no samples are left
  bool start_next(Process* process) {
    const auto samples = source_.take(1);
    if (samples.empty()) return false;
    if (!process) process = pool_.emplace_back(std::make_unique<Process>(plan_, make_)).get();
    process->start(samples[0]);
    return true;
  }

  std::size_t wait() const {
    std::vector<pollfd> sockets;
    for (const auto& process : pool_) sockets.push_back({process->socket(), POLLIN, 0});
    while (poll(sockets.data(), sockets.size(), -1) < 0 && errno == EINTR) continue;
    for (std::size_t k = 0; k < sockets.size(); ++k)
      if (sockets[k].revents != 0) return k;
    return 0;
  }

  void receive_next(std::size_t k) {
    const auto message = receive_message(pool_[k]->socket());
    const bool lives = message.has_value();
    if (lives) {
      WorkRequest request = read_request(*message);
      if (!request.farewell.empty()) throw InvalidInput(request.farewell);
      source_.give(std::move(request.rows));
    } else {
      const std::int64_t sample = pool_[k]->sample();
      source_.give({lost_row(plan_, sample, pool_[k]->end())});
    }
    if (lives && start_next(pool_[k].get())) return;
    pool_.erase(pool_.begin() + static_cast<std::ptrdiff_t>(k));
    if (!lives) start_next(nullptr);
  }

  const SweepPlan& plan_;
  const WorkSource& source_;
  const EvaluatorMaker& make_;
  std::vector<std::unique_ptr<Process>> pool_;
};

}  // namespace

void run_in_processes(const SweepPlan& plan, int processes, const WorkSource& source,
                      const EvaluatorMaker& make) {
  ProcessPool(plan, source, make).run(processes);
}

}  // namespace kinetix::app
