#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/contact/wall_contact.hpp"
#include "model/tolerance/as_made.hpp"

namespace kinetix::model {

/// Two plates that are close in a state.
struct SuspectPair {
  WallPair walls;
  double near_mm = 0;   ///< distance that the scatter of their bodies allows
  double nearness = 0;  ///< ratio: their gap over that distance, below 1
};

/// Search for plates that are closer in a state than the scatter of their bodies.
class SuspectPlates {
 public:
  /// @param changes of the fold's state in some prints, as from DesignSensitivities::change
  SuspectPlates(const Linkage& linkage, const std::vector<Eigen::VectorXd>& changes,
                const HingeScatter& scatter);

  std::vector<SuspectPair> find(const State& state);

  /// Returns whether two suspects are closer in a print than `share` times the distance that their scatter
  /// allows. A negative share tests whether they overlap deeper than that.
  /// @param walls of the print
  bool are_nearer(const State& print, const std::vector<HalfWall>& walls,
                  const std::vector<SuspectPair>& suspects, double share) const;
  /// Returns whether two suspects overlap in a print. @param walls of the print
  bool touch(const State& print, const std::vector<HalfWall>& walls,
             const std::vector<SuspectPair>& suspects) const;

  /// Returns the half walls of the design.
  const std::vector<HalfWall>& walls() const { return walls_; }

 private:
  /// Motion of a body from the design to a print.
  struct Motion {
    Eigen::Vector3d turn;   // rad
    Eigen::Vector3d shift;  // of its vertex, mm

    /// Returns the shift of a point that the body carries, mm. @param from the body's vertex to the point, mm
    Eigen::Vector3d at(const Eigen::Vector3d& from) const { return shift + turn.cross(from); }
  };

  /// Rms over prints of the relative motion of two bodies: shift (mm) at a point between them, and turn
  /// (rad).
  struct Scatter {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    double shift = 0, turn = 0;

    double near(const Eigen::Vector3d& place) const;
  };

  Scatter scatter(const State& state, int a, int b) const;
  void add(const State& state, int a, int b, std::vector<SuspectPair>& found) const;
  void add_walls(const WallPair& pair, const Scatter& apart, std::vector<SuspectPair>& found) const;

  double depth_mm_;
  std::vector<HalfWall> walls_;
  WallContact at_rest_;
  std::vector<std::vector<int>> plates_of_;   ///< of each body
  std::vector<double> reach_;                 ///< of each body's plates from its vertex, mm
  std::vector<std::vector<Motion>> motions_;  ///< of each body in the sample prints
  double moved_ = 0;                          ///< largest shift of any body, mm
  std::vector<double> plate_scatter_;         ///< of each plate on its body, times suspect_deviations, mm
  double largest_plate_scatter_ = 0;
  std::vector<OrientedBox> boxes_;  ///< of the state that is searched
  NearPairs near_;
};

}  // namespace kinetix::model
