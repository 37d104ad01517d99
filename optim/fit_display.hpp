#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "optim/display_problem.hpp"
#include "targets/display_score.hpp"

namespace kinetix {

struct DisplayOptions {
  Channel channel = Channel::aperture;
  Drive plates = {};              ///< compression 0.12 unless given
  Elasticity elasticity = {};
  double separation = 0.16;       ///< of letter and rest that the search first aims at, in the channel's unit
  double stretch = 0.12;          ///< most that a hinge may stretch, cell edges
  std::array<double, 2> t = {0.08, 0.92};
  Symmetry symmetry = Symmetry::none;
  double rule_k = 0.15;           ///< of the uniform-scaling cells that the search starts from
  SolverOptions solver = {.name = SolverName::mma, .max_evaluations = 100};  ///< a stage
};

/// A panel and how it shows its picture at the drive's goal.
struct DisplayView {
  Eigen::VectorXd t;            ///< of each hinge
  State state;
  std::vector<double> channel;  ///< of each cell, by definition
  DisplayScore score;
  double rank = 0;              ///< rank correlation of channel and levels
  double stretch = 0;           ///< largest of a hinge, cell edges
  bool balanced = false;        ///< found along the path from flat; nothing else is known where not
};

/// One start of the search.
struct DisplayStart {
  std::string name;
  DisplayView view;   ///< before the search
  double cost = 0;    ///< after its first stage
  SolveStatus status = SolveStatus::failed;
};

struct DisplayDesign {
  DisplayView view;                 ///< of the best, its balance found anew from flat
  std::vector<DisplayStart> starts;
  SolveStatus status = SolveStatus::failed;
  std::string why;
  int evaluations = 0, paths_from_flat = 0;
};

/// The panel as it is: balanced from flat and read.
DisplayView view_display(const Structure& panel, const std::vector<double>& levels, const DisplayOptions& options);

/// The paper's rule: uniform-scaling cells of fraction k where the picture is, basic ones elsewhere; a wall of
/// two cells takes the higher level, and levels between mean fractions between. @return t of each hinge
/// @param k below 0.5 for one choice of the checkerboard, above for the other
Eigen::VectorXd rule_display(const Structure& panel, const std::vector<double>& levels, double k);

/// From the paper's rule by both choices of the checkerboard, each first towards options.separation; the best of
/// them then towards the highest contrast.
/// @param panel basic cells that fill a rectangle   @param levels of each of its cells, 0 to 1, not all the same
/// @param progress words and the share done
/// @throws InvalidInput for options or a panel that cannot be
DisplayDesign fit_display(const Structure& panel, const std::vector<double>& levels, const DisplayOptions& options,
                          const std::function<void(const std::string&, double)>& progress = {});

}  // namespace kinetix
