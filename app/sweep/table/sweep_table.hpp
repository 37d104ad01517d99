#pragma once

struct sqlite3;
struct sqlite3_stmt;

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

/// What a sweep's table says of itself, in the order of its table `meta`:
/// schema, kinetix_version, name, model, method, samples, seed, factors and responses (JSON lists of
/// columns), doe_sha256, base_sha256, files_sha256 (of all files that these two name), doe and base (their
/// text).
using SweepIdentity = std::vector<std::pair<std::string, std::string>>;

SweepIdentity identify(const SweepPlan& plan);

/// Why a table with identity `there` is not of the sweep `asked`; empty where it is.
std::string difference(const SweepIdentity& there, const SweepIdentity& asked);

/// The table of a sweep, FOLDER/sweep.sqlite (SQLite 3, write-ahead log):
///
///     samples(sample INTEGER PRIMARY KEY, <one REAL a factor>, <one REAL a response>,
///             status TEXT, reason TEXT, row_sha256 TEXT)
///     meta(key TEXT PRIMARY KEY, value TEXT)          -- SweepIdentity
///
/// Columns are called as the factors and responses are. A number that there is not is NULL. One writer;
/// others may read at any time. row_sha256: the first 16 hexadecimal digits of SHA-256 of the row's line in samples.csv. A row
/// that does not fit it, or whose factors are not those of the plan, is damaged: it counts as not computed.
class SweepTable {
 public:
  /// Opens the table of this sweep, or makes it. The folder stays locked while this lives.
  /// @throws InvalidInput where another program writes there, where a table with samples is there already and `resume`
  /// is not asked for, where it belongs to another sweep or has no checksums, and where the file system says no
  SweepTable(const std::string& folder, const SweepPlan& plan, const SweepIdentity& identity, bool resume);
  ~SweepTable();
  SweepTable(const SweepTable&) = delete;
  SweepTable& operator=(const SweepTable&) = delete;

  /// Which samples are there.
  const std::vector<bool>& done() const { return done_; }
  std::int64_t count() const { return count_; }
  /// How many rows were damaged when it was opened. New rows of these samples take their places.
  std::int64_t damaged() const { return damaged_; }

  /// Adds rows, all or none, on the disk when this returns. @throws InvalidInput where the disk is full
  void add(const std::vector<SampleRow>& rows);

  /// Every row in the order of samples, but those that are damaged and not computed again.
  /// @throws InvalidInput where a row has been damaged since it was opened
  void read(const std::function<void(const SampleRow&)>& see) const;

 private:
  struct Lock;

  void create(const SweepPlan& plan, const SweepIdentity& identity);
  void check_made(const std::string& table, const std::string& sql) const;
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

}  // namespace kinetix::app
