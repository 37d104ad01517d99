#pragma once

#include <cstdint>
#include <vector>

namespace kinetix::optim {

/// Sobol's sequence with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2635, 2008), in the
/// order of Antonov and Saleev, from its first point, the origin, on. Any power of two of points from a
/// multiple of that power on fills every dimension evenly; the count of samples should be one.
class SobolSequence {
 public:
  static constexpr int most_dimensions = 3667;  ///< for as many, Boost has direction numbers

  /// @param dimensions 1 to most_dimensions
  explicit SobolSequence(int dimensions);

  int dimensions() const { return dimensions_; }

  /// Coordinate of point `index`, as a fraction of 2^64. To be moved by xor of the same random bits in every
  /// point (a digital shift, which leaves the evenness as it is and takes the origin away from the rim).
  std::uint64_t coordinate(std::uint64_t index, int dimension) const;

 private:
  int dimensions_;
  std::vector<std::uint64_t> directions_;  ///< bit by bit, the 64 of dimension 0 first
};

}  // namespace kinetix::optim
