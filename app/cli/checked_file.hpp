#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/run/forecast.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// What is proven of a design without a run: how far its closed form folds without contact.
struct CheckedContact {
  ProvenRanges certified;
  double theta = 0;  ///< rad, to which its drive takes it
};

/// What `check` has to say of a file that is valid.
struct CheckedFile {
  std::string file;
  std::string kind;  ///< target, design or sweep
  std::string name;
  std::optional<Forecast> forecast = {};       ///< not of sweeps
  double samples = 0;                          ///< number of them, of sweeps
  std::optional<CheckedContact> contact = {};  ///< of designs that move exactly

  std::string text() const;
  nlohmann::ordered_json json() const;
};

/// @param progress gets a stage for a design that takes a second or more: how long and how much memory
/// @throws InvalidInput for whatever the formats do not allow, and for a design that takes more memory than is free
CheckedFile check_file(const std::string& file, const Progress& progress);

}  // namespace kinetix::app
