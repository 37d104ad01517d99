#pragma once

#include "app/console/console.hpp"
#include "app/console/short_form.hpp"
#include "app/run/plan.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Runs the program with the arguments of its process, once. @return its exit code
int run_command_line(int argc, char** argv);

/// Runs `kinetix-opt TARGET.yaml`: searches, verifies, writes.
int optimise_command(const CommandOptions& options);
/// Runs `kinetix-opt verify DESIGN.yaml`: simulates a design and compares it with the model, if one applies.
int verify_command(const CommandOptions& options);
/// Runs `kinetix-opt simulate DESIGN.yaml`: computes one folded state.
int simulate_command(const CommandOptions& options);
/// Runs `kinetix-opt check FILE.yaml`: validates a target, a design or a sweep. Writes nothing but the picture of
/// --picture, also of a drawing that is refused.
int check_command(const CommandOptions& options);

/// Collision-free range of a design's closed-form motion, computed without a simulation.
struct CheckedContact {
  ProvenRanges certified;
  double theta = 0;  ///< rad, fold that the drive reaches
};

/// Size of a drawing as it was read.
struct CheckedDrawing {
  Eigen::Vector2d size_mm;
  std::string unit;  ///< of its numbers, and where it is from

  std::string size_text() const;
};

/// Result of `check` for a valid file.
struct CheckedFile {
  std::string file;
  std::string kind;  ///< target, design or sweep
  std::string name;
  std::optional<Forecast> forecast = {};       ///< none for sweeps and for designs of bodies
  double samples = 0;                          ///< number of samples of a sweep
  std::optional<CheckedContact> contact = {};  ///< only for designs with an exact motion
  std::optional<CheckedDrawing> drawing = {};  ///< only for sheets that are drawn
  std::string cuts = {};                       ///< pieces and bridges of a sheet with cuts; empty for others

  std::string text() const;  ///< long form
  ShortForm short_form() const;
  nlohmann::ordered_json json() const;
};

/// Checks a target, a design or a sweep. @param root of the file   @param progress reports time and memory of a check of a second or more.
/// @throws InvalidInput for violations of the file format, and for a design that takes more memory than is free
CheckedFile check_file(const std::string& file, const targets::DocumentChanges& changes,
                       const Progress& progress);

}  // namespace kinetix::app
