#include "app/io/lock_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "app/io/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::testing {
namespace {

namespace fs = std::filesystem;
using app::LockFile;

/// Starts a process that holds a lock until the signal ends it.
void hold_in_another_program(const std::string& file, int signal_number) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    app::remove_parts_when_interrupted();
    const auto lock = LockFile::acquire(file);
    const char is_held = lock ? 'y' : 'n';
    if (write(ready[1], &is_held, 1) != 1) _exit(1);
    while (true) pause();
  }
  char is_held = 0;
  ASSERT_EQ(read(ready[0], &is_held, 1), 1);
  EXPECT_EQ(is_held, 'y');
  EXPECT_EQ(LockFile::acquire(file), nullptr);
  kill(child, signal_number);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WTERMSIG(status), signal_number);
  close(ready[0]);
  close(ready[1]);
}

TEST(LockFile, IsOfOneHolderAtATimeAndGoesWithTheLock) {
  const TemporaryFolder folder;
  const std::string file = folder.path("a.lock");
  auto lock = LockFile::acquire(file);
  ASSERT_TRUE(lock);
  EXPECT_TRUE(fs::exists(file));
  EXPECT_FALSE(LockFile::acquire(file));
  EXPECT_TRUE(LockFile::acquire(folder.path("b.lock")));
  lock.reset();
  EXPECT_FALSE(fs::exists(file));
  EXPECT_TRUE(LockFile::acquire(file));
  EXPECT_FALSE(LockFile::acquire(folder.path("none/a.lock")));
}

TEST(LockFile, IsRemovedWhereASignalThatIsHandledEndsItsHolder) {
  const TemporaryFolder folder;
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    hold_in_another_program(folder.path("a.lock"), signal_number);
    EXPECT_FALSE(fs::exists(folder.path("a.lock"))) << signal_number;
  }
}

TEST(LockFile, LeftByAHolderThatWasKilledLocksNobodyOut) {
  const TemporaryFolder folder;
  hold_in_another_program(folder.path("a.lock"), SIGKILL);
  EXPECT_TRUE(fs::exists(folder.path("a.lock")));
  EXPECT_TRUE(LockFile::acquire(folder.path("a.lock")));
  EXPECT_FALSE(fs::exists(folder.path("a.lock")));
}

}  // namespace
}  // namespace kinetix::testing
