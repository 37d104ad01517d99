// kinetix-forked-runs SECONDS BYTES: runs the whole program in forks of this loaded process, since the loader takes
// longer than a run of `check`.
// A line of stdin has the arguments of a run, separated by tabs. After the run, a line of stdout has its exit code, or
// minus the number of the signal that ended it. Its output is in the files `stdout` and `stderr` of the folder. A run
// may use SECONDS of processor time and BYTES of addresses.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"

namespace {

constexpr unsigned longest_wait =
    200;  // s by the clock: limit for a run that waits for ever without using the processor

struct Limits {
  rlim_t seconds, bytes;
};

void redirect(const char* file, int flags, int to) {
  const int from = open(file, flags, 0666);
  if (from < 0 || dup2(from, to) < 0) std::_Exit(126);
}

void limit(int what, rlim_t most) {
  const rlimit both{most, most};
  if (setrlimit(static_cast<__rlimit_resource>(what), &both) != 0) std::_Exit(126);
}

[[noreturn]] void run(std::vector<std::string> arguments, const Limits& limits) {
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect("stdout", O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  redirect("stderr", O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  limit(RLIMIT_CPU, limits.seconds);
  limit(RLIMIT_AS, limits.bytes);
  limit(RLIMIT_CORE, 0);
  alarm(longest_wait);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::exit(kinetix::app::run_command_line(static_cast<int>(arguments.size()), argv.data()));
}

std::vector<std::string> arguments_of(const std::string& line) {
  std::vector<std::string> arguments = {"kinetix-opt"};
  std::istringstream stream(line);
  for (std::string argument; std::getline(stream, argument, '\t');) arguments.push_back(argument);
  return arguments;
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status); }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Limits limits{std::strtoul(argv[1], nullptr, 10), std::strtoul(argv[2], nullptr, 10)};
  for (std::string line; std::getline(std::cin, line);) {
    const pid_t child = fork();
    if (child < 0) return 1;
    if (child == 0) run(arguments_of(line), limits);
    int status = 0;
    if (waitpid(child, &status, 0) < 0) return 1;
    std::cout << code_of(status) << std::endl;
  }
  return 0;
}
