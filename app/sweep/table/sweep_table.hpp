#pragma once

#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/plan/sweep_plan.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace kinetix::app {

/// Identity of a sweep. The keys, in the order of its table `meta`, are: schema, kinetix_version, name,
/// model, method, samples, seed, factors, responses, doe_sha256, base_sha256, files_sha256, doe and base.
/// `factors` and `responses` are JSON lists of columns. files_sha256 covers all files that the two files
/// name. `doe` and `base` are their text.
using SweepIdentity = std::vector<std::pair<std::string, std::string>>;

SweepIdentity identify(const SweepPlan& plan);

/// Explains why a table with identity `there` does not belong to the sweep `asked`; empty if it does.
std::string difference(const SweepIdentity& there, const SweepIdentity& asked);

/// Table of a sweep, FOLDER/sweep.sqlite (SQLite 3, write-ahead log).
///
///     samples(sample INTEGER PRIMARY KEY, <one REAL per factor>, <one REAL per response>,
///             status TEXT, reason TEXT, row_sha256 TEXT)
///     meta(key TEXT PRIMARY KEY, value TEXT)          -- SweepIdentity.
///
/// Columns have the names of the factors and responses. A missing number is NULL. There is one writer; others
/// may read at any time. row_sha256: the first 16 hexadecimal digits of SHA-256 of the row's line in
/// samples.csv. A row is damaged if it does not match row_sha256, or its factors are not the plan's. It
/// counts as not computed.
class SweepTable {
 public:
  /// Opens the table of this sweep, or creates it. The folder stays locked during the lifetime of the object.
  /// @throws InvalidInput if another program writes to the folder. @throws InvalidInput if the table has
  /// samples and `resume` is false, belongs to another sweep, or lacks checksums. @throws InvalidInput if the
  /// file system refuses.
  SweepTable(const std::string& folder, const SweepPlan& plan, const SweepIdentity& identity, bool resume);
  ~SweepTable();
  SweepTable(const SweepTable&) = delete;
  SweepTable& operator=(const SweepTable&) = delete;

  /// Returns which samples the table has.
  const std::vector<bool>& done() const { return done_; }
  std::int64_t count() const { return count_; }
  /// Returns the number of rows that were damaged when the table was opened. New rows of these samples
  /// replace them.
  std::int64_t damaged() const { return damaged_; }

  /// Adds all rows or none. They are on the disk when this returns. @throws InvalidInput if the disk is full
  void add(const std::vector<SampleRow>& rows);

  /// Reads the rows in the order of samples, except damaged rows that were not computed again.
  /// @throws InvalidInput if a row was damaged after the table was opened
  void read(const std::function<void(const SampleRow&)>& see) const;

 private:
  struct Lock;

  void create(const SweepPlan& plan, const SweepIdentity& identity);
  void check_definition(const std::string& table, const std::string& sql) const;
  void check(const SweepIdentity& identity) const;
  void check_samples(const SweepPlan& plan) const;
  void find_done(const SweepPlan& plan);
  void each_row(const std::function<void(const SampleRow&, bool is_whole)>& see) const;
  void insert(const SampleRow& row);
  void run(const std::string& sql) const;
  [[noreturn]] void fail() const;

  std::string file_;
  std::unique_ptr<Lock> lock_;
  sqlite3* database_ = nullptr;
  sqlite3_stmt* insert_ = nullptr;
  std::size_t factors_ = 0, responses_ = 0;
  std::vector<bool> done_;
  std::int64_t count_ = 0, damaged_ = 0;
};

/// One of the equal parts of a sweep for independent jobs: every `count`-th sample, which makes their run
/// times similar. The default is all samples.
struct Share {
  std::int64_t index = 0, count = 1;  ///< from 0; number of shares

  bool has(std::int64_t sample) const { return sample % count == index; }
  /// Returns the number of samples in this share of a sweep with `samples` samples.
  std::int64_t size(std::int64_t samples) const { return (samples - index + count - 1) / count; }
  /// Returns share-K-of-N, K from 1: the subfolder of the sweep that holds its table.
  std::string folder() const;
};

/// Reads a share. @param text K/N, K from 1 to N @throws InvalidInput
Share read_share(const std::string& text);

/// Table of a share: its folder, and the number of damaged rows, which are not copied.
struct ShareTable {
  std::string folder;
  std::int64_t damaged = 0;
};

/// Lists the folders FOLDER/share-K-of-N with tables, in a fixed order.
/// @throws InvalidInput if a share is still being computed, or belongs to another sweep
std::vector<ShareTable> shares_in(const std::string& folder, const SweepPlan& plan,
                                  const SweepIdentity& identity);

/// Copies to the table of a sweep the rows of a share that it lacks.
/// @throws InvalidInput if the share is still being computed, or belongs to another sweep
void merge_share(const std::string& share, SweepTable& table, const SweepPlan& plan,
                 const SweepIdentity& identity);

/// Returns the line of a row in samples.csv, without its end.
std::string csv_line(const SampleRow& row);

/// Writes FOLDER/samples.csv: a header and the table's rows in the order of samples. Numbers have the fewest
/// digits that read back exactly; missing numbers are empty. Lines with # before the header hold seed,
/// version and hashes. The file is complete or not written.
void write_csv(const std::string& folder, const SweepTable& table, const SweepPlan& plan,
               const SweepIdentity& identity);

/// Returns the content of FOLDER/sweep.json and of the report (schema kinetix-sweep/1) for a finished sweep.
/// It has provenance, factors, counts and the first hundred samples that are not ok. Each response has its
/// spread, main effects and linear regression, with 95 % intervals. Some methods add Sobol's indices or
/// elementary effects. `scatter` has up to 2000 rows, chosen at random. Missing numbers are null.
/// Equal tables give equal documents.
nlohmann::ordered_json sweep_json(const SweepPlan& plan, const SweepIdentity& identity,
                                  const SweepTable& table);

}  // namespace kinetix::app
