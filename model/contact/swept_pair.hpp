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

/// Two bodies within an interval of theta, each as the other sees it.
class SweptPair {
 public:
  /// @param plates, interval, pair kept by reference   @param margin_mm that plates have to keep
  SweptPair(const LinkagePlates& plates, const ThetaInterval& interval, const PlatesOfPair& pair,
            double margin_mm);

  /// Whether all plates are proven to stay apart over the interval, by the spheres round the bodies.
  bool is_apart() const;
  /// Whether two are, by the spheres round them or by a direction that separates them. @pre one of each body
  bool is_apart(const WallPair& walls);

 private:
  bool is_apart_from_there(const OrientedBox& own, const OrientedBox& other);

  const LinkagePlates& plates_;
  const ThetaInterval& interval_;
  const PlatesOfPair& pair_;
  double margin_mm_;
  Pose second_;                      ///< as the first one sees it
  SweptMotion there_;                ///< of the second one, likewise
  std::optional<SweptMotion> back_;  ///< of the first one, as the second one sees it
};

}  // namespace kinetix::model
