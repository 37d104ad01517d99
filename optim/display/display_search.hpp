#pragma once

#include "model/closure/closure.hpp"
#include "optim/display/display_problem.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::optim {

struct DisplayOptions {
  Channel channel = Channel::aperture;
  model::Plates plates = {};           ///< where the search starts; compression 0.12 unless given
  std::vector<model::Axis> axes = {};  ///< normals of the plates to search with; empty: that of `plates`
  std::optional<std::array<double, 2>> compression = {};  ///< search range, within (0, 1); unset: that of
                                                          ///< `plates`
  model::Elasticity elasticity = {};
  double separation = 0.16;  ///< separation of letter and rest that the search first aims at, in its unit
  double stretch = 0.12;     ///< largest allowed stretch of a hinge, cell edges
  std::array<double, 2> t = {0.08, 0.92};  ///< range, within (0, 1)
  double offset = 0;  ///< largest |offset| of a hinge, cell edges, [0, 0.5); above 0 no hinges are tied
  Symmetry symmetry = Symmetry::none;
  double rule_k = 0.15;    ///< fraction k of the uniform-scaling cells that the search starts from, (0, 1)
  int starts = 4;          ///< for each axis, >= 1
  int threads = 0;         ///< >= 0; 0 = all cores
  std::uint64_t seed = 0;  ///< for the random shifts of starts
  SolverOptions solver = {.name = SolverName::mma, .max_evaluations = 100};  ///< per stage
};

/// A panel and the picture it shows at the drive's goal.
struct DisplayView {
  Eigen::VectorXd t;       ///< of each hinge, in (0, 1)
  Eigen::VectorXd offset;  ///< of each hinge, cell edges; empty: all 0
  model::Plates plates;
  std::optional<model::HingeTurn> turn = {};  ///< of a driven hinge, in place of plates
  model::State state;                         ///< mm
  std::vector<double> channel;                ///< of each cell, by definition, in the channel's unit
  targets::DisplayScore score;
  double rank = 0;              ///< rank correlation of channel and levels, [-1, 1]
  double stretch = 0;           ///< largest stretch of a hinge, cell edges
  bool at_equilibrium = false;  ///< found along the path from flat; if false, only t and plates are known
};

/// Result of the second stage of a search.
struct SharpenedDisplay {
  std::vector<DisplayView> views;            ///< after each round
  SolveStatus status = SolveStatus::failed;  ///< of the last round
  std::string why;
};

/// Finds the panel's equilibrium for these t (fractions of the walls) and offsets (cell edges) along the path
/// from flat, and reads it. An empty `offset` leaves the offsets unchanged.
DisplayView view_from_flat(PanelEquilibrium& equilibrium, const Eigen::VectorXd& t,
                           const Eigen::VectorXd& offset, const std::vector<double>& levels, Channel channel);

/// Returns the index of the best view, or -1 if none is in equilibrium. Among views within the limit of
/// stretch it is the clearest picture, otherwise the view with the least stretch.
/// @param stretch that limit, cell edges
int best_view(const std::vector<DisplayView>& views, const std::vector<double>& levels, double stretch);

/// One search for a display, with plates along one axis.
class DisplaySearch {
 public:
  /// Keeps the references.
  DisplaySearch(const model::Lattice& panel, const std::vector<double>& levels, const DisplayOptions& options,
                model::Axis axis);

  /// Returns the start for a panel from another search: its hinges, within bounds.
  Eigen::VectorXd start(const DisplayView& view) const;
  /// Limits the following searches to the neighbourhood of x: no entry changes by more than `reach`, in its
  /// unit.
  void stay_near(const Eigen::VectorXd& x, double reach);
  /// Returns start k of a sheet of squares. Starts 0 and 1 follow the paper's rule with either choice of the
  /// checkerboard. Starts 2 and 3 are the same two at half strength. All others are the rule shifted at
  /// random.
  Eigen::VectorXd start(int k) const;
  std::string name_of_start(int k) const;

  DisplayView view(const Eigen::VectorXd& x);
  /// Searches towards options.separation.
  ScalarResult separate(const Eigen::VectorXd& x);
  /// Searches towards the highest contrast in rounds, each from flat. The penalty on stretch rises until the
  /// equilibrium from flat is within the limit. If a round was within it only in an equilibrium that the path
  /// from flat does not reach, later rounds find every equilibrium from flat.
  SharpenedDisplay sharpen(Eigen::VectorXd x);

  int evaluations() const { return evaluations_; }
  int paths_from_flat() const { return equilibrium_.paths_from_flat(); }

 private:
  /// Finds its first equilibrium from flat.
  ScalarResult search(DisplayProblem& problem, const Eigen::VectorXd& x);

  const std::vector<double>& levels_;
  const DisplayOptions& options_;
  PictureCost picture_;
  DisplayVariables variables_;
  PanelEquilibrium equilibrium_;
  int evaluations_ = 0;
};

/// Returns t of each hinge by the paper's rule: uniform-scaling cells of fraction k in the picture, basic
/// ones elsewhere. A wall between two cells takes the higher level. Levels between 0 and 1 give fractions
/// between.
/// @param k below 0.5 for one choice of the checkerboard, above for the other
Eigen::VectorXd rule_display(const model::Structure& panel, const std::vector<double>& levels, double k);

}  // namespace kinetix::optim
