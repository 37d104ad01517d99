#include "app/io/reader_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "model/base/invalid_input.hpp"
#include "model/base/loaded_module.hpp"

namespace kinetix::app {
namespace {

/// Program whose standard output is read from a pipe. Its other streams are /dev/null.
class StartedReader {
 public:
  explicit StartedReader(std::vector<std::string> words) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail(words[0], errno);
    out_ = ends[0];
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = posix_spawn(&pid_, arguments[0], &streams, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&streams);
    close(ends[1]);
    if (error == 0) return;
    close(out_);
    fail(words[0], error);
  }
  ~StartedReader() {
    close(out_);
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    wait();
  }
  StartedReader(const StartedReader&) = delete;
  StartedReader& operator=(const StartedReader&) = delete;

  std::string output() const {
    std::string text;
    char buffer[1 << 16];
    while (true) {
      const ssize_t count = ::read(out_, buffer, sizeof buffer);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return text;
      text.append(buffer, static_cast<std::size_t>(count));
    }
  }

  /// @return status of waitpid
  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
    pid_ = 0;
    return status;
  }

 private:
  [[noreturn]] static void fail(const std::string& program, int error) {
    throw std::runtime_error(fmt::format("{} cannot be started: {}", program, std::strerror(error)));
  }

  pid_t pid_ = 0;
  int out_ = -1;
};

std::string describe_end(int status, const ReaderLimits& limits) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return fmt::format("is damaged or too large: it was not read within {} s. Give a smaller file",
                       limits.cpu_s);
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ReaderEnd::out_of_memory))
    return fmt::format(
        "is damaged or too large: reading it takes more than {} MiB of memory. Give a smaller file",
        limits.memory_bytes >> 20);
  return "is damaged: the library that reads it crashed. Export the file again";
}

}  // namespace

std::string run_reader(const std::string& program, const std::vector<std::string>& arguments,
                       const ReaderLimits& limits) {
  std::vector<std::string> words = {model::module_file(program), std::to_string(limits.cpu_s),
                                    std::to_string(limits.memory_bytes)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  StartedReader reader(std::move(words));
  std::string output = reader.output();
  const int status = reader.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ReaderEnd::done)) return output;
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ReaderEnd::refused))
    throw InvalidInput(output);
  throw InvalidInput(describe_end(status, limits));
}

}  // namespace kinetix::app
