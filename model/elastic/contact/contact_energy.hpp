#pragma once

#include "model/contact/wall_contact.hpp"
#include "model/elastic/contact/contact_plates.hpp"
#include "model/elastic/contact/relative_motion.hpp"

namespace kinetix::model {

/// Point of one half wall that is pressed into another half wall through one face.
struct Contact {
  int plate = 0, point = 0;     ///< half wall (index as in half_walls()) and index of its point
  int other = 0;                ///< penetrated half wall
  Face face = Face::side_plus;  ///< nearest face of the penetrated half wall
  double depth = 0;             ///< cell edges, > 0
  bool operator==(const Contact& c) const {
    return plate == c.plate && point == c.point && other == c.other && face == c.face;
  }
};

/// Search for points of half walls inside the boxes of others. It skips the two halves of one wall, plates of
/// one body and plates that touch in the flat state. Nearby pairs are kept between calls until bodies may
/// have approached by a margin. Results do not depend on this.
class ContactSearch {
 public:
  ContactSearch(const Linkage& structure, bool planar);

  const ContactPlates& all() const { return all_; }
  /// Two half walls that overlap in the flat state, which cannot be built.
  const std::optional<WallPair>& overlap_at_rest() const { return overlap_at_rest_; }

  /// Returns points in contact, in a fixed order. Empty for poses that are not finite.
  const std::vector<Contact>& find(const State& state);

  /// Returns whether a point passed from one side of a half wall to the other. It must be next to the wall in
  /// both states. In the first state it must be within half a cell edge, so that it did not go around the
  /// end. Then the step was too long for contact to stop it. In space, points are also detected that entered
  /// from above or below and would be pushed out through a side.
  /// @pre both states are finite
  bool passed_through(const State& before, const State& after);
  /// Returns whether two half walls overlap during the screw motion from one state to the other, although
  /// they touch little or not at all in both states. Then a step between the states misses a contact.
  /// @pre both states are finite
  bool sweep_through(const State& before, const State& after);
  /// Returns whether two half walls cross that did not before, for example walls that slipped past each other
  /// from tip to tip. Contact forces do not prevent this: they grow only up to there. In the plane, middle
  /// lines must cross. In space, the walls must overlap by half a thickness or more in every direction.
  /// @pre both states are finite
  bool newly_cross(const State& before, const State& after);

 private:
  /// A plate, and another one whose box may contain points of it.
  struct PlatePair {
    int plate, other;
    auto operator<=>(const PlatePair&) const = default;
  };
  /// Origin and axes of a plate's box, cell edges.
  struct Box {
    Eigen::Vector3d origin, edge, normal, up;
  };
  /// Extent of a plate's points along another plate's edge, normal and up, cell edges.
  struct Extent {
    Eigen::Vector3d middle, half;

    /// Returns whether all points are on the same side of that plate in both states. @param half_thickness of
    /// that plate, cell edges
    bool stays_beside(const Extent& later, double half_thickness) const {
      const auto side = [&](const Extent& e) {
        if (!(std::abs(e.middle[1]) > half_thickness + e.half[1])) return 0;
        return e.middle[1] > 0 ? 1 : -1;
      };
      return side(*this) * side(later) > 0;
    }
  };

