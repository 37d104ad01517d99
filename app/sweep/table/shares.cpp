#include "app/sweep/table/shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_shares = 100000;  // tasks of the largest job arrays
constexpr std::size_t rows_at_once = 10000;   // per transaction: a few MB

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
  if (!number || !count || *count < 1 || *count > most_shares || *number < 1 || *number > *count)
    throw InvalidInput(
        fmt::format("--share: '{}' is not K/N with K from 1 to N, N at most {}", text, most_shares));
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

void take_over(const std::string& share, SweepTable& table, const SweepPlan& plan,
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

}  // namespace kinetix::app
