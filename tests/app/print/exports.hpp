#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {

/// A flat sheet without specified hinges.
inline constexpr const char* panel = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 12, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 20}
)";

/// Exit code of an export that is refused because the design cannot be printed.
inline constexpr int not_printable = 3;

/// Writes a design, runs `export` on it into `out`, and returns its output.
inline Outcome exported(const Scratch& scratch, const std::string& design, const std::string& options) {
  return kinetix_opt("export " + scratch.write("panel.yaml", design) + " -o " + std::string(scratch / "out") +
                     " " + options);
}

/// Expects a refusal: one line on stderr, no files, and exit code 2, or 3 if the design cannot be printed. Uses
/// --quiet, since a slow machine may print its progress first.
inline void expect_refused(const std::string& design, const std::string& options, const std::string& says,
                           int code = 2) {
  const Scratch scratch;
  const Outcome run = exported(scratch, design, options + " --quiet");
  EXPECT_EQ(run.code, code) << run.out << run.err;
  EXPECT_THAT(run.err, ::testing::HasSubstr(says));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_FALSE(fs::exists(scratch / "out")) << says;
}

/// Returns print.json and checks it against its schema.
inline nlohmann::json print_json_of(const Scratch& scratch) {
  nlohmann::json json = nlohmann::json::parse(text_of(scratch / "out/print.json"));
  EXPECT_EQ(schema_errors(json, "print"), "");
  return json;
}

/// Returns both output streams of a program. Fails if the program is missing.
inline std::string command_output(const std::string& command) {
  std::string out;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  char text[4096];
  while (const std::size_t n = std::fread(text, 1, sizeof text, pipe)) out.append(text, n);
  const int status = pclose(pipe);
  EXPECT_EQ(WEXITSTATUS(status), 0) << command << "\n" << out;
  return out;
}

/// Computes the width of a binary STL file along x, mm.
inline double width_of_stl(const std::string& bytes) {
  float least = INFINITY, most = -INFINITY;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    float n[12];
    std::memcpy(n, bytes.data() + at, sizeof n);
    for (const int k : {3, 6, 9}) {
      least = std::min(least, n[k]);
      most = std::max(most, n[k]);
    }
  }
  return most - least;
}

}  // namespace kinetix::testing
