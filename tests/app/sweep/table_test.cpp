#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/sweep/launch.hpp"
#include "tests/app/sweep/sweep.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

std::string quick_samples(int count) {
  return sweep_of(fmt::format("{{kind: lhs, samples: {}}}", count),
                  "  - {path: design.theta_deg, range: [5, 40]}\n  - {path: "
                  "\"design.columns[*].beta_deg\", range: [-40, 40]}\n",
                  "end_mm, turn_deg, moved_rms_mm");
}

// Samples that take several transactions and several pieces of the file.
const std::string many = quick_samples(20000);

std::string table_of(const std::string& doe, const std::string& launcher, const std::string& arguments) {
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const std::string command =
      launcher + " " + KINETIX_OPT + " sweep " + scratch.write("doe.yaml", doe).c_str() + " --quiet -o " +
      (scratch / "out").string() + " " + arguments + " >" + (scratch / "log").string() + " 2>&1 </dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0) << text_of(scratch / "log");
  return text_of(scratch / "out/samples.csv");
}

/// Compares the tables of a sweep by any number of workers, whose number of samples gives work to all of them.
void expect_the_same_table(const std::string& sweep, std::size_t least_bytes) {
  const std::string one = table_of(sweep, "", "--threads 1");
  EXPECT_GT(one.size(), least_bytes);
  EXPECT_EQ(table_of(sweep, "", "--threads 2"), one);
  EXPECT_EQ(table_of(sweep, "", "--threads 5"), one);
  EXPECT_EQ(table_of(sweep, ranks(1), ""), one);
  EXPECT_EQ(table_of(sweep, ranks(2), ""), one);
  EXPECT_EQ(table_of(sweep, ranks(4), ""), one);
  EXPECT_EQ(table_of(sweep, ranks(2), "--threads 2"), one);
}

TEST(SweepTable, IsTheSameForAnyNumberOfThreadsAndRanks) {
  expect_the_same_table(quick_samples(4000), 200 * 1000);
}

TEST(SweepTableSoak, OfManySamplesIsTheSameForAnyNumberOfThreadsAndRanks) {
  expect_the_same_table(many, 1000 * 1000);
}

TEST(SweepTable, IsTheSameForProcessesAndRanksThatRunThePhysics) {
  const std::string doe =
      sweep_of("{kind: sobol, samples: 4}", "  - {path: design.theta_deg, range: [5, 20]}\n",
               "verify_rms, end_mm", "model: bullet\n");
  const std::string one = table_of(doe, "", "--threads 1");
  EXPECT_EQ(table_of(doe, "", "--threads 3"), one);
  EXPECT_EQ(table_of(doe, ranks(2), ""), one);
}

