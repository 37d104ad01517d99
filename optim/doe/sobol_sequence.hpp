#pragma once

#include <cstdint>
#include <vector>

namespace kinetix::optim {

/// Sobol's sequence with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2635, 2008), in the
/// order of Antonov and Saleev. It starts with the origin. A power of two of points that starts at a multiple
/// of that power fills every dimension evenly, so the sample count should be a power of two.
class SobolSequence {
 public:
  static constexpr int most_dimensions = 3667;  ///< Boost has direction numbers for this many

  /// @param dimensions 1 to most_dimensions
  explicit SobolSequence(int dimensions);

  int dimensions() const { return dimensions_; }

  /// Returns the coordinate of point `index`, as a fraction of 2^64. A digital shift is the xor of all points
  /// with the same random bits. It keeps the evenness and moves the origin away from the boundary.
  std::uint64_t coordinate(std::uint64_t index, int dimension) const;

 private:
  int dimensions_;
  std::vector<std::uint64_t> directions_;  ///< bit by bit, the 64 of dimension 0 first
};

}  // namespace kinetix::optim
