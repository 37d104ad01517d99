#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <filesystem>

#include "app/io/atomic_file.hpp"
#include "app/io/bytes.hpp"
#include "tests/support/bad_input.hpp"
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

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::read_file;
using testing::refusal;
using testing::TemporaryFolder;

std::size_t entries(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteFile, WritesNewFilesAndReplacesOldOnes) {
  TemporaryFolder folder;
  write_file(folder.path("a.json"), "one");
  write_file(folder.path("a.json"), "two");
  EXPECT_EQ(read_file(folder.path("a.json")), "two");
  EXPECT_EQ(entries(folder.path("")), 1u);
}

TEST(WriteFile, NamesTheFolderThatCannotBeWritten) {
  TemporaryFolder folder;
  const auto file = folder.write("file", "x");
  EXPECT_THAT(refusal([&] { write_file(file + "/a.json", "x"); }),
              ::testing::AllOf(::testing::StartsWith(file + ": cannot write"), HasSubstr("Not a directory")));
  EXPECT_THAT(refusal([&] { write_file(folder.path("none/a.json"), "x"); }),
              HasSubstr("No such file or directory"));
  EXPECT_THAT(refusal([] { write_file("/proc/a.json", "x"); }), ::testing::StartsWith("/proc: cannot write"));
  EXPECT_EQ(entries(folder.path("")), 1u);
}

TEST(WriteFile, LeavesNothingBehindWhereTheNameIsTaken) {
  TemporaryFolder folder;
  fs::create_directories(folder.path("a.json/full"));
  EXPECT_THAT(refusal([&] { write_file(folder.path("a.json"), "x"); }),
              HasSubstr("a.json: cannot be written: "));
  EXPECT_EQ(entries(folder.path("")), 1u);
}

