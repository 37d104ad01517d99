#include "optim/doe/sobol_sequence.hpp"

#include <bit>
#include <boost/random/sobol.hpp>
#include <cassert>

namespace kinetix::optim {
namespace {

constexpr int bits = 64;                // per coordinate, and as many directions per dimension
constexpr int last_bit_of_engine = 62;  // last direction at which the engine can be placed, see below

}  // namespace

// Point n is the xor of the directions of the bits of n's Gray code, so point 2^(k+1) - 1 is direction k
// alone. The engine omits the origin: its point n is our n + 1. It cannot be placed at the last direction; no
// table has 2^63 rows.
SobolSequence::SobolSequence(int dimensions) : dimensions_(dimensions), directions_(bits * dimensions, 0) {
  assert(dimensions >= 1 && dimensions <= most_dimensions);
  boost::random::sobol engine(dimensions);
  for (int k = 0; k <= last_bit_of_engine; ++k) {
    engine.seed((std::uint64_t{2} << k) - 2);
    for (int j = 0; j < dimensions; ++j) directions_[bits * j + k] = engine();
  }
}

std::uint64_t SobolSequence::coordinate(std::uint64_t index, int dimension) const {
  const std::uint64_t* direction = &directions_[bits * dimension];
  std::uint64_t coordinate = 0;
  for (std::uint64_t gray = index ^ index >> 1; gray != 0; gray &= gray - 1)
    coordinate ^= direction[std::countr_zero(gray)];
  return coordinate;
}

}  // namespace kinetix::optim
