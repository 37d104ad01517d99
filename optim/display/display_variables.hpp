#pragma once

#include <array>
#include <optional>

#include "optim/display/hinge_ties.hpp"
#include "optim/display/panel_equilibrium.hpp"

namespace kinetix::optim {

/// Variables of a display search as one vector x. It holds the variables of the hinges' ties, then the
/// compression if it has a range, then the offset of each hinge if offsets are allowed.
struct DisplayVariables {
  HingeTies ties;
  std::array<double, 2> t = {0.08, 0.92};  ///< range, within (0, 1); with 0.5 inside where hinges are tied
  std::optional<std::array<double, 2>> compression;  ///< range, within (0, 0.5]
  double offset = 0;            ///< largest |offset| of a hinge, cell edges; 0: offsets stay unchanged
  Eigen::VectorXd middle = {};  ///< x that all others stay near; empty: no limit
  double reach = 0;             ///< largest change of an entry from `middle`, in its unit

  Eigen::VectorXd lower() const { return bounds(0); }
  Eigen::VectorXd upper() const { return bounds(1); }
  /// Returns x nearest to the given t of each hinge and, if offsets are variables, its offsets (cell edges),
  /// within bounds.
  Eigen::VectorXd nearest(const Eigen::VectorXd& t, double compression,
                          const Eigen::VectorXd& offset = {}) const;

  Eigen::VectorXd t_of(const Eigen::VectorXd& x) const { return ties.expand(x.head(ties.variables)); }
  /// Returns the offset of each hinge, cell edges; empty if x has none.
  Eigen::VectorXd offset_of(const Eigen::VectorXd& x) const;
  /// Returns the compression, or nullopt if x has none.
  std::optional<double> compression_of(const Eigen::VectorXd& x) const;
  /// Brings the panel to its equilibrium at x. @return as PanelEquilibrium::settle
  bool settle(PanelEquilibrium& equilibrium, const Eigen::VectorXd& x) const;
  /// Returns the gradient by x, from derivatives by t and offset of each hinge and by the compression.
  Eigen::VectorXd gather(const PanelEquilibrium::Gradient& gradient) const;

 private:
  /// Returns the bounds of the ties' variables. Hinges whose walls are turned end to end have 1 - t, whose
  /// range is the same.
  Eigen::VectorXd bounds_of_ties(int side) const;
  Eigen::VectorXd bounds(int side) const;
  Eigen::VectorXd joined(const Eigen::VectorXd& of_ties, double of_compression,
                         const Eigen::VectorXd& of_offsets) const;
};

}  // namespace kinetix::optim