TEST(SweepTable, BadInputUnderRanksIsSaidOnceAndEndsWith2) {
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const std::string doe = scratch.write(
      "doe.yaml", sweep_of("{kind: factorial}", "  - {path: design.tetha_deg, range: [5, 40]}\n", "end_mm"));
  const std::string log = scratch / "log";
  const int status =
      std::system((ranks(3) + " " + KINETIX_OPT + " sweep " + doe + " >" + log + " 2>&1").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const std::string text = text_of(log), words = "Did you mean";
  EXPECT_NE(text.find(words), std::string::npos);
  EXPECT_EQ(text.find(words), text.rfind(words));
}

TEST(SweepTable, AKilledSweepResumesToTheSameTable) {
  const std::string whole = table_of(many, "", "--threads 1");
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const std::string doe = scratch.write("doe.yaml", many), out = scratch / "out";
  for (const int milliseconds : {3, 20, 45, 70, 110})
    run_and_kill({KINETIX_OPT, "sweep", doe, "-o", out, "--resume", "--threads", "2"}, milliseconds);
  const Outcome last = kinetix_opt("sweep " + doe + " -o " + out + " --resume");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(text_of(out + "/samples.csv"), whole);
}

TEST(SweepTable, SharesAndWhatTheyLackGiveTheSameTable) {
  const std::string whole = table_of(many, "", "--threads 1");
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const std::string doe = scratch.write("doe.yaml", many), out = scratch / "out";
  // The first share is done, the second is killed during its run, and the third never runs.
  const Outcome first = kinetix_opt("sweep " + doe + " -o " + out + " --share 1/3 --json");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(Json::parse(first.out)["computed"], 6667);
  EXPECT_EQ(Json::parse(first.out)["share"], "1/3");
  EXPECT_FALSE(fs::exists(out + "/samples.csv"));
  run_and_kill({KINETIX_OPT, "sweep", doe, "-o", out, "--share", "2/3", "--threads", "1"}, 60);
  const Outcome last = kinetix_opt("sweep " + doe + " -o " + out + " --json");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_LE(Json::parse(last.out)["computed"], 20000 - 6667);
  EXPECT_EQ(text_of(out + "/samples.csv"), whole);
}

TEST(SweepTable, SharesHaveEverySampleOnce) {
  const Scratch scratch;
  const std::string small =
      sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm");
  for (int k = 1; k <= 6; ++k) {
    const Outcome share = run_sweep_in(scratch, small, fmt::format("--share {}/6 --json", k));
    ASSERT_EQ(share.code, 0) << share.err;
    EXPECT_EQ(Json::parse(share.out)["computed"], k <= 4 ? 1 : 0);
  }
  const Outcome all = run_sweep_in(scratch, small, "--json");
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(Json::parse(all.out)["computed"], 0);
  EXPECT_EQ(Json::parse(all.out)["ok"], 4);
}

TEST(SweepTable, RefusesSharesThatThereAreNotAndThoseOfAnotherSweep) {
  const Scratch scratch;
  const std::string small =
      sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm");
  for (const char* share : {"0/3", "4/3", "1/0", "1", "/", "1/3x", "-1/3", "1/100001"}) {
    const Outcome run = run_sweep_in(scratch, small, std::string("--share ") + share);
    EXPECT_EQ(run.code, 2) << share;
    EXPECT_THAT(run.err, HasSubstr("is not K/N with K from 1 to N"));
  }
  EXPECT_EQ(run_sweep_in(scratch, small, "--share 1/2 --open").code, 2);
  EXPECT_FALSE(fs::exists(scratch / "out"));
  ASSERT_EQ(run_sweep_in(scratch, small, "--share 1/2").code, 0);
  const Outcome other = run_sweep_in(scratch, small + "# other\n");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("share-1-of-2/sweep.sqlite: is the table of another sweep"));
  EXPECT_FALSE(fs::exists(scratch / "out/sweep.sqlite"));

  const int folder = open((scratch / "out/share-1-of-2").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(folder, LOCK_EX), 0);
  const Outcome early = run_sweep_in(scratch, small);
  close(folder);
  EXPECT_EQ(early.code, 2);
  EXPECT_THAT(early.err, HasSubstr("another program is writing a sweep into this folder"));
}

TEST(SweepTable, AFullDiskLosesNothing) {
  const std::string whole = table_of(many, "", "--threads 1");
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const std::string arguments =
      "sweep " + scratch.write("doe.yaml", many) + " -o " + (scratch / "out").string();
  const std::string log = scratch / "log";
  const int status = std::system(
      fmt::format("bash -c \"ulimit -f 1000; {} {}\" >{} 2>&1", KINETIX_OPT, arguments, log).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_THAT(text_of(log), HasSubstr("ontinue with --resume"));
  EXPECT_EQ(kinetix_opt(arguments + " --resume").code, 0);
  EXPECT_EQ(text_of(scratch / "out/samples.csv"), whole);
}

TEST(SweepTable, IsKeptFromBeingReplacedTakenForAnotherOrWrittenTwiceAtOnce) {
  const Scratch scratch;
  const std::string small =
      sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm");
  ASSERT_EQ(run_sweep_in(scratch, small).code, 0);
  const std::string before = text_of(scratch / "out/sweep.sqlite");

  const Outcome again = run_sweep_in(scratch, small);
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("already exists, with 4 of 4 samples"));
  const Outcome other = run_sweep_in(scratch, small + "# other\n", "--resume");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("is the table of another sweep: the sweep file"));
  const Outcome base = run_sweep_in(scratch, small, "--resume", std::string(strip) + "# other\n");
  EXPECT_THAT(base.err, HasSubstr("is the table of another sweep: the base file"));
  const Outcome option = run_sweep_in(scratch, small, "--resume --process fdm");
  EXPECT_THAT(option.err, HasSubstr("is the table of another sweep: an option"));
  const Outcome seed = run_sweep_in(scratch, small, "--resume --seed 3");
  EXPECT_THAT(seed.err, HasSubstr("is the table of another sweep: the seed"));

  const int folder = open((scratch / "out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(folder, LOCK_EX), 0);
  const Outcome second = run_sweep_in(scratch, small, "--resume");
  close(folder);
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.err, HasSubstr("another program is writing a sweep into this folder"));
  EXPECT_EQ(text_of(scratch / "out/sweep.sqlite"), before);

  const Outcome done = run_sweep_in(scratch, small, "--resume --json");
  EXPECT_EQ(done.code, 0);
  EXPECT_EQ(Json::parse(done.out)["computed"], 0);
}

