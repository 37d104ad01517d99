#pragma once

#include <memory>

#include "model/state.hpp"
#include "sim/drive.hpp"
#include "sim/physics_options.hpp"

namespace kinetix {

/// Deepest overlap of two parts that do not share a hinge.
struct DeepestContact {
  int first = -1, second = -1;  ///< bodies; -1 where nothing touches
  double depth = 0;             ///< cell edges
};

/// A structure as rigid parts, hinges and a drive in the engine. Units: cell edge 1, part mass 1, s.
///
/// The quasi-static answer depends on neither mass nor inertia, so those are chosen for the solver: equal
/// masses, the same inertia about every axis, centre of mass on the vertex.
class World {
 public:
  World(const Structure& structure, const Drive& drive, const PhysicsOptions& options);
  ~World();

  /// Starts the bodies on the drive's branch. @param rate of theta, rad/s
  void start(double rate);
  /// Sets where the drive is to be at the end of the next step. @param theta of the drive, with sign, rad
  void set_drive(double theta);
  void step();
  /// Multiplies all speeds. @param factor in [0, 1]
  void damp(double factor);

  State state() const;          ///< mm
  double fastest_part() const;  ///< largest speed or turning speed, 1/s; NaN if any is not finite
  DeepestContact deepest_contact() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kinetix