/// Limits files to 64 KiB during its lifetime.
class FullDisk {
 public:
  FullDisk() {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{1 << 16, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before_{};
};

TEST(WriteFile, KeepsTheOldFileWhenTheDiskIsFull) {
  TemporaryFolder folder;
  const auto file = folder.write("a.json", "old");
  const std::string message = refusal([&] {
    const FullDisk disk;
    write_file(file, std::string(1 << 20, 'x'));
  });
  EXPECT_THAT(message, HasSubstr("a.json: cannot be written: File too large"));
  EXPECT_EQ(read_file(file), "old");
  EXPECT_EQ(entries(folder.path("")), 1u);
}

TEST(FileSet, BringsAllFilesAtOnceAndReplacesOldOnes) {
  TemporaryFolder folder;
  folder.write("a.txt", "old");
  FileSet files(folder.path(""));
  files.add("a.txt", "new");
  files.add("frames/00.txt", "first");
  files.add("frames/01.txt", "second");
  EXPECT_EQ(read_file(folder.path("a.txt")), "old");
  EXPECT_FALSE(fs::exists(folder.path("frames/00.txt")));
  files.commit();
  EXPECT_EQ(read_file(folder.path("a.txt")), "new");
  EXPECT_EQ(read_file(folder.path("frames/01.txt")), "second");
  EXPECT_EQ(entries(folder.path("")), 2u);
  EXPECT_EQ(entries(folder.path("frames")), 2u);
}

TEST(FileSet, LeavesEverythingAsItWasWhenTheDiskIsFull) {
  TemporaryFolder folder;
  folder.write("a.txt", "old");
  const std::string message = refusal([&] {
    const FullDisk disk;
    FileSet files(folder.path(""));
    files.add("a.txt", "new");
    files.add("frames/00.txt", "first");
    files.add("b.txt", std::string(1 << 20, 'x'));
    files.commit();
  });
  EXPECT_THAT(message, HasSubstr("b.txt: cannot be written: File too large"));
  EXPECT_EQ(read_file(folder.path("a.txt")), "old");
  EXPECT_EQ(entries(folder.path("")), 1u);
}

TEST(FileSet, GivesEarlierFilesTheirOldContentBackWhereALaterNameIsTaken) {
  TemporaryFolder folder;
  folder.write("a.txt", "old");
  fs::create_directories(folder.path("c.txt/full"));
  FileSet files(folder.path(""));
  for (const char* name : {"a.txt", "b.txt", "c.txt", "d.txt"}) files.add(name, "new");
  EXPECT_THAT(refusal([&] { files.commit(); }), HasSubstr("c.txt: cannot be written: Is a directory"));
  EXPECT_EQ(read_file(folder.path("a.txt")), "old");
  EXPECT_FALSE(fs::exists(folder.path("b.txt")));
  EXPECT_FALSE(fs::exists(folder.path("d.txt")));
}

TEST(FileSet, ThatIsNotCommittedLeavesNoTrace) {
  TemporaryFolder folder;
  {
    FileSet files(folder.path(""));
    files.add("a/b/c.txt", "x");
    EXPECT_EQ(entries(folder.path("a/b")), 1u);
  }
  EXPECT_EQ(entries(folder.path("")), 0u);
}

/// Writes files and their record, as a run does.
void write_recorded(const TemporaryFolder& folder, const std::vector<std::string>& names) {
  FileRecord record(folder.path(""));
  FileSet files(folder.path(""));
  for (const std::string& name : names) {
    files.add(name, "content of " + name);
    record.add(name, "content of " + name);
  }
  if (!names.empty()) files.add(FileRecord::name, record.text());
  files.commit();
  record.remove_leftovers();
}

TEST(FileRecord, RemovesWhatTheEarlierRunWroteAndThisOneDoesNot) {
  TemporaryFolder folder;
  write_recorded(folder, {"a.svg", "b.svg", "frames/00.png", "frames/01.png"});
  EXPECT_EQ(entries(folder.path("")), 4u);
  write_recorded(folder, {"a.svg", "frames/00.png"});
  EXPECT_TRUE(fs::exists(folder.path("a.svg")));
  EXPECT_FALSE(fs::exists(folder.path("b.svg")));
  EXPECT_EQ(entries(folder.path("frames")), 1u);
  write_recorded(folder, {});
  EXPECT_EQ(entries(folder.path("")), 0u);
}

TEST(FileRecord, LeavesTheUsersOwnFilesAlone) {
  TemporaryFolder folder, other;
  write_recorded(folder, {"a.svg", "b.svg", "c.svg", "frames/00.png"});
  folder.write("a.svg", "drawn over by hand");
  folder.write("own.svg", "content of own.svg");
  folder.write("frames/own.png", "x");
  fs::rename(folder.path("b.svg"), other.path("b.svg"));
  fs::create_symlink(other.path("b.svg"), folder.path("b.svg"));
  fs::remove(folder.path("c.svg"));
  write_recorded(folder, {});
  EXPECT_EQ(read_file(folder.path("a.svg")), "drawn over by hand");
  EXPECT_TRUE(fs::exists(folder.path("own.svg")));
  EXPECT_TRUE(fs::exists(folder.path("frames/own.png")));
  EXPECT_FALSE(fs::exists(folder.path("frames/00.png")));
  EXPECT_TRUE(fs::exists(other.path("b.svg")));
  EXPECT_TRUE(fs::is_symlink(folder.path("b.svg")));
}

TEST(FileRecord, KnowsWhatSomebodyHasChanged) {
  TemporaryFolder folder;
  write_recorded(folder, {"a.yaml", "b.yaml"});
  folder.write("a.yaml", "changed by hand");
  folder.write("own.yaml", "x");
  const FileRecord record(folder.path(""));
  EXPECT_EQ(record.changed("a.yaml"), "changed by hand");
  for (const char* name : {"b.yaml", "own.yaml", "none.yaml"}) EXPECT_FALSE(record.changed(name)) << name;
}

TEST(FileRecord, NeverReachesOutOfItsFolder) {
  TemporaryFolder outer;
  const std::string hash = sha256("mine");
  outer.write("mine.txt", "mine");
  fs::create_directory(outer.path("in"));
  outer.write(std::string("in/") + FileRecord::name,
              hash + "  ../mine.txt\n" + hash + "  " + outer.path("mine.txt") + "\n\nshort\n");
  FileRecord(outer.path("in")).remove_leftovers();
  EXPECT_TRUE(fs::exists(outer.path("mine.txt")));
}

TEST(OutputFolder, IsCreatedWithItsParentsAndLeftEmpty) {
  TemporaryFolder folder;
  const auto deep = folder.path("a/b/c");
  OutputFolder(deep).keep();
  OutputFolder(deep + "/").keep();
  EXPECT_EQ(entries(deep), 0u);
}

TEST(OutputFolder, LosesPartsOfRunsThatWereKilledLongAgo) {
  TemporaryFolder folder;
  const auto two_days_ago = fs::file_time_type::clock::now() - std::chrono::hours(48);
  const std::string old = folder.path(".a.json.kinetix-part-0123ab"),
                    young = folder.path(".b.json.kinetix-part-0123ab"),
                    users = folder.path("about.kinetix-part-0123ab");
  for (const std::string& file : {old, young, users}) write_file(file, "half");
  for (const std::string& file : {old, users}) fs::last_write_time(file, two_days_ago);
  OutputFolder(folder.path(".")).keep();
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(young));
  EXPECT_TRUE(fs::exists(users));
}

TEST(OutputFolder, SaysWhyItCannotBeUsed) {
  TemporaryFolder folder;
  const auto file = folder.write("file", "x");
  EXPECT_THAT(refusal([&] { OutputFolder folder_of_results(file); }),
              ::testing::StartsWith(file + ": cannot create"));
  EXPECT_THAT(refusal([&] { OutputFolder folder_of_results(file + "/below"); }),
              HasSubstr("Not a directory"));
  EXPECT_THAT(refusal([] { OutputFolder folder_of_results("/proc/kinetix"); }),
              ::testing::StartsWith("/proc/kinetix: "));
  EXPECT_THAT(refusal([] { OutputFolder folder_of_results("/proc"); }),
              ::testing::StartsWith("/proc: cannot write"));
  EXPECT_THAT(refusal([] { OutputFolder folder_of_results(""); }), HasSubstr("no name"));
}

}  // namespace
}  // namespace kinetix::app