/// Runs SQL statements without quotes on the table of a sweep in `out`.
/// @return 0 on success
int change_table(const Scratch& scratch, const std::string& sql) {
  const std::string script = scratch.write(
      "change.py", "import sqlite3, sys\nsqlite3.connect(sys.argv[1]).executescript('" + sql + "')\n");
  return std::system(("/usr/bin/python3 " + script + " " + (scratch / "out/sweep.sqlite").string()).c_str());
}

const std::string grid = sweep_of(
    "{kind: factorial}", "  - {path: design.theta_deg, range: [5, 40], levels: 12}\n", "end_mm, turn_deg");

/// Resumes a sweep in a modified table and checks that samples.csv is as before.
/// @return the run's output
Outcome expect_same_rows(const Scratch& scratch, const std::string& before, const std::string& arguments) {
  const Outcome run = run_sweep_in(scratch, grid, arguments + " --json");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(text_of(scratch / "out/samples.csv"), before);
  return run;
}

TEST(SweepTable, ComputesDamagedRowsAgainAndSaysSo) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, grid).code, 0);
  const std::string before = text_of(scratch / "out/samples.csv"),
                    table = text_of(scratch / "out/sweep.sqlite");
  const std::string swaps =
      "CREATE TABLE t AS SELECT * FROM samples WHERE sample IN (2, 3); UPDATE samples SET end_mm = (SELECT "
      "end_mm FROM t "
      "WHERE t.sample = 5 - samples.sample) WHERE sample IN (2, 3); DROP TABLE t";
  const std::pair<std::string, int> changes[] = {
      {"UPDATE samples SET end_mm = end_mm + 1 WHERE sample = 4", 1},
      {"UPDATE samples SET \"design.theta_deg\" = 6 WHERE sample = 0", 1},
      {"UPDATE samples SET end_mm = NULL WHERE sample IN (1, 2, 3)", 3},
      {"UPDATE samples SET status = \"failed\" WHERE sample = 11", 1},
      {"UPDATE samples SET reason = \"x\" WHERE sample > 5", 6},
      {"UPDATE samples SET row_sha256 = \"0123456789abcdef\"", 12},
      {"DELETE FROM samples WHERE sample = 7; UPDATE samples SET sample = 7 WHERE sample = 8", 1},
      {swaps, 2}};
  for (const auto& [sql, rows] : changes) {
    scratch.write("out/sweep.sqlite", table);
    ASSERT_EQ(change_table(scratch, sql), 0) << sql;
    const Outcome run = expect_same_rows(scratch, before, "--resume");
    EXPECT_EQ(Json::parse(run.out)["damaged"], rows) << sql;
    EXPECT_THAT(run.err,
                HasSubstr(fmt::format("warning: {}/sweep.sqlite: {} row", (scratch / "out").string(), rows)))
        << sql;
    EXPECT_EQ(Json::parse(expect_same_rows(scratch, before, "--resume").out)["damaged"], 0) << sql;
  }
}

/// The checksum is valid, but the factor differs from that of the plan.
TEST(SweepTable, ComparesFactorsWithThePlan) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, grid).code, 0);
  const std::string before = text_of(scratch / "out/samples.csv");
  std::string line;
  std::istringstream lines(before);
  while (std::getline(lines, line) && !line.starts_with("0,5,")) continue;
  const std::string forged = "0,6," + line.substr(4);
  const std::string hash = "import hashlib; print(hashlib.sha256(b\"" + forged + "\").hexdigest()[:16])";
  ASSERT_EQ(std::system(("/usr/bin/python3 -c '" + hash + "' >" + (scratch / "hash").string()).c_str()), 0);
  ASSERT_EQ(change_table(scratch, "UPDATE samples SET \"design.theta_deg\" = 6, row_sha256 = \"" +
                                      text_of(scratch / "hash").substr(0, 16) + "\" WHERE sample = 0"),
            0);
  EXPECT_EQ(Json::parse(expect_same_rows(scratch, before, "--resume").out)["damaged"], 1);
}

TEST(SweepTable, WithAnyBitFlippedGivesTheSameNumbersOrIsRefused) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, grid).code, 0);
  const std::string before = text_of(scratch / "out/samples.csv"),
                    table = text_of(scratch / "out/sweep.sqlite");
  const auto is_seen = [&](std::size_t place, std::size_t k) {
    std::string other = table;
    other.at(place) ^= static_cast<char>(1 << k % 8);
    scratch.write("out/sweep.sqlite", other);
    const Outcome run = run_sweep_in(scratch, grid, "--resume --json");
    if (run.code == 0)
      EXPECT_EQ(text_of(scratch / "out/samples.csv"), before) << place;
    else
      EXPECT_EQ(run.code, 2) << run.err;
    return run.code == 2 || Json::parse(run.out)["damaged"] > 0;
  };
  // The second page contains the samples: rows of about 50 bytes, the first row at the end of the page.
  const std::size_t page =
      256 * static_cast<unsigned char>(table[16]) + static_cast<unsigned char>(table[17]);
  ASSERT_GT(page, 12u * 50);
  for (std::size_t k = 0; k < 24; ++k) EXPECT_TRUE(is_seen(2 * page - 1 - 23 * k, k)) << k;
  for (std::size_t k = 0; k < 8; ++k) is_seen(k * table.size() / 8 + 40 * k, k);
}

