#include "app/sweep/table/sweep_csv.hpp"

#include <cmath>

#include "app/io/atomic_file.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {
namespace {

constexpr std::size_t piece_bytes = 1 << 20;  // 1 MiB per piece: few calls to write, little memory

/// Quotes the text if CSV requires it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string header(const SweepPlan& plan, const SweepIdentity& identity) {
  std::string text;
  for (const auto& [key, value] : identity)
    if (key != "doe" && key != "base" && key != "factors" && key != "responses")
      text += "# " + key + ": " + value + "\n";
  text += "sample";
  for (const optim::Factor& factor : plan.samples.factors()) text += "," + field(factor.name);
  for (const Metric& metric : plan.responses) text += "," + field(metric.name);
  return text + ",status,reason\n";
}

}  // namespace

std::string csv_line(const SampleRow& row) {
  std::string text = std::to_string(row.sample);
  const auto add = [&](double value) {
    text += "," + (std::isfinite(value) ? targets::shortest_text(value) : "");
  };
  for (const double value : row.factors) add(value);
  for (const double value : row.responses) add(value);
  return text + "," + to_string(row.status) + "," + field(row.reason);
}

void write_csv(const std::string& folder, const SweepTable& table, const SweepPlan& plan,
               const SweepIdentity& identity) {
  write_file(folder + "/samples.csv", [&](const FileSink& sink) {
    std::string text = header(plan, identity);
    table.read([&](const SampleRow& row) {
      text += csv_line(row) + "\n";
      if (text.size() < piece_bytes) return;
      sink(text);
      text.clear();
    });
    sink(text);
  });
}

}  // namespace kinetix::app
