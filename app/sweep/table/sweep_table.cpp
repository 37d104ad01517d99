#include "app/sweep/table/sweep_table.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/io/bytes.hpp"
#include "app/version.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t max_shares = 100000;  // tasks of the largest job arrays
constexpr std::size_t rows_at_once = 10000;  // per transaction: a few MB

/// Reads a text that is a whole number and nothing else.
std::optional<std::int64_t> whole(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_share(const fs::path& folder) {
  const std::string name = folder.filename().string();
  std::error_code failure;
  return name.starts_with("share-") && name.find("-of-") != std::string::npos &&
         fs::exists(folder / "sweep.sqlite", failure);
}

}  // namespace

std::string Share::folder() const { return fmt::format("share-{}-of-{}", index + 1, count); }

Share read_share(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto number = whole(std::string_view(text).substr(0, slash));
  const auto count = whole(std::string_view(text).substr(std::min(slash + 1, text.size())));
  if (!number || !count || *count < 1 || *count > max_shares || *number < 1 || *number > *count)
    throw InvalidInput(
        fmt::format("--share: '{}' is not K/N with K from 1 to N, N at most {}", text, max_shares));
  return {*number - 1, *count};
}

std::vector<ShareTable> shares_in(const std::string& folder, const SweepPlan& plan,
                                  const SweepIdentity& identity) {
  std::vector<ShareTable> shares;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_share(entry.path())) shares.push_back({entry.path().string()});
  std::sort(shares.begin(), shares.end(),
            [](const ShareTable& a, const ShareTable& b) { return a.folder < b.folder; });
  for (ShareTable& share : shares) share.damaged = SweepTable(share.folder, plan, identity, true).damaged();
  return shares;
}

void merge_share(const std::string& share, SweepTable& table, const SweepPlan& plan,
                 const SweepIdentity& identity) {
  std::vector<SampleRow> rows;
  const auto store = [&] {
    if (!rows.empty()) table.add(rows);
    rows.clear();
  };
  SweepTable(share, plan, identity, true).read([&](const SampleRow& row) {
    if (!table.done()[static_cast<std::size_t>(row.sample)]) rows.push_back(row);
    if (rows.size() >= rows_at_once) store();
  });
  store();
}

namespace {

// Bytes, 1 GiB, of a file that a sweep names: more than any reader accepts, meshes (256 MiB) included.
constexpr std::size_t max_file_bytes = std::size_t{1} << 30;
constexpr int deepest = 3;  // files: a sweep names a base or a goal, which names its points; one extra

/// Hashes of files in the order in which they are named: two files that change places give another hash.
struct NamedFiles {
  std::set<std::string> paths;
  std::string hashes;  ///< one line per file
};

/// Adds the files that a document names, and the files that these name.
void add_files(const targets::Node& root, NamedFiles& files, int depth) {
  for (const targets::Tree::Item& item : root.tree().items) {
    if (item.kind != targets::Node::Kind::scalar || item.value.empty()) continue;
    const fs::path path = fs::path(root.folder()) / item.value;
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored) || !files.paths.insert(path).second) continue;
    files.hashes += sha256(targets::read_bytes(path, max_file_bytes)) + "\n";
    if (depth < deepest && (path.extension() == ".yaml" || path.extension() == ".yml"))
      add_files(targets::read_document(path, max_design_bytes), files, depth + 1);
  }
}

/// Computes a hash of the files' contents; names of folders do not affect it.
std::string files_hash(const SweepPlan& plan) {
  NamedFiles files;
  add_files(plan.doe.root, files, 0);
  add_files(plan.base.root, files, 0);
  return sha256(files.hashes);
}

std::string factor_names(const SweepPlan& plan) {
  nlohmann::json names = nlohmann::json::array();
  for (const optim::Factor& factor : plan.samples.factors()) names.push_back(factor.name);
  return names.dump();
}

std::string response_names(const SweepPlan& plan) {
  nlohmann::json names = nlohmann::json::array();
  for (const Metric& metric : plan.responses) names.push_back(metric.name);
  return names.dump();
}

