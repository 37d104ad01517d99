#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "app/files/goal_settings.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// What is known of a run beforehand.
struct Forecast {
  model::Lattice sheet;  ///< as it will be, or nearly: hinges are still to be found
  std::optional<Eigen::Vector3d> folded_mm =
      {};               ///< edges of the box around the folded thing, where they are known
  double search_s = 0;  ///< about; within a factor of three on one core of 2020
  bool has_physics = true;
  std::vector<std::string> notes = {};  ///< what is likely to go wrong, and what would help
};

/// About how long what makes up for elastic hinges takes, s, measured on folds of 30 to 170 bodies; 0 of other hinges.
double matter_seconds(const GoalSettings& settings, const model::Lattice& sheet);

/// Adds what the settings that every goal has take and risk: matter_seconds(), and what the process cannot make.
void add_settings(const GoalSettings& settings, Forecast& forecast);

/// Edges of the box around all half walls of the flat sheet, mm: walls that lean reach beyond its cells.
Eigen::Vector3d flat_size(const model::Linkage& linkage);

/// Edges of the box around all half walls in a state, along the axes of its frame, mm.
Eigen::Vector3d size_of(const model::Linkage& linkage, const model::State& state);

/// About how long a physics run takes, s, on one core of 2020; measured on sheets of 80 to 900 bodies, where a loop of hinges is
/// what costs, one a cell, and on blocks of 384 to 5000 bodies, whose factors fill: within a factor of two.
double physics_seconds(const model::Lattice& sheet);

/// Estimates the time that the collision-free range takes, s, on one core of 2020; measured on sheets of 4000 to 63 000 bodies.
double contact_seconds(const model::Lattice& sheet);

/// About how much memory a run takes, bytes, measured likewise.
double memory_needed(const model::Linkage& linkage);

/// "about 2 s", "about 5 minutes": as exactly as an estimate is. @param seconds >= 0
std::string about(double seconds);

}  // namespace kinetix::app
