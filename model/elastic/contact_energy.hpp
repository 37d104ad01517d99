#pragma once

#include <vector>

#include "model/elastic/elasticity.hpp"
#include "model/elastic/element.hpp"
#include "model/half_wall.hpp"
#include "model/near_pairs.hpp"

namespace kinetix {

/// A point of one half wall's knee (its end at the hinge) pressed into another half wall through one face.
struct Contact {
  int plate = 0, point = 0;  ///< half wall (as half_walls() counts them) and which of its points
  int other = 0, face = 0;   ///< half wall it is in, and the face that is nearest to it
  double depth = 0;          ///< cell edges, > 0
  bool operator==(const Contact& c) const {
    return plate == c.plate && point == c.point && other == c.other && face == c.face;
  }
};

/// Contact of walls of thickness w: knee points against the boxes of the other half walls, with the energy
/// 1/2 contact depth^2 a point (shared between the points along a knee edge in space). The depth is that to
/// the nearest of the two sides, the end and (in space) top and bottom: linear in the carried point.
/// As in the physics run, the two halves of one wall and plates of one body pass through each other, and
/// so do plates that touch in the flat state. Crossing edges without a knee point inside are not seen.
class ContactModel {
 public:
  /// @param planar one point a knee corner, at the height of the neutral plane; else three along its edge
  ContactModel(const Structure& structure, bool planar);

  /// Finds the pairs of half walls that can come into contact while no point of the structure moves by more
  /// than `margin` cell edges. @pre finite poses
  void update_near(const State& state, double margin);

  /// Points in contact, in a fixed order. Only pairs of the last update_near are looked at.
  std::vector<Contact> find(const State& state) const;

  int body(int plate) const { return plates_[plate].body; }
  int hinge(int plate) const { return plates_[plate].hinge; }

  /// a is the body of the point, b that of the box.
  Element element(const Contact& contact, double stiffness, const State& state) const;
  double energy(const std::vector<Contact>& contacts, double stiffness) const;

  /// How the gradient of a contact's energy changes with t and beta of the two hinges: columns t, beta of
  /// contact.plate's hinge, then of contact.other's.
  Eigen::Matrix<double, 12, 4> rates(const Contact& contact, double stiffness, const State& state) const;
  /// And with the stiffness.
  Vector12 stiffness_rate(const Contact& contact, const State& state) const;
  /// Derivative of depth by the same four, and by the thickness: for costs that use it.
  Eigen::Vector4d depth_rates(const Contact& contact, const State& state) const;

 private:
  struct Plate {
    int body, hinge;
    Eigen::Vector3d edge, up, normal;  ///< rest directions; edge points from the vertex to the knee
    Eigen::Vector3d up_rate, normal_rate;
    double sign;    ///< of d(length)/dt
    double length;  ///< cell edges
    std::vector<Eigen::Vector3d> points, point_rates;  ///< and their derivatives by beta
  };
  struct Pair {
    int first, second;
  };
  struct Gap;

  Plate make_plate(const Hinge& hinge, bool lower, double thickness, double height) const;
  void add_points_inside(int plate, int other, const State& state, std::vector<Contact>& found) const;
  Gap gap(const Contact& contact, const State& state) const;
  Eigen::Vector3d face_normal(const Plate& plate, int face) const;
  Eigen::Vector3d face_normal_rate(const Plate& plate, int face) const;
  double face_offset(const Plate& plate, int face) const;

  double edge_mm_, half_thickness_, half_height_;
  bool planar_;
  double weight_;
  std::vector<Plate> plates_;
  std::vector<std::pair<int, int>> excluded_;  ///< touch at rest; sorted
  std::vector<Pair> near_;
  NearPairs finder_;
};

}  // namespace kinetix
