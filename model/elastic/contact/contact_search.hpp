#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "model/contact/near_pairs.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/elastic/contact/contact_plates.hpp"
#include "model/elastic/contact/relative_motion.hpp"
#include "model/linkage/half_wall.hpp"

namespace kinetix::model {

/// A point of one half wall pressed into another half wall through one face.
struct Contact {
  int plate = 0, point = 0;     ///< half wall (as half_walls() counts them) and which of its points
  int other = 0;                ///< half wall it is in,
  Face face = Face::side_plus;  ///< and the face that is nearest to it
  double depth = 0;             ///< cell edges, > 0
  bool operator==(const Contact& c) const {
    return plate == c.plate && point == c.point && other == c.other && face == c.face;
  }
};

/// Finds points of half walls inside the boxes of others. The two halves of one wall, plates of one body
/// and plates that touch in the flat state are not looked at. Pairs that are near are kept from call to call
/// until bodies may have come closer by a margin: what is found does not depend on it.
class ContactSearch {
 public:
  ContactSearch(const Linkage& structure, bool planar);

  const ContactPlates& all() const { return all_; }
  /// Two half walls that overlap in the flat state: nothing that could be built.
  const std::optional<WallPair>& overlap_at_rest() const { return overlap_at_rest_; }

  /// Points in contact, in a fixed order. Empty for poses that are not finite.
  const std::vector<Contact>& find(const State& state);

  /// Whether a point went from one side of a half wall to the other, beside it in both states and within half
  /// a cell edge of it before: then it did not go round its end, and the step between the states was too long
  /// for contact to stop it. In space also, whether it came in from above or below and would be pushed out through
  /// a side. @pre both states are finite
  bool passed_through(const State& before, const State& after);
  /// Whether two half walls that do not touch in either state, or only a little, get into each other on the screw motion that
  /// leads from one state to the other: then a step between them passes a contact. @pre both states are finite
  bool sweep_through(const State& before, const State& after);
  /// Whether two half walls lie across each other that did not before, as where walls that stood tip to tip slip past. No
  /// contact lets them: its forces grow up to there. In the plane, their middle lines cross; in space, they are in each other by
  /// half a thickness or more in every direction.  @pre both states are finite
  bool newly_cross(const State& before, const State& after);

 private:
  /// A plate and another one whose box points of it may be in.
  struct PlatePair {
    int plate, other;
    auto operator<=>(const PlatePair&) const = default;
  };
  /// Origin and directions of a plate's box, cell edges.
  struct Box {
    Eigen::Vector3d origin, edge, normal, up;
  };
  /// Of all points of a plate, along another's edge, normal and up, cell edges.
  struct Extent {
    Eigen::Vector3d middle, half;

    /// Whether all are on one side of that plate and go on to be there. @param half_thickness of it, cell edges
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
  /// Where a point is in the state last placed, from another plate's vertex along its edge, its normal and up. cell edges
  Eigen::Vector3d in_box(const Eigen::Vector3d& point, int other) const;
  Eigen::Vector3d in_box(const Contact& contact) const;
  /// A plate as its other one sees it, likewise.
  Box in_box(const PlatePair& pair) const;
  /// @param index of the plate that a box is of
  Eigen::Vector3d point_of(const Box& box, int index, const ContactPoint& point) const;
  Extent extent_of(const Box& box, int index) const;
  /// Of the whole plate, where contact of the plane looks at points of its tip alone.
  Extent whole_extent_of(const Box& box, int index) const;
  /// Whether a point of that extent may be in another's box grown by a margin, cell edges.
  bool may_be_within(const Extent& extent, int other, double margin) const;
  /// Middles of all plates, a column each, cell edges.
  Eigen::Matrix3Xd placed_centers() const;
  /// Plates points of which may be in a box grown by a margin, cell edges, in the state last placed. Sorted.
  std::vector<PlatePair> pairs_within(double margin);
  /// Pairs that may meet between two states, and each pair's plate as its other one sees it in the first one.
  std::vector<PlatePair> pairs_between(const State& before, const State& after, std::vector<Box>& from);
  bool may_touch(int plate, int other) const;
  /// Whether two half walls, cut along their hinges, are in each other by half a thickness in every direction.
  bool are_deep(int plate, int other, const State& state) const;
  /// Plates that lie across each other, each pair once. Sorted.
  std::vector<std::pair<int, int>> crossing(const State& state);
  /// Whether one's middle line, in the plane, goes across the other's or what is beside it.
  bool is_cut(int plate, int other) const;
  /// +1 or -1: on which side of a half wall a point is; 0 where it is not beside it, or inside and
  /// nearer to its end.
  /// @param y here and below, as of in_box()
  int side_of(const Eigen::Vector3d& y, int other) const;
  /// Whether a point is straight above or below a half wall, outside it.
  bool is_over(const Eigen::Vector3d& y, int other) const;
  /// Whether a point is so far inside that contact pushes it out through a side where it has come in from above or below.
  bool is_past_rim(const Eigen::Vector3d& y, int other) const;
  bool is_within(const Eigen::Vector3d& y, int other, double margin) const;
  void add_if_inside(Contact contact);
  /// All points of a plate.
  void add_inside(const PlatePair& pair);
  /// Whether a plate, on the way from one place to another one as the other plate sees it, gets into that one: further than
  /// they are in both places, and further than the motion is known.
  bool sweeps_through(const PlatePair& pair, const Box& before, const Box& after) const;
  /// Whether all of a plate is on one side of the other's box in both places.
  bool stays_off(const PlatePair& pair, const Box& before, const Box& after) const;
  OrientedBox oriented(const Box& box, int index) const;
  /// Of a plate as its other one sees it in two states: what passed_through asks.
  bool went_through(const PlatePair& pair, const Box& before, const Box& after) const;

  ContactPlates all_;
  std::vector<HalfWall> walls_;
  std::vector<std::pair<int, int>> excluded_;  ///< touch at rest; sorted
  std::optional<WallPair> overlap_at_rest_;
  std::vector<Box> placed_boxes_;  ///< in the state last placed
  std::vector<PlatePair> near_;    ///< sorted
  std::vector<int> near_plates_;   ///< those in near_
  RelativeMotion moved_;           ///< since near_ was listed
  std::vector<Contact> found_;
  State found_state_;
  NearPairs finder_;
};

}  // namespace kinetix::model
