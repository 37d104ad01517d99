#pragma once

#include <optional>

#include "model/contact/linkage_plates.hpp"
#include "model/contact/theta_interval.hpp"

namespace kinetix::model {

/// Two bodies, the hinges from the first to the second, and their plates that are not yet proven apart.
struct PlatesOfPair {
  int first = 0, second = 0;
  HingeChain chain;
  std::vector<WallPair> walls;
};

/// Two bodies within an interval of theta, each in the other's frame.
class SweptPair {
 public:
  /// @param plates, interval, pair kept by reference   @param margin_mm required distance of the plates
  SweptPair(const LinkagePlates& plates, const ThetaInterval& interval, const PlatesOfPair& pair,
            double margin_mm);

  /// Returns true if all plates are proven to stay apart over the interval, by the spheres around the bodies.
  bool is_apart() const;
  /// Returns true if two plates are proven apart, by their spheres or by a separating direction. @pre one of each
  /// body
  bool is_apart(const WallPair& walls);

 private:
  bool is_apart_from_there(const OrientedBox& own, const OrientedBox& other);

  const LinkagePlates& plates_;
  const ThetaInterval& interval_;
  const PlatesOfPair& pair_;
  double margin_mm_;
  Pose second_;                      ///< pose of the second body in the first one's frame
  SweptMotion there_;                ///< motion of the second body in the first one's frame
  std::optional<SweptMotion> back_;  ///< motion of the first body in the second one's frame
};

}  // namespace kinetix::model
