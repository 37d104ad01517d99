#pragma once

#include <array>
#include <optional>

#include "optim/display/hinge_ties.hpp"
#include "optim/display/panel_equilibrium.hpp"

namespace kinetix::optim {

/// What a search for a display may change, as one vector x: the variables of the hinges' ties, then the
/// compression where it has a range, then the offset of each hinge where they may have any.
struct DisplayVariables {
  HingeTies ties;
  std::array<double, 2> t = {0.08, 0.92};  ///< range, within (0, 1); with 0.5 inside where hinges are tied
  std::optional<std::array<double, 2>> compression;  ///< range, within (0, 0.5]
  double offset = 0;            ///< largest |offset| of a hinge, cell edges; 0: they stay
  Eigen::VectorXd middle = {};  ///< x that all others keep near to; empty: no matter how far
  double reach = 0;             ///< how near: largest change of an entry, in its own unit

  Eigen::VectorXd lower() const { return bounds(0); }
  Eigen::VectorXd upper() const { return bounds(1); }
  /// x nearest to the given t of each hinge and, where they may have any, its offsets (cell edges), within bounds.
  Eigen::VectorXd nearest(const Eigen::VectorXd& t, double compression,
                          const Eigen::VectorXd& offset = {}) const;

  Eigen::VectorXd t_of(const Eigen::VectorXd& x) const { return ties.expand(x.head(ties.variables)); }
  /// Of each hinge, cell edges; empty where they are none of x.
  Eigen::VectorXd offset_of(const Eigen::VectorXd& x) const;
  /// Nothing where it is none of x.
  std::optional<double> compression_of(const Eigen::VectorXd& x) const;
  /// Brings the panel to its equilibrium at x. @return as PanelEquilibrium::settle
  bool settle(PanelEquilibrium& equilibrium, const Eigen::VectorXd& x) const;
  /// By x, from derivatives by t and offset of each hinge and by the compression.
  Eigen::VectorXd gather(const PanelEquilibrium::Gradient& gradient) const;

 private:
  /// Of the ties' variables: hinges whose walls are turned end to end have 1 - t, which keeps the range as well.
  Eigen::VectorXd bounds_of_ties(int side) const;
  Eigen::VectorXd bounds(int side) const;
  Eigen::VectorXd joined(const Eigen::VectorXd& of_ties, double of_compression,
                         const Eigen::VectorXd& of_offsets) const;
};

}  // namespace kinetix::optim