std::string method_name(const SweepPlan& plan) {
  return plan.doe.method.node.required("kind", "").text("a method");
}

// Entries that must be equal in two tables of one sweep, and their names in messages.
constexpr std::pair<const char*, const char*> deciding[] = {{"schema", "the table's format"},
                                                            {"kinetix_version", "the program's version"},
                                                            {"doe_sha256", "the sweep file"},
                                                            {"base_sha256", "the base file"},
                                                            {"files_sha256", "a file that they name"},
                                                            {"seed", "the seed"},
                                                            {"changes", "an option"}};

std::string value_of(const SweepIdentity& identity, const std::string& key) {
  for (const auto& [name, value] : identity)
    if (name == key) return value;
  return {};
}

constexpr int busy_ms = 5000;  // a reader may lock the file for a moment

/// SQL statement, finalised at the end of its scope.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& sql) {
    sqlite3_prepare_v2(database, sql.c_str(), -1, &statement_, nullptr);
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  explicit operator bool() const { return statement_ != nullptr; }
  bool step() { return (code_ = sqlite3_step(statement_)) == SQLITE_ROW; }
  bool ended() const { return code_ == SQLITE_DONE; }
  std::string text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return bytes ? std::string(bytes, sqlite3_column_bytes(statement_, column)) : std::string();
  }
  double number(int column) const {
    if (sqlite3_column_type(statement_, column) == SQLITE_NULL)
      return std::numeric_limits<double>::quiet_NaN();
    return sqlite3_column_double(statement_, column);
  }
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  void bind(int place, const std::string& text) {
    sqlite3_bind_text(statement_, place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int code_ = SQLITE_OK;
};

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

std::string value_columns(const SweepPlan& plan) {
  std::string text = "sample INTEGER PRIMARY KEY";
  for (const optim::Factor& factor : plan.samples.factors()) text += ", " + quoted(factor.name) + " REAL";
  for (const Metric& metric : plan.responses) text += ", " + quoted(metric.name) + " REAL";
  return text + ", status TEXT NOT NULL, reason TEXT NOT NULL";
}

// Statements that made the tables. A view or generated columns of these names could run for ever.
std::string samples_sql(const SweepPlan& plan) {
  return "CREATE TABLE samples(" + value_columns(plan) + ", row_sha256 TEXT NOT NULL)";
}
std::string samples_sql_without_checksum(const SweepPlan& plan) {
  return "CREATE TABLE samples(" + value_columns(plan) + ")";
}
const std::string meta_sql = "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL)";

std::string checksum(const SampleRow& row) { return sha256(csv_line(row)).substr(0, 16); }

/// Returns a row as SQLite returns it: without the sign of 0 and with NaN for numbers that are not finite.
SampleRow storable(SampleRow row) {
  for (std::vector<double>* values : {&row.factors, &row.responses})
    for (double& value : *values) value = std::isfinite(value) ? value + 0.0 : std::nan("");
  return row;
}

/// Joins changes of the base: "process: fdm, hinge: {kind: pin}".
std::string describe_changes(const targets::DocumentChanges& changes) {
  std::vector<std::string> all;
  for (const auto& [path, value] : changes) all.push_back(path + ": " + value);
  return fmt::format("{}", fmt::join(all, ", "));
}

SampleStatus status_of(const std::string& word) {
  for (const auto status : {SampleStatus::ok, SampleStatus::missed, SampleStatus::disagrees})
    if (to_string(status) == word) return status;
  return SampleStatus::failed;
}

}  // namespace

SweepIdentity identify(const SweepPlan& plan) {
  const std::string doe = targets::read_bytes(plan.doe.root.place().file, max_file_bytes);
  const std::string base = targets::read_bytes(plan.doe.base, max_file_bytes);
  SweepIdentity identity{{"schema", "kinetix-sweep/1"},
                         {"kinetix_version", version},
                         {"name", plan.doe.name},
                         {"model", to_string(plan.doe.model)},
                         {"method", method_name(plan)},
                         {"samples", std::to_string(plan.size())},
                         {"seed", std::to_string(plan.seed)},
                         {"factors", factor_names(plan)},
                         {"responses", response_names(plan)},
                         {"doe_sha256", sha256(doe)},
                         {"base_sha256", sha256(base)},
                         {"files_sha256", files_hash(plan)},
                         {"doe", doe},
                         {"base", base}};
  if (!plan.changes.empty()) identity.emplace_back("changes", describe_changes(plan.changes));
  return identity;
}

