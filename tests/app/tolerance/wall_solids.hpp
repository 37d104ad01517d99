#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::testing {

/// Half walls as closed meshes with slanted ends at their hinges. FCL compares these meshes.
class WallSolids {
 public:
  using Pairs = std::set<std::pair<int, int>>;

  explicit WallSolids(const model::Linkage& linkage) {
    const double edge = linkage.size.edge_mm, high = linkage.size.height_mm / 2,
                 thick = linkage.size.thickness_mm / 2;
    for (const model::Plate& plate : linkage.plates) {
      std::vector<Eigen::Vector3d> corners;
      for (const double across : {-thick, thick})
        for (const double up : {-high, high})
          for (const double along : {0.0, plate.length * edge + plate.slant * up})
            corners.push_back(along * plate.edge + up * plate.up + across * plate.edge.cross(plate.up));
      double reach = 0;
      for (const Eigen::Vector3d& corner : corners) reach = std::max(reach, corner.norm());
      walls_.push_back({plate.body, plate.hinge, reach, mesh(corners)});
    }
  }

  /// Finds pairs that touch, except those of one body, of one hinge and in `left_out`.
  /// @param most number of pairs after which the search ends
  Pairs touching(const model::State& state, const Pairs& left_out, std::size_t most = SIZE_MAX) const {
    Pairs out;
    for (int a = 0; a < static_cast<int>(walls_.size()); ++a)
      for (int b = a + 1; b < static_cast<int>(walls_.size()) && out.size() < most; ++b)
        if (!left_out.contains({a, b}) && touch(walls_[a], walls_[b], state)) out.insert({a, b});
    return out;
  }

 private:
  using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

  struct Wall {
    int body = 0, hinge = 0;
    double reach = 0;  ///< largest distance from the body's position, mm
    std::shared_ptr<Mesh> mesh;
  };

  static std::shared_ptr<Mesh> mesh(const std::vector<Eigen::Vector3d>& corners) {
    // The corners are counted along, up and across the wall.
    constexpr int faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    std::vector<fcl::Triangle> triangles;
    for (const auto& f : faces) {
      triangles.emplace_back(f[0], f[1], f[2]);
      triangles.emplace_back(f[0], f[2], f[3]);
    }
    auto out = std::make_shared<Mesh>();
    out->beginModel();
    out->addSubModel(corners, triangles);
    out->endModel();
    return out;
  }

  static fcl::Transform3d placed(const model::Pose& pose) {
    fcl::Transform3d out = fcl::Transform3d::Identity();
    out.linear() = pose.R;
    out.translation() = pose.p;
    return out;
  }

  static bool touch(const Wall& a, const Wall& b, const model::State& state) {
    if (a.body == b.body || a.hinge == b.hinge) return false;
    const model::Pose &at_a = state[a.body], &at_b = state[b.body];
    if ((at_a.p - at_b.p).norm() > a.reach + b.reach) return false;
    fcl::CollisionResultd result;
    return fcl::collide(a.mesh.get(), placed(at_a), b.mesh.get(), placed(at_b), fcl::CollisionRequestd(),
                        result) > 0;
  }

  std::vector<Wall> walls_;
};

}  // namespace kinetix::testing
