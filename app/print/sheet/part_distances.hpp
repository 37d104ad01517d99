#pragma once

#include "app/print/sheet/fold_motion.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "model/contact/swept_motion.hpp"

namespace kinetix::app {

/// Replaces the known distance if the other one has less spare.
void update_least(const LeastDistance& other, LeastDistance& known);
/// Replaces the known distance if the other one is smaller.
void update_nearest(const LeastDistance& other, LeastDistance& known);

/// Two pieces that are not proven apart, with the direction between their nearest points.
struct PiecePair {
  int first = 0, second = 0;
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  // as the first body of the parts sees it; 0: none is known
};

/// Two parts that may come too near.
struct PartPair {
  int first = 0, second = 0;
  bool is_hinged = false;
  double required_mm = 0;
  std::vector<int> bodies = {};                // bodies of both parts: the first sees the others
  std::vector<model::HingeChain> chains = {};  // of hinges, to each of the others
  std::vector<PiecePair> open = {};
};

/// Distances that parts must keep.
class PairRules {
 public:
  PairRules(const PrintSheet& sheet, ClearanceSearch search);

  /// Returns a pair with its required distance; empty for two parts that belong together, or that
  /// the search leaves out.
  std::optional<PartPair> pair(int a, int b) const;
  double max_required() const { return max_required_; }
  /// Returns the bodies that a part moves with.
  std::vector<int> bodies_of(int part) const;

 private:
  /// Checks whether a body is one of the two that a soft part joins.
  bool is_joined_by(int soft, int body) const;
  double required_elsewhere(int a, int b) const;

  const PrintSheet& sheet_;
  const bool has_posts_only_;  // only pairs with a body that has a post count
  const int bodies_;
  double max_required_ = 0;       // mm
  std::vector<double> required_;  // of each body, the least clearance of its pins, mm.
  // Bodies after each body that share a hinge with it, and the clearance, mm: 0 for soft parts.
  std::vector<std::vector<std::pair<int, double>>> hinged_;
};

/// Distances of a sheet's parts in single states.
class Distances {
 public:
  Distances(const PrintSheet& sheet, ClearanceSearch search)
      : parts(sheet), rules(sheet, search), sheet_(sheet), search_(search) {}

  PathClearance measured(double theta, const model::State& state) const;
  /// Compares rods with bores at both ends of the eye. Both are cylinders, with axes apart by the joint separation.
  void compare_bores(double theta, const model::State& state, PathClearance& least) const;

  const MovingParts parts;
  const PairRules rules;

 private:
  void compare_bore(std::size_t h, double theta, const model::State& state, PathClearance& least) const;

  const PrintSheet& sheet_;
  const ClearanceSearch search_;
};

}  // namespace kinetix::app
