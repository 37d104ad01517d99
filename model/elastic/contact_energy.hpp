#pragma once

#include <optional>
#include <vector>

#include "model/elastic/elasticity.hpp"
#include "model/elastic/element.hpp"
#include "model/half_wall.hpp"
#include "model/near_pairs.hpp"
#include "model/wall_contact.hpp"

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

  /// Two half walls that overlap in the flat state: nothing that could be built.
  const std::optional<WallPair>& overlap_at_rest() const { return overlap_at_rest_; }

  /// Points in contact, in a fixed order. Candidates are kept from call to call until the structure has moved
  /// by more than a margin: what is found does not depend on it. Empty for poses that are not finite.
  const std::vector<Contact>& find(const State& state);

  /// Whether a point went from one side of a half wall to the other, beside it in both states and within half a
  /// cell edge of it before: then it did not go round its end, and the step between the states was too long for
  /// contact to stop it. @pre both states are finite
  bool passed_through(const State& before, const State& after);

  int body(int plate) const { return plates_[plate].body; }
  static int hinge(int plate) { return plate / 2; }

  /// a is the body of the point, b that of the box.
  Element element(const Contact& contact, double stiffness, const State& state) const;
  double energy(const std::vector<Contact>& contacts, double stiffness) const;

  /// How the gradient of a contact's energy changes with t and beta of the two hinges: columns t, beta of
  /// contact.plate's hinge, then of contact.other's.
  Eigen::Matrix<double, 12, 4> rates(const Contact& contact, double stiffness, const State& state) const;
  /// And with the stiffness.
  Vector12 stiffness_rate(const Contact& contact, const State& state) const;
  /// Derivative of depth by the same four.
  Eigen::Vector4d depth_rates(const Contact& contact, const State& state) const;

 private:
  struct Plate {
    int body;
    Eigen::Vector3d edge, up, normal;  ///< rest directions; edge points from the vertex to the knee
    Eigen::Vector3d up_rate, normal_rate;
    double sign;    ///< of d(length)/dt
    double length;  ///< cell edges
    std::vector<Eigen::Vector3d> points, point_rates;  ///< and their derivatives by beta
  };
  struct Pair {
    int point, other;
    auto operator<=>(const Pair&) const = default;
  };
  struct Gap;

  Plate make_plate(const Hinge& hinge, bool lower, double thickness, double height) const;
  void place(int plate, const State& state);
  void place(const State& state);
  bool has_moved(const State& state) const;
  void update_near(const State& state);
  /// Points that are in a box grown by a margin, cell edges, in the state last placed. Sorted.
  std::vector<Pair> pairs_within(double margin);
  bool may_touch(int plate, int other) const;
  /// +1 or -1: on which side of a half wall a point is; 0 where it is not beside it, or inside and
  /// nearer to its end.
  int side_of(int point, int other) const;
  bool is_within(const Eigen::Vector3d& point, int other, double margin) const;
  void add_if_inside(int point, int other);
  Gap gap(const Contact& contact, const State& state) const;
  Eigen::Vector4d gap_rates(const Gap& gap, const Contact& contact, const State& state) const;
  Eigen::Vector3d face_normal(const Plate& plate, int face) const;
  Eigen::Vector3d face_normal_rate(const Plate& plate, int face) const;
  double face_offset(const Plate& plate, int face) const;

  double edge_mm_, half_thickness_, half_height_;
  bool planar_;
  double weight_;
  std::vector<Plate> plates_;
  std::vector<std::pair<int, int>> excluded_;  ///< touch at rest; sorted
  std::optional<WallPair> overlap_at_rest_;
  int points_per_plate_;
  /// In the state last placed: all points, and origin and directions of each plate's box, cell edges.
  std::vector<Eigen::Vector3d> placed_points_;
  struct PlacedBox {
    Eigen::Vector3d origin, edge, normal, up;
  };
  std::vector<PlacedBox> placed_boxes_;
  std::vector<Pair> near_;        ///< (point, plate), sorted
  std::vector<int> near_plates_;  ///< those in near_
  State near_state_;
  std::vector<Contact> found_;
  State found_state_;
  NearPairs finder_;
};

}  // namespace kinetix