  void place(int plate, const State& state);
  void place(const State& state);
  void update_near(const State& state);
  /// Returns the position of a point in the last placed state, from another plate's vertex along its edge,
  /// normal and up. Cell edges.
  Eigen::Vector3d in_box(const Eigen::Vector3d& point, int other) const;
  Eigen::Vector3d in_box(const Contact& contact) const;
  /// Returns a plate's box in the frame of the other plate, cell edges.
  Box in_box(const PlatePair& pair) const;
  /// Returns the position of a plate's point. @param index index of the plate that `box` belongs to
  Eigen::Vector3d point_of(const Box& box, int index, const ContactPoint& point) const;
  Extent extent_of(const Box& box, int index) const;
  /// Returns the extent of the whole plate. In the plane, extent_of() covers its tip only.
  Extent whole_extent_of(const Box& box, int index) const;
  /// Returns whether a point of that extent may be in another plate's box grown by a margin, cell edges.
  bool may_be_within(const Extent& extent, int other, double margin) const;
  /// Returns the middles of all plates, one per column, cell edges.
  Eigen::Matrix3Xd placed_centers() const;
  /// Returns pairs with points that may be in a box grown by a margin, cell edges, in the last placed state.
  /// Sorted.
  std::vector<PlatePair> pairs_within(double margin);
  /// Returns pairs that may touch between two states. Sets `from` to each pair's plate in the frame of the
  /// other one, in the first state.
  std::vector<PlatePair> pairs_between(const State& before, const State& after, std::vector<Box>& from);
  bool may_touch(int plate, int other) const;
  /// Returns whether two half walls, cut along their hinges, overlap by half a thickness in every direction.
  bool are_deep(int plate, int other, const State& state) const;
  /// Returns plates that cross, each pair once. Sorted.
  std::vector<std::pair<int, int>> crossing(const State& state);
  /// Returns whether the middle line of a plate, in the plane, crosses the line of the other's box between
  /// its ends.
  bool is_cut(int plate, int other) const;
  /// Returns on which side of a half wall a point is, +1 or -1. 0 if it is not next to it, or is inside and
  /// closer to the end.
  /// @param y here and below, as returned by in_box()
  int side_of(const Eigen::Vector3d& y, int other) const;
  /// Returns whether a point is directly above or below a half wall, outside it.
  bool is_over(const Eigen::Vector3d& y, int other) const;
  /// Returns whether a point is so deep inside that contact pushes it out through a side, if it entered from
  /// above or below.
  bool is_past_edge(const Eigen::Vector3d& y, int other) const;
  bool is_within(const Eigen::Vector3d& y, int other, double margin) const;
  void add_if_inside(Contact contact);
  /// Adds all points of a plate that are inside the other one.
  void add_inside(const PlatePair& pair);
  /// Returns whether a plate enters the other one on its motion between two positions in the frame of the
  /// other one. It must overlap more than in both positions, and more than the uncertainty of the motion.
  bool sweeps_through(const PlatePair& pair, const Box& before, const Box& after) const;
  /// Returns whether all of a plate is on one side of the other's box in both positions.
  bool stays_off(const PlatePair& pair, const Box& before, const Box& after) const;
  OrientedBox oriented(const Box& box, int index) const;
  /// Checks one pair for passed_through(). The boxes are those of a plate in the frame of the other, in two
  /// states.
  bool went_through(const PlatePair& pair, const Box& before, const Box& after) const;

  ContactPlates all_;
  std::vector<HalfWall> walls_;
  std::vector<std::pair<int, int>> excluded_;  ///< touch at rest; sorted
  std::optional<WallPair> overlap_at_rest_;
  std::vector<Box> placed_boxes_;  ///< in the last placed state
  std::vector<PlatePair> near_;    ///< sorted
  std::vector<int> near_plates_;   ///< those in near_
  RelativeMotion moved_;           ///< since near_ was listed
  std::vector<Contact> found_;
  State found_state_;
  NearPairs finder_;
};

/// Contact of walls of thickness w: points of half walls (ContactPlates) against the boxes of other half
/// walls. Energy per point: 1/2 contact depth^2; in space a third of that, since a wall tip edge has three
/// points. The depth is measured to the nearest of the two sides, the end and (in space) top and bottom. It
/// is linear in the carried point. Energies are in units of k_point edge^2, stiffnesses of k_point.
///
/// As in the simulation, the two halves of one wall do not touch each other, nor do plates of one body or
/// plates that touch in the flat state. Some crossings cause no force: walls in the plane without a point
/// inside, and wall tip edges in space that cross between their points. newly_cross() detects both.
class ContactModel {
 public:
  /// @param planar as of contact_plates()
  ContactModel(const Linkage& structure, bool planar);

  const std::optional<WallPair>& overlap_at_rest() const { return search_.overlap_at_rest(); }
  const std::vector<Contact>& find(const State& state) { return search_.find(state); }
  bool passed_through(const State& before, const State& after) {
    return search_.passed_through(before, after);
  }
  bool sweep_through(const State& before, const State& after) { return search_.sweep_through(before, after); }
  bool newly_cross(const State& before, const State& after) { return search_.newly_cross(before, after); }

  int body(int plate) const { return all().plates[plate].body; }
  static int hinge(int plate) { return plate / 2; }

  /// Returns the energy of a contact. Body a is that of the point, b that of the box.
  Element element(const Contact& contact, double stiffness, const State& state) const;
  double energy(const std::vector<Contact>& contacts, double stiffness) const;

  /// Derivatives by t, alpha and beta of contact.plate's hinge, then of contact.other's.
  using ByTwoHinges = Eigen::Matrix<double, 6, 1>;
  /// Returns the derivatives of the gradient of a contact's energy, one column per parameter.
  Eigen::Matrix<double, 12, 6> derivatives(const Contact& contact, double stiffness,
                                           const State& state) const;
  /// Returns the derivative of the gradient of a contact's energy by the contact stiffness.
  Vector12 stiffness_rate(const Contact& contact, const State& state) const;
  /// Returns the derivatives of the depth of a contact.
  ByTwoHinges depth_gradient(const Contact& contact, const State& state) const;

 private:
  const ContactPlates& all() const { return search_.all(); }
  PointGap gap(const Contact& contact, const State& state) const;
  ByTwoHinges gap_gradient(const PointGap& gap, const Contact& contact, const State& state) const;

  ContactSearch search_;
  double weight_;  ///< of a point's energy, shared with others on the same wall tip edge
};

}  // namespace kinetix::model
