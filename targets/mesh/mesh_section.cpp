#include "targets/mesh/mesh_section.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// Distance, mm, within which successive points are the same: a vertex on the plane that several edges meet. It is
/// above the rounding of coordinates up to a metre and far below any edge.
constexpr double same_point = 1e-9;

/// The points where edges cross the plane, and the pairs of them that a triangle connects.
class Crossings {
 public:
  Crossings(const TriangleMesh& mesh, const Plane& plane) : mesh_(mesh) {
    height_.reserve(mesh.vertices.size());
    for (const Vector3d& p : mesh.vertices) height_.push_back(plane.signedDistance(p));
    for (const Triangle& triangle : mesh.triangles) add(triangle);
    std::sort(links_.begin(), links_.end());
    links_.erase(std::unique(links_.begin(), links_.end()), links_.end());
  }

  const std::vector<Vector3d>& points() const { return points_; }
  const std::vector<std::pair<int, int>>& links() const { return links_; }

 private:
  bool is_above(int vertex) const { return height_[vertex] >= 0; }

  void add(const Triangle& triangle) {
    int ends[2], count = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3];
      if (is_above(a) != is_above(b)) ends[count++] = crossing(std::min(a, b), std::max(a, b));
    }
    if (count == 2 && ends[0] != ends[1]) links_.emplace_back(std::minmax(ends[0], ends[1]));
  }

  int crossing(int a, int b) {
    const auto key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    const auto [it, is_new] = number_.try_emplace(key, static_cast<int>(points_.size()));
    if (is_new) {
      const double f = height_[a] / (height_[a] - height_[b]);
      points_.push_back((1 - f) * mesh_.vertices[a] + f * mesh_.vertices[b]);
    }
    return it->second;
  }

  const TriangleMesh& mesh_;
  std::vector<double> height_;
  std::vector<Vector3d> points_;
  std::vector<std::pair<int, int>> links_;
  std::unordered_map<std::uint64_t, int> number_;
};

class ChainWalker {
 public:
  explicit ChainWalker(const Crossings& crossings)
      : crossings_(crossings), at_(crossings.points().size()), used_(crossings.links().size()) {
    for (std::size_t link = 0; link < crossings.links().size(); ++link) {
      at_[crossings.links()[link].first].push_back(static_cast<int>(link));
      at_[crossings.links()[link].second].push_back(static_cast<int>(link));
    }
  }

  std::vector<SectionChain> walk() {
    for (int point = 0; point < static_cast<int>(at_.size()); ++point)
      if (at_[point].size() != 2) walk_from(point);
    for (int point = 0; point < static_cast<int>(at_.size()); ++point) walk_from(point);
    return std::move(chains_);
  }

 private:
  void walk_from(int start) {
    for (auto link = unused_link(start); link; link = unused_link(start)) {
      std::vector<int> numbers = {start};
      for (; link; link = numbers.back() == start || is_end(numbers.back()) ? std::nullopt
                                                                            : unused_link(numbers.back())) {
        used_[*link] = true;
        const auto [a, b] = crossings_.links()[*link];
        numbers.push_back(a == numbers.back() ? b : a);
      }
      add_chain(numbers);
    }
  }

  bool is_end(int point) const { return at_[point].size() != 2; }

  std::optional<int> unused_link(int point) const {
    const auto it =
        std::find_if(at_[point].begin(), at_[point].end(), [&](int link) { return !used_[link]; });
    return it == at_[point].end() ? std::nullopt : std::optional(*it);
  }

  void add_chain(const std::vector<int>& numbers) {
    SectionChain chain;
    chain.is_closed = numbers.front() == numbers.back();
    for (const int number : numbers) add_point(crossings_.points()[number], chain);
    const auto repeats_first = [&] {
      return (chain.points.back() - chain.points.front()).norm() <= same_point;
    };
    while (chain.is_closed && chain.points.size() > 1 && repeats_first()) chain.points.pop_back();
    if (chain.points.size() > 1) chains_.push_back(std::move(chain));
  }

  static void add_point(const Vector3d& p, SectionChain& chain) {
    if (chain.points.empty() || (p - chain.points.back()).norm() > same_point) chain.points.push_back(p);
  }

  const Crossings& crossings_;
  std::vector<std::vector<int>> at_;  // links at each point
  std::vector<bool> used_;
  std::vector<SectionChain> chains_;
};

}  // namespace

std::vector<SectionChain> section(const TriangleMesh& mesh, const Plane& plane) {
  const Crossings crossings(mesh, plane);
  return ChainWalker(crossings).walk();
}

}  // namespace kinetix::targets
