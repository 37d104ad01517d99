#include "benchmarks/alone.hpp"

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace kinetix::bench {
namespace {

/// Returns a memory size of this process by the system's name for it, bytes.
double memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string key, rest;
  for (double kib = 0; status >> key; std::getline(status, rest))
    if (key == name + ":" && status >> kib) return 1024 * kib;
  return 0;
}

/// Restarts the record of the largest memory in use.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

CostAlone measured(const std::function<Cost()>& run) {
  malloc_trim(0);  // what figures before have freed: a run that takes it again would seem to need less
  forget_peak();
  const double before = memory("VmRSS");
  CostAlone out{run(), 0};
  out.bytes = memory("VmHWM") - before;
  return out;
}

[[noreturn]] void answer(const std::function<Cost()>& run, int allowed_s, int pipe) {
  alarm(static_cast<unsigned>(allowed_s));
  try {
    const CostAlone out = measured(run);
    _exit(write(pipe, &out, sizeof out) == sizeof out ? 0 : 1);
  } catch (const std::exception&) {
    _exit(1);
  }
}

}  // namespace

std::optional<CostAlone> cost_alone(const std::function<Cost()>& run, int allowed_s) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to a process of its own");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process of its own");
  if (child == 0) answer(run, allowed_s, ends[1]);
  close(ends[1]);
  CostAlone out;
  const bool answered = read(ends[0], &out, sizeof out) == sizeof out;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return answered ? std::optional(out) : std::nullopt;
}

}  // namespace kinetix::bench
