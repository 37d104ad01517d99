#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace kinetix::testing {

/// Returns the command prefix that starts a program with `count` ranks. It permits root and fewer cores than ranks,
/// which some MPI implementations refuse. Leak detection is off, since MPI keeps memory until the end.
inline std::string ranks(int count) {
  return "ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
         "OMPI_MCA_rmaps_base_oversubscribe=1 " MPIEXEC " -n " +
         std::to_string(count);
}

/// Starts a program and kills it after some milliseconds, as a power cut would.
/// @return whether it was still running
inline bool run_and_kill(const std::vector<std::string>& arguments, double milliseconds) {
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, 1);
    dup2(nowhere, 2);
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  usleep(static_cast<useconds_t>(1000 * milliseconds));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

}  // namespace kinetix::testing