std::string difference(const SweepIdentity& there, const SweepIdentity& asked) {
  for (const auto& [key, what] : deciding)
    if (value_of(there, key) != value_of(asked, key)) return what;
  return {};
}

/// Lock of the folder. The system releases it whenever the program ends.
struct SweepTable::Lock {
  explicit Lock(const std::string& folder)
      : descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0) return;
    close(descriptor);
    throw InvalidInput("another program is writing a sweep into this folder. Wait for it, or give another -o",
                       {folder});
  }
  ~Lock() {
    if (descriptor >= 0) close(descriptor);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  int descriptor;
};

SweepTable::SweepTable(const std::string& folder, const SweepPlan& plan, const SweepIdentity& identity,
                       bool resume)
    : file_(folder + "/sweep.sqlite"),
      lock_(std::make_unique<Lock>(folder)),
      factors_(plan.samples.factors().size()),
      responses_(plan.responses.size()) {
  try {
    if (sqlite3_open(file_.c_str(), &database_) != SQLITE_OK) fail();
    sqlite3_busy_timeout(database_, busy_ms);
    sqlite3_db_config(database_, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
    const bool is_there = Statement(database_, "SELECT 1 FROM sqlite_master WHERE name = 'meta'").step();
    if (is_there) check_definition("meta", meta_sql);
    if (is_there) check(identity);
    if (is_there) check_samples(plan);
    if (is_there) find_done(plan);
    if (count_ + damaged_ > 0 && !resume)
      throw InvalidInput(fmt::format("already exists, with {} of {} samples. Continue with --resume, or give "
                                     "another -o",
                                     count_, plan.size()),
                         {file_});
    if (!is_there) create(plan, identity);
    std::string places = "?";
    for (std::size_t k = 0; k < factors_ + responses_ + 3; ++k) places += ",?";
    const std::string sql = "INSERT OR REPLACE INTO samples VALUES(" + places + ")";
    if (sqlite3_prepare_v2(database_, sql.c_str(), -1, &insert_, nullptr) != SQLITE_OK) fail();
  } catch (...) {
    sqlite3_close(database_);
    throw;
  }
}

SweepTable::~SweepTable() {
  sqlite3_finalize(insert_);
  sqlite3_close(database_);
}

void SweepTable::fail() const {
  const int code = sqlite3_errcode(database_);
  if (code == SQLITE_FULL || code == SQLITE_IOERR)
    throw InvalidInput(fmt::format("cannot be written ({}); the {} samples before are safe: make room, then "
                                   "continue with --resume",
                                   sqlite3_errmsg(database_), count_),
                       {file_});
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
    throw InvalidInput("is not the table of a sweep, or is damaged. Remove it, or give another -o", {file_});
  throw InvalidInput(sqlite3_errmsg(database_), {file_});
}

void SweepTable::run(const std::string& sql) const {
  if (sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void SweepTable::create(const SweepPlan& plan, const SweepIdentity& identity) {
  run("BEGIN; " + samples_sql(plan) + "; " + meta_sql);
  for (const auto& [key, value] : identity) {
    Statement insert(database_, "INSERT INTO meta VALUES(?, ?)");
    insert.bind(1, key);
    insert.bind(2, value);
    insert.step();
    if (!insert.ended()) fail();
  }
  run("COMMIT");
  done_.assign(static_cast<std::size_t>(plan.size()), false);
}

void SweepTable::check_definition(const std::string& table, const std::string& sql) const {
  Statement made(database_, "SELECT sql FROM sqlite_master WHERE name = ?");
  made.bind(1, table);
  if (!made.step() || made.text(0) != sql || made.step())
    throw InvalidInput("is not the table of a sweep", {file_});
}

void SweepTable::check(const SweepIdentity& identity) const {
  SweepIdentity there;
  Statement all(database_, "SELECT key, value FROM meta");
  while (all && all.step()) there.emplace_back(all.text(0), all.text(1));
  const std::string what = difference(there, identity);
  if (!what.empty())
    throw InvalidInput("is the table of another sweep: " + what + " is not the same. Give another -o",
                       {file_});
}

void SweepTable::check_samples(const SweepPlan& plan) const {
  Statement made(database_, "SELECT 1 FROM sqlite_master WHERE name = 'samples' AND sql = ?");
  made.bind(1, samples_sql_without_checksum(plan));
  if (made.step())
    throw InvalidInput(
        "was written by an earlier version, without a checksum per row, and damage to it cannot be seen; "
        "compute the sweep into another -o",
        {file_});
  check_definition("samples", samples_sql(plan));
}

void SweepTable::find_done(const SweepPlan& plan) {
  done_.assign(static_cast<std::size_t>(plan.size()), false);
  each_row([&](const SampleRow& row, bool is_whole) {
    if (is_whole && row.factors == plan.samples.sample(static_cast<std::uint64_t>(row.sample))) {
      done_[static_cast<std::size_t>(row.sample)] = true;
      ++count_;
    } else {
      ++damaged_;
    }
  });
}

void SweepTable::insert(const SampleRow& given) {
  const SampleRow row = storable(given);
  sqlite3_reset(insert_);
  int place = 1;
  const auto bind = [&](double value) {
    if (std::isfinite(value))
      sqlite3_bind_double(insert_, place++, value);
    else
      sqlite3_bind_null(insert_, place++);
  };
  const auto bind_text = [&](const std::string& text) {
    sqlite3_bind_text(insert_, place++, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  };
  sqlite3_bind_int64(insert_, place++, row.sample);
  for (const double value : row.factors) bind(value);
  for (const double value : row.responses) bind(value);
  bind_text(to_string(row.status));
  bind_text(row.reason);
  bind_text(checksum(row));
  if (sqlite3_step(insert_) != SQLITE_DONE) fail();
}

void SweepTable::add(const std::vector<SampleRow>& rows) {
  run("BEGIN IMMEDIATE");
  for (const SampleRow& row : rows) insert(row);
  sqlite3_reset(insert_);
  run("COMMIT");
  for (const SampleRow& row : rows) done_[static_cast<std::size_t>(row.sample)] = true;
  count_ += static_cast<std::int64_t>(rows.size());
}

void SweepTable::each_row(const std::function<void(const SampleRow&, bool is_whole)>& see) const {
  Statement all(database_, "SELECT * FROM samples ORDER BY sample");
  SampleRow row;
  row.factors.resize(factors_);
  row.responses.resize(responses_);
  std::int64_t next = 0;
  while (all && all.step()) {
    int column = 0;
    row.sample = all.integer(column++);
    if (row.sample < next || row.sample >= static_cast<std::int64_t>(done_.size()))
      throw InvalidInput(
          "is damaged: it holds samples that this sweep has not. Remove it, or give another -o", {file_});
    next = row.sample + 1;
    for (double& value : row.factors) value = all.number(column++);
    for (double& value : row.responses) value = all.number(column++);
    row.status = status_of(all.text(column++));
    row.reason = all.text(column++);
    see(row, checksum(row) == all.text(column));
  }
  if (!all.ended()) fail();
}

void SweepTable::read(const std::function<void(const SampleRow&)>& see) const {
  std::int64_t seen = 0;
  each_row([&](const SampleRow& row, bool is_whole) {
    if (!done_[static_cast<std::size_t>(row.sample)]) return;
    if (!is_whole)
      throw InvalidInput(
          fmt::format("is damaged: the row of sample {} was changed meanwhile. Continue with --resume",
                      row.sample),
          {file_});
    ++seen;
    see(row);
  });
  if (seen != count_)
    throw InvalidInput(fmt::format("is damaged: {} of {} rows were lost meanwhile. Continue with --resume",
                                   count_ - seen, count_),
                       {file_});
}

}  // namespace kinetix::app
