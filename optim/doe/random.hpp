#pragma once

#include <array>
#include <cstdint>

namespace kinetix::optim {

/// The block function Philox4x32-10: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2,
/// 3", SC 2011. Random numbers by counter: no state, so that number i is the same in any order and on any
/// thread.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// What random numbers are drawn for; numbers of two streams have nothing to do with each other.
enum class RandomStream : std::uint32_t {
  monte_carlo,
  stratum_order,
  stratum_place,
  digital_shift,
  trajectory_start,
  trajectory_order,
  bootstrap
};

/// 64 random bits that depend on the arguments alone.
std::uint64_t random_bits(std::uint64_t seed, RandomStream stream, std::uint64_t sample,
                          std::uint32_t factor);

/// The middle of the bits' place on a grid of 2^52: inside (0, 1), never 0 or 1, symmetric about 0.5.
double unit_interval(std::uint64_t bits);

/// A random order of 0 ... n-1 that is evaluated one place at a time, in memory that does not grow with n: a
/// Feistel network on the next even number of bits, walked along its cycle until it falls below n (Black,
/// Rogaway, "Ciphers with arbitrary finite domains", CT-RSA 2002). Takes at most 4 rounds of it on average
/// for n above 16, 32 for n = 2.
class RandomOrder {
 public:
  /// @param n 1 to 2^62   @param key the order; any bits
  RandomOrder(std::uint64_t n, std::uint64_t key);

  /// @param i below n. @return what stands at place i, below n; every number once
  std::uint64_t operator()(std::uint64_t i) const;

 private:
  std::uint64_t pass(std::uint64_t i) const;

  std::uint64_t n_, mask_;
  int half_bits_;
  std::array<std::uint64_t, 6> keys_;
};

}  // namespace kinetix::optim
