#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/contact/wall_contact.hpp"
#include "model/tolerance/as_made.hpp"

namespace kinetix::model {

/// Plates that come close in a state.
struct SuspectPair {
  WallPair walls;
  double near_mm = 0;   ///< distance that the scatter of their bodies allows
  double nearness = 0;  ///< ratio of their gap to that distance, below 1
};

/// Finds plates that come closer in a state than the scatter of their bodies.
class SuspectPlates {
 public:
  /// @param changes of the state of the fold in some prints, as of DesignSensitivities::change
  SuspectPlates(const Linkage& linkage, const std::vector<Eigen::VectorXd>& changes,
                const HingeScatter& scatter);

  std::vector<SuspectPair> find(const State& state);

  /// Whether two of them are nearer to each other in a print than this share of the distance that their scatter allows; below 0:
  /// deeper in each other. @param walls of the print
  bool are_nearer(const State& print, const std::vector<HalfWall>& walls,
                  const std::vector<SuspectPair>& suspects, double share) const;
  /// @param walls of the print
  bool touch(const State& print, const std::vector<HalfWall>& walls,
             const std::vector<SuspectPair>& suspects) const;

  /// Of the design.
  const std::vector<HalfWall>& walls() const { return walls_; }

 private:
  /// How a print has a body elsewhere than the design.
  struct Motion {
    Eigen::Vector3d turn;   // rad
    Eigen::Vector3d shift;  // of its vertex, mm

    /// Of a point that it carries. @param from its vertex, mm
    Eigen::Vector3d at(const Eigen::Vector3d& from) const { return shift + turn.cross(from); }
  };

  /// How far two bodies move apart at a point between them, mm, and turn against each other, rad: each the rms over prints.
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
  std::vector<std::vector<int>> plates_of_;   ///< each body
  std::vector<double> reach_;                 ///< of each body's plates from its vertex, mm
  std::vector<std::vector<Motion>> motions_;  ///< of each body in those prints
  double moved_ = 0;                          ///< of any of them, mm
  std::vector<double> plate_scatter_;         ///< of each plate on its body, as far as it counts, mm
  double largest_plate_scatter_ = 0;
  std::vector<OrientedBox> boxes_;  ///< of the state that is looked at
  NearPairs near_;
};

}  // namespace kinetix::model
