#pragma once

#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// A hinge on the path from one body to another.
struct ChainStep {
  int hinge = 0;
  int sense = 1;  ///< 1 from the lower body to the upper one, -1 in reverse
};
using HingeChain = std::vector<ChainStep>;

/// Returns the chain in the opposite direction.
HingeChain reversed(HingeChain chain);

/// Paths through a linkage with the fewest hinges.
class HingeChains {
 public:
  explicit HingeChains(const Linkage& linkage);

  /// Finds the chains from one body to each of the others. The search ends at the last of them.
  /// @return chains in the order of `to`; empty if no hinges lead to a body
  const std::vector<HingeChain>& find(int from, const std::vector<int>& to);

  /// Every other body that hinges lead to, each after its parent.
  struct Link {
    int body = 0, parent = 0;
    ChainStep step;
  };
  std::vector<Link> tree(int root);

 private:
  struct Way {
    int to = 0;
    ChainStep step;
  };
  void start(int from);
  bool is_met(int body) const { return round_of_[body] == round_; }
  HingeChain chain_to(int body, int from) const;

  std::vector<std::vector<Way>> ways_;  ///< neighbours of each body
  std::vector<Link> found_;             ///< in the order of the search
  std::vector<int> link_of_;            ///< index in found_ of each body; -1 of the first
  std::vector<int> round_of_;           ///< round in which each body was last reached
  int round_ = 0;
  std::vector<HingeChain> chains_;
};

}  // namespace kinetix::model
