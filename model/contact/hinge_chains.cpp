#include "model/contact/hinge_chains.hpp"

#include <algorithm>

namespace kinetix::model {

HingeChain reversed(HingeChain chain) {
  std::reverse(chain.begin(), chain.end());
  for (ChainStep& step : chain) step.sense = -step.sense;
  return chain;
}

HingeChains::HingeChains(const Linkage& linkage)
    : ways_(linkage.bodies.size()), link_of_(linkage.bodies.size()), round_of_(linkage.bodies.size()) {
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const auto& [lower, upper] = std::pair(linkage.hinges[h].lower, linkage.hinges[h].upper);
    ways_[lower].push_back({upper, {h, 1}});
    ways_[upper].push_back({lower, {h, -1}});
  }
}

void HingeChains::start(int from) {
  ++round_;
  found_.clear();
  round_of_[from] = round_;
  link_of_[from] = -1;
}

const std::vector<HingeChain>& HingeChains::find(int from, const std::vector<int>& to) {
  start(from);
  std::size_t known = 0;
  const auto is_done = [&] {
    while (known < to.size() && is_met(to[known])) ++known;
    return known == to.size();
  };
  int body = from;
  for (std::size_t next = 0; !is_done(); body = found_[next++].body) {
    for (const Way& way : ways_[body]) {
      if (is_met(way.to)) continue;
      round_of_[way.to] = round_;
      link_of_[way.to] = static_cast<int>(found_.size());
      found_.push_back({way.to, body, way.step});
    }
    if (next >= found_.size()) break;
  }
  chains_.clear();
  for (const int b : to) chains_.push_back(is_met(b) ? chain_to(b, from) : HingeChain{});
  return chains_;
}

HingeChain HingeChains::chain_to(int body, int from) const {
  HingeChain chain;
  while (body != from) {
    const Link& link = found_[link_of_[body]];
    chain.push_back(link.step);
    body = link.parent;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

std::vector<HingeChains::Link> HingeChains::tree(int root) {
  std::vector<int> all(ways_.size());
  for (std::size_t b = 0; b < all.size(); ++b) all[b] = static_cast<int>(b);
  find(root, all);
  return found_;
}

}  // namespace kinetix::model
