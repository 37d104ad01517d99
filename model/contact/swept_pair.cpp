#include "model/contact/swept_pair.hpp"

#include "model/contact/swept_boxes.hpp"

namespace kinetix::model {

SweptPair::SweptPair(const LinkagePlates& plates, const ThetaInterval& interval, const PlatesOfPair& pair,
                     double margin_mm)
    : plates_(plates),
      interval_(interval),
      pair_(pair),
      margin_mm_(margin_mm),
      second_(interval.relative(pair.first, pair.second)),
      there_(interval.motion(pair.first, pair.chain)) {}

bool SweptPair::is_apart() const {
  const double reach = plates_.reach[pair_.first] + plates_.reach[pair_.second];
  return second_.p.norm() - reach - there_.way(second_.p, plates_.reach[pair_.second]) > margin_mm_;
}

bool SweptPair::is_apart(const WallPair& walls) {
  const bool in_order = plates_.walls[walls.first].body == pair_.first;
  const OrientedBox& own = plates_.walls[in_order ? walls.first : walls.second].box;
  const HalfWall& other = plates_.walls[in_order ? walls.second : walls.first];
  const Eigen::Vector3d center = second_.p + second_.R * other.box.center;
  const double around = radius(other.box);
  if ((center - own.center).norm() - radius(own) - around - there_.way(center, around) > margin_mm_)
    return true;
  const OrientedBox moving = placed(other, second_);
  const SweptBoxes forth{own, moving, there_, interval_.half_width(), margin_mm_};
  return stay_apart_by_faces(forth) || is_apart_from_there(own, other.box) || stay_apart_by_edges(forth);
}

bool SweptPair::is_apart_from_there(const OrientedBox& own, const OrientedBox& other) {
  if (!back_) back_ = interval_.motion(pair_.second, reversed(pair_.chain));
  const Pose first = interval_.relative(pair_.second, pair_.first);
  const OrientedBox moving{first.p + first.R * own.center, first.R * own.axes, own.half, own.slant};
  return stay_apart_by_faces({other, moving, *back_, interval_.half_width(), margin_mm_});
}

}  // namespace kinetix::model
