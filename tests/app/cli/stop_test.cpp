#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/app/bow.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Starts the program, sends it a signal after `after_us` microseconds, and waits for its end.
void interrupt(const std::string& target, const std::string& folder, int after_us, int signal_number) {
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    execl(KINETIX_OPT, KINETIX_OPT, target.c_str(), "--quiet", "--no-verify", "-o", folder.c_str(), nullptr);
    _exit(127);
  }
  usleep(after_us);
  kill(child, signal_number);
  int status = 0;
  waitpid(child, &status, 0);
}

/// Starts the program and sends Ctrl-C once it has printed the words.
/// @return its stderr, and its exit status (waitpid)
std::pair<std::string, int> interrupted_after(const std::vector<std::string>& words,
                                              const std::vector<std::string>& arguments) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    std::vector<char*> all{const_cast<char*>(KINETIX_OPT)};
    for (const std::string& one : arguments) all.push_back(const_cast<char*>(one.c_str()));
    all.push_back(nullptr);
    execv(KINETIX_OPT, all.data());
    _exit(127);
  }
  close(ends[1]);
  std::string said;
  char some[256];
  std::size_t sent = 0;
  for (ssize_t n; (n = read(ends[0], some, sizeof some)) > 0;) {
    said.append(some, static_cast<std::size_t>(n));
    while (sent < words.size() && said.find(words[sent]) != std::string::npos) kill(child, SIGINT), ++sent;
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return {said, status};
}

/// Stops the program at moments of its first 60 ms, and checks that what it left is whole.
void expect_whole_files(int between_moments_us) {
  const Scratch scratch;
  const std::string target = scratch.write("bow.yaml", bow);
  for (const int signal_number : {SIGTERM, SIGPIPE, SIGKILL})
    for (int after_us = 0; after_us < 60000; after_us += between_moments_us) {
      const std::string folder = scratch / fmt::format("out-{}-{}", signal_number, after_us);
      interrupt(target, folder, after_us, signal_number);
      const std::string result = folder + "/result.json", design = folder + "/design.yaml";
      if (fs::exists(result)) {
        EXPECT_TRUE(Json::accept(text_of(result)));
      }
      if (fs::exists(design)) {
        EXPECT_EQ(kinetix_opt("check " + design).code, 0);
      }
      if (signal_number == SIGKILL || !fs::exists(folder)) continue;
      EXPECT_TRUE(fs::exists(result)) << "an empty folder is left";
      for (const auto& entry : fs::directory_iterator(folder))
        EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("kinetix-part")));
    }
}

TEST(Program, LeavesNoHalfWrittenFileWhenItIsInterruptedOrKilled) { expect_whole_files(6000); }

TEST(ProgramSoak, LeavesNoHalfWrittenFileAtManyMoments) { expect_whole_files(1500); }

/// A search that takes many times longer than the limit below.
const std::string long_search = std::string(bow) + "tolerance: {shape: 1e-9}\nsolver: {starts: 3000}\n";

TEST(Program, KeepsTheBestSoFarWhenItsTimeIsUp) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("long.yaml", long_search) + " --time-limit 0.1 -o " + folder);
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.err, HasSubstr("time limit reached: stopping and saving the best result so far"));
  EXPECT_THAT(run.out, HasSubstr("\n  warning:   stopped early"));
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["stopped"], true);
  EXPECT_FALSE(result.contains("physics"));
  EXPECT_TRUE(fs::exists(folder + "/design.yaml"));
}

/// Sends Ctrl-C during the search and checks that its best result is written.
void expect_best_so_far(const std::string& goal) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  EXPECT_THAT(interrupted_after({"search ..."}, {scratch.write("long.yaml", goal), "-o", folder}).first,
              HasSubstr("interrupted: stopping and saving the best result so far"));
  EXPECT_EQ(Json::parse(text_of(folder + "/result.json"))["stopped"], true);
}

TEST(Program, KeepsTheBestSoFarAtCtrlC) { expect_best_so_far(long_search); }

/// The search of an outline reports itself after its first two candidates.
TEST(ProgramSoak, KeepsTheBestOutlineSoFarAtCtrlC) {
  expect_best_so_far(R"(kinetix: 1
target: {kind: outline, points: [[30, 0], [4, 6], [-20, 25], [-8, 0], [-25, -30], [4, -6]]}
structure: {cells: [20, 20], trim: none}
)");
}

TEST(Program, EndsAtTheSecondCtrlC) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const auto [said, status] = interrupted_after({"search ...", "saving the best result so far"},
                                                {scratch.write("long.yaml", long_search), "-o", folder});
  EXPECT_THAT(said, HasSubstr("interrupted: stopping and saving the best result so far"));
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) << status;
  EXPECT_FALSE(fs::exists(folder + "/result.json"));
}

TEST(Program, KeepsThePathSoFarAtCtrlC) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const std::string large =
      scratch.write("large.yaml",
                    "kinetix: 1\nstructure: {cells: [24, 24], cell_mm: 10}\nhinge: {model: elastic}\n"
                    "design: {theta_deg: 35}\n");
  const auto [said, status] = interrupted_after({"equilibrium path ..."},
                                                {"simulate", large, "--model", "equilibrium", "-o", folder});
  EXPECT_THAT(said, HasSubstr("interrupted: stopping and saving the best result so far"));
  ASSERT_TRUE(WIFEXITED(status)) << said;
  EXPECT_EQ(WEXITSTATUS(status), 3) << said;
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["equilibrium"]["stop"], "interrupted");
  EXPECT_EQ(result["stopped"], true);
}

TEST(Program, SaysThatThereIsNothingToKeepOfAPhysicsRun) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const std::string large = scratch.write(
      "large.yaml", "kinetix: 1\nstructure: {cells: [24, 24], cell_mm: 10}\ndesign: {theta_deg: 35}\n");
  const auto [said, status] = interrupted_after({"simulation ..."}, {"verify", large, "-o", folder});
  EXPECT_THAT(said, HasSubstr("the simulation was stopped before it settled: nothing is written"));
  ASSERT_TRUE(WIFEXITED(status)) << said;
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_FALSE(fs::exists(folder + "/result.json"));
}

}  // namespace
}  // namespace kinetix::testing
