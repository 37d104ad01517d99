#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/closure/closure_drive.hpp"
#include "optim/display/display_problem.hpp"
#include "targets/display/display_score.hpp"

namespace kinetix::optim {

struct DisplayOptions {
  Channel channel = Channel::aperture;
  model::Plates plates = {};           ///< where the search starts; compression 0.12 unless given
  std::vector<model::Axis> axes = {};  ///< normals of the plates to search with; empty: that of `plates`
  std::optional<std::array<double, 2>> compression = {};  ///< range to search in, within (0, 1); nothing:
                                                          ///< that of `plates`
  model::Elasticity elasticity = {};
  double separation = 0.16;  ///< of letter and rest that the search first aims at, in the channel's unit
  double stretch = 0.12;     ///< most that a hinge may stretch, cell edges
  std::array<double, 2> t = {0.08, 0.92};  ///< range, within (0, 1)
  double offset = 0;  ///< largest |offset| of a hinge, cell edges, [0, 0.5); above 0 each hinge is by itself
  Symmetry symmetry = Symmetry::none;
  double rule_k = 0.15;    ///< fraction k of the uniform-scaling cells that the search starts from, (0, 1)
  int starts = 4;          ///< for each axis, >= 1
  int threads = 0;         ///< >= 0; 0 = all cores
  std::uint64_t seed = 0;  ///< of starts shifted at random
  SolverOptions solver = {.name = SolverName::mma, .max_evaluations = 100};  ///< a stage
};

/// A panel and how it shows its picture at the drive's goal.
struct DisplayView {
  Eigen::VectorXd t;       ///< of each hinge, in (0, 1)
  Eigen::VectorXd offset;  ///< of each hinge, cell edges; empty: all 0
  model::Plates plates;
  std::optional<model::HingeTurn> turn = {};  ///< of a driven hinge, in place of plates
  model::State state;                         ///< mm
  std::vector<double> channel;                ///< of each cell, by definition, in the channel's unit
  targets::DisplayScore score;
  double rank = 0;              ///< rank correlation of channel and levels, -1 to 1
  double stretch = 0;           ///< largest of a hinge, cell edges
  bool at_equilibrium = false;  ///< found along the path from flat; t and plates alone are known where not
};

/// What the second stage of a search came to.
struct SharpenedDisplay {
  std::vector<DisplayView> views;            ///< after each round
  SolveStatus status = SolveStatus::failed;  ///< of the last
  std::string why;
};

/// The panel's equilibrium with these t (fractions of the walls) and offsets (cell edges; empty: they stay), found
/// anew from flat, and what it shows.
DisplayView view_from_flat(PanelEquilibrium& equilibrium, const Eigen::VectorXd& t,
                           const Eigen::VectorXd& offset, const std::vector<double>& levels, Channel channel);

/// Which of the views is to be taken: of those that keep the limit of stretch the one that shows its picture
/// most clearly, else the one that stretches least; -1 where none is in equilibrium. @param stretch that
/// limit, cell edges
int best_view(const std::vector<DisplayView>& views, const std::vector<double>& levels, double stretch);

/// One search for a display, with plates along one axis.
class DisplaySearch {
 public:
  /// The references are kept.
  DisplaySearch(const model::Lattice& panel, const std::vector<double>& levels, const DisplayOptions& options,
                model::Axis axis);

  /// Where a panel that was found otherwise begins: its hinges, within bounds.
  Eigen::VectorXd start(const DisplayView& view) const;
  /// From here on the search keeps near to x: no entry changes by more than `reach`, in its own unit.
  void stay_near(const Eigen::VectorXd& x, double reach);
  /// Where start k of a sheet of squares begins: from the paper's rule, by one choice of the checkerboard and the other; then from
  /// the same half as strong; all others from the rule shifted at random.
  Eigen::VectorXd start(int k) const;
  std::string name_of_start(int k) const;

  DisplayView view(const Eigen::VectorXd& x);
  /// Towards options.separation.
  ScalarResult separate(const Eigen::VectorXd& x);
  /// Towards the highest contrast in rounds, each from flat, with a penalty on stretch that rises until the
  /// equilibrium from flat keeps the limit. Where a round kept it only in an equilibrium that the path from
  /// flat does not come to, the rounds after it find every equilibrium from flat.
  SharpenedDisplay sharpen(Eigen::VectorXd x);

  int evaluations() const { return evaluations_; }
  int paths_from_flat() const { return equilibrium_.paths_from_flat(); }

 private:
  /// Its first equilibrium is found from flat.
  ScalarResult search(DisplayProblem& problem, const Eigen::VectorXd& x);

  const std::vector<double>& levels_;
  const DisplayOptions& options_;
  PictureCost picture_;
  DisplayVariables variables_;
  PanelEquilibrium equilibrium_;
  int evaluations_ = 0;
};

/// The paper's rule: uniform-scaling cells of fraction k where the picture is, basic ones elsewhere; a wall
/// of two cells takes the higher level, and levels between mean fractions between. @return t of each hinge
/// @param k below 0.5 for one choice of the checkerboard, above for the other
Eigen::VectorXd rule_display(const model::Structure& panel, const std::vector<double>& levels, double k);

}  // namespace kinetix::optim
