#pragma once

#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// A hinge on the way from one body to another.
struct ChainStep {
  int hinge = 0;
  int sense = 1;  ///< 1 from the lower body to the upper one, -1 back
};
using HingeChain = std::vector<ChainStep>;

/// The other way round.
HingeChain reversed(HingeChain chain);

/// Ways through a linkage by as few hinges as can be.
class HingeChains {
 public:
  explicit HingeChains(const Linkage& linkage);

  /// From a body to each of others. Looks no further than the last of them.
  /// @return in their order; empty where no hinges lead there
  const std::vector<HingeChain>& find(int from, const std::vector<int>& to);

  /// Every other body that hinges lead to, each after the one it is reached from.
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

  std::vector<std::vector<Way>> ways_;  ///< of each body
  std::vector<Link> found_;             ///< in the order in which they were reached
  std::vector<int> link_of_;            ///< of each body, index in found_; -1 of the first
  std::vector<int> round_of_;           ///< of each body, in which it was last reached
  int round_ = 0;
  std::vector<HingeChain> chains_;
};

}  // namespace kinetix::model
