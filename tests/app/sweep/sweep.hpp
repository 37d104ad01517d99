#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace kinetix::testing {

/// A strip of six columns. The first column bends.
inline constexpr const char* strip = R"(kinetix: 1
structure: {cells: [6, 1], cell_mm: 10}
design:
  theta_deg: 20
  hinges:
    - {wall: [[0, 0], [1, 0]], beta_deg: 30}
    - {wall: [[0, 1], [1, 1]], beta_deg: -30}
)";

/// Returns the text of a sweep over strip.yaml in the same folder.
inline std::string sweep_of(const std::string& method, const std::string& factors,
                            const std::string& responses, const std::string& more = {}) {
  return "kinetix: 1\nname: swept\nbase: strip.yaml\nmethod: " + method + "\nfactors:\n" + factors +
         "responses: [" + responses + "]\n" + more;
}

/// The columns of samples.csv, without its comment lines.
struct Csv {
  std::vector<std::string> head;
  std::vector<std::map<std::string, std::string>> rows;

  double number(std::size_t row, const std::string& column) const { return std::stod(rows[row].at(column)); }
};

inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

inline Csv read_csv(const std::string& folder) {
  Csv csv;
  std::ifstream file(folder + "/samples.csv");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    const auto fields = split(line);
    if (csv.head.empty()) {
      csv.head = fields;
      continue;
    }
    auto& row = csv.rows.emplace_back();
    for (std::size_t k = 0; k < fields.size() && k < csv.head.size(); ++k) row[csv.head[k]] = fields[k];
  }
  return csv;
}

/// Writes both files and runs the sweep into FOLDER/out.
inline Outcome run_sweep_in(const Scratch& scratch, const std::string& doe, const std::string& arguments = {},
                            const std::string& base = strip) {
  scratch.write("strip.yaml", base);
  return kinetix_opt("sweep " + scratch.write("doe.yaml", doe) + " -o " + (scratch / "out").string() + " " +
                     arguments);
}

}  // namespace kinetix::testing
