#pragma once

#include <functional>
#include <limits>

#include "optim/display/channel.hpp"
#include "optim/display/display_cost.hpp"
#include "optim/display/display_variables.hpp"
#include "optim/solvers/scalar_solver.hpp"

namespace kinetix::optim {

/// Search for a panel that shows a picture. The objective is a cost of the readings plus a penalty on hinge
/// stretch beyond a limit.
class DisplayProblem : public ScalarProblem {
 public:
  using Cost = std::function<WeighedReadings(const std::vector<double>&)>;

  /// Start of the equilibria of a search. The best point so far leads the search quickly. Its equilibrium
  /// may, however, be one that the path from flat does not reach.
  enum class Settling { from_best, from_flat };

  /// @param stretch largest allowed stretch of a hinge, cell edges
  /// @param weight of the squared relative excess of a hinge's stretch over that limit
  DisplayProblem(PanelEquilibrium& equilibrium, const DisplayVariables& variables, Channel channel, Cost cost,
                 double stretch, double weight, Settling settling = Settling::from_best);

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, double& f, Eigen::VectorXd* gradient) override;

  /// Returns the largest stretch of a hinge in the equilibrium of least cost so far, cell edges.
  double stretch_of_best() const { return stretch_of_best_; }

 private:
  /// Computes cost and gradient at the equilibrium found.
  bool weigh(double& f, Eigen::VectorXd* gradient);

  double add_picture(model::PanelGradient& gradient) const;
  double add_stretch(model::PanelGradient& gradient) const;

  PanelEquilibrium& equilibrium_;
  const DisplayVariables& variables_;
  Channel channel_;
  Cost cost_;
  double stretch_, weight_;
  Settling settling_;
  double least_ = std::numeric_limits<double>::infinity(), stretch_of_best_ = 0;
  Eigen::VectorXd lower_, upper_;
};

}  // namespace kinetix::optim
