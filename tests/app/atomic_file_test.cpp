#include "app/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix {
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

TEST(WriteFile, KeepsTheOldFileWhenTheDiskIsFull) {
  TemporaryFolder folder;
  const auto file = folder.write("a.json", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1 << 16, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = refusal([&] { write_file(file, std::string(1 << 20, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, HasSubstr("a.json: cannot be written: File too large"));
  EXPECT_EQ(read_file(file), "old");
  EXPECT_EQ(entries(folder.path("")), 1u);
}

TEST(OutputFolder, IsCreatedWithItsParentsAndLeftEmpty) {
  TemporaryFolder folder;
  const auto deep = folder.path("a/b/c");
  OutputFolder(deep).keep();
  OutputFolder(deep + "/").keep();
  EXPECT_EQ(entries(deep), 0u);
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
}  // namespace kinetix
