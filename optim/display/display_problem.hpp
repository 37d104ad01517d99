#pragma once

#include <limits>

#include "model/elastic/elastic_system.hpp"
#include "model/lattice/lattice.hpp"
#include "model/lattice/square/family/drive.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/display/display_reading.hpp"
#include "optim/solvers/nlopt_solver.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Hinges of a rectangular panel that share a variable for t, which gives the flat panel the symmetry of a
/// motion of the plane. Hinge h has t = x[variable[h]], or 1 - x[variable[h]] if the motion turns its wall
/// end to end. A wall that it maps onto itself keeps t = 0.5: `centred`.
struct HingeTies {
  static constexpr int centred = -1;  ///< in place of an index: the hinge has no variable
  std::vector<int> variable;
  std::vector<bool> reversed;
  int variables = 0;

  Eigen::VectorXd expand(const Eigen::VectorXd& x) const;
  /// Returns the gradient by x of a function with the given gradient by t of all hinges.
  Eigen::VectorXd gather(const Eigen::VectorXd& by_t) const;
  /// Returns t with every hinge on the same side of the middle as the first hinge of its variable; other
  /// hinges get 1 - t. On panels with an odd number of cells per side a motion swaps the sublattices. The
  /// picture's demands on both would then cancel.
  Eigen::VectorXd to_one_side(Eigen::VectorXd t) const;
  /// Returns the x for which expand() is nearest to t, least squares.
  Eigen::VectorXd nearest(const Eigen::VectorXd& t) const;
};

/// Returns ties with a separate variable for each hinge.
HingeTies untied(int hinges);
/// Returns the ties of a symmetry. @pre the cells fill a rectangle; a square for rotate_4
HingeTies hinge_ties(const model::Structure& panel, Symmetry symmetry);

/// Equilibrium of a planar panel with elastic hinges between plates, its walls in contact. It is found again
/// after each change of the hinges' places or of the compression. The search starts from the last equilibrium
/// and falls back to the path from flat if no nearby one is found.
class PanelEquilibrium {
 public:
  /// @pre all hinges are perpendicular to the plane; elasticity and plates are valid
  /// @throws InvalidInput for walls that overlap in the flat state
  PanelEquilibrium(model::Lattice panel, const model::Elasticity& elasticity, const model::Plates& plates);

  /// Finds the equilibrium for these hinges. The state is unchanged on failure.
  /// @param t of every hinge, in (0, 1)
  /// @param offset of every hinge, cell edges; empty: unchanged
  /// @return whether a stable equilibrium at the drive's goal was found
  bool settle(const Eigen::VectorXd& t, const Eigen::VectorXd& offset = {});
  /// Sets the compression of the plates from the next settle() on, (0, 1).
  void press(double compression) { drive_.compression = compression; }
  /// Makes the next settle() start from the present state. Its result then depends on this state only, not on
  /// other states tried since. @pre settle() returned true
  void keep() { kept_ = state_; }
  /// Makes the next settle() start from flat.
  void forget() { kept_.clear(); }

  const model::Lattice& panel() const { return panel_; }
  const model::Plates& plates() const { return drive_; }
  /// @pre settle() returned true
  const model::State& state() const { return state_; }  ///< mm

  struct Gradient {
    Eigen::VectorXd t;       ///< one entry per hinge, per unit of t (a fraction)
    Eigen::VectorXd offset;  ///< one entry per hinge, per cell edge
    double compression = 0;  ///< per unit of compression (a fraction)
  };
  /// Returns the derivatives of a function of the state, by the adjoint. Direct derivatives of the function
  /// by the hinges are not included; the caller adds them. Returns nullopt if the equilibrium is singular.
  /// @param by_state 6 per body, as EquilibriumGradient::state
  std::optional<Gradient> gradient(const Eigen::VectorXd& by_state);

  int paths_from_flat() const { return paths_; }

 private:
  bool settle_nearby();
  bool settle_from_flat();
  model::LinkageDrive plates_on_panel() const;

  model::Lattice panel_;
  model::Elasticity elasticity_;
  model::Plates drive_;
  model::State state_, kept_;
  int paths_ = 0;
};

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

/// Search for a panel that shows a picture. The objective is a cost of the readings plus a penalty on hinge
/// stretch beyond a limit.
class DisplayProblem : public ScalarProblem {
 public:
  using Cost = std::function<WeightedReadings(const std::vector<double>&)>;

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