TEST(SweepTable, DamagedRowsOfSharesAreNotTakenOver) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, grid).code, 0);
  const std::string before = text_of(scratch / "out/samples.csv");
  fs::remove_all(scratch / "out");
  for (const char* share : {"--share 1/2", "--share 2/2"})
    ASSERT_EQ(run_sweep_in(scratch, grid, share).code, 0);
  fs::rename(scratch / "out/share-2-of-2/sweep.sqlite", scratch / "out/sweep.sqlite");
  ASSERT_EQ(change_table(scratch, "UPDATE samples SET end_mm = end_mm * 2 WHERE sample IN (3, 5)"), 0);
  fs::rename(scratch / "out/sweep.sqlite", scratch / "out/share-2-of-2/sweep.sqlite");
  const Outcome run = expect_same_rows(scratch, before, "");
  EXPECT_EQ(Json::parse(run.out)["damaged"], 2);
  EXPECT_EQ(Json::parse(run.out)["computed"], 2);
  EXPECT_THAT(run.err, HasSubstr("share-2-of-2/sweep.sqlite: 2 rows damaged"));
}

TEST(SweepTable, DamagedRowsAreComputedAgainByRanks) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, grid).code, 0);
  const std::string before = text_of(scratch / "out/samples.csv");
  ASSERT_EQ(change_table(scratch, "UPDATE samples SET turn_deg = 0 WHERE sample IN (3, 5)"), 0);
  const std::string log = scratch / "log";
  ASSERT_EQ(std::system((ranks(2) + " " + KINETIX_OPT + " sweep " + (scratch / "doe.yaml").string() +
                         " --resume -o " + (scratch / "out").string() + " >" + log + " 2>&1 </dev/null")
                            .c_str()),
            0);
  EXPECT_EQ(text_of(scratch / "out/samples.csv"), before);
  EXPECT_THAT(text_of(log), HasSubstr("sweep.sqlite: 2 rows damaged"));
}

TEST(SweepTable, AllOfWhoseRowsAreDamagedStillNeedsResume) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, grid).code, 0);
  ASSERT_EQ(change_table(scratch, "UPDATE samples SET end_mm = 0"), 0);
  const Outcome run = run_sweep_in(scratch, grid);
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("ontinue with --resume"));
}

TEST(SweepTable, OfAnEarlierVersionWithoutChecksumsIsRefused) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, grid).code, 0);
  ASSERT_EQ(change_table(scratch, "ALTER TABLE samples DROP COLUMN row_sha256"), 0);
  const Outcome run = run_sweep_in(scratch, grid, "--resume");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err,
              HasSubstr("sweep.sqlite: was written by an earlier version, without a checksum per row"));
}

/// A sweep that is stopped before its first sample leaves nothing that could be lost.
TEST(SweepTable, WithoutASampleIsTakenWithoutResume) {
  const Scratch scratch;
  const std::string small =
      sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm");
  ASSERT_EQ(run_sweep_in(scratch, small).code, 0);
  ASSERT_EQ(change_table(scratch, "DELETE FROM samples"), 0);
  const Outcome run = run_sweep_in(scratch, small, "--json");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["computed"], 4);
}

TEST(SweepTable, AFileThatIsNoTableIsLeftAlone) {
  const Scratch scratch;
  fs::create_directories(scratch / "out");
  scratch.write("out/sweep.sqlite", "a letter to my aunt, of some length, that is no table at all");
  const Outcome run = run_sweep_in(
      scratch, sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm"),
      "--resume");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("is not the table of a sweep"));
  EXPECT_THAT(text_of(scratch / "out/sweep.sqlite"), HasSubstr("my aunt"));
}

TEST(SweepTable, AViewWithoutEndInItsPlaceIsRefused) {
  const Scratch scratch;
  const std::string small =
      sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm");
  ASSERT_EQ(run_sweep_in(scratch, small).code, 0);
  ASSERT_EQ(change_table(scratch,
                         "DROP TABLE samples; CREATE VIEW samples AS WITH RECURSIVE n(sample) AS "
                         "(SELECT 0 UNION ALL SELECT sample FROM n) SELECT sample FROM n"),
            0);
  const Outcome run = run_sweep_in(scratch, small, "--resume");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("is not the table of a sweep"));
}

}  // namespace
}  // namespace kinetix::testing
