#include "app/sweep/workers/process_pool.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/workers/work_message.hpp"

namespace kinetix::app {
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
    while (!pool_.empty()) hear(wait());
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

  void hear(std::size_t k) {
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
