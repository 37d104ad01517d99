#pragma once

#include <array>
#include <cstdint>

namespace kinetix::optim {

/// Block function Philox4x32-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3",
/// SC 2011). It numbers its values by a counter without state, so number i is the same in any order and on
/// any thread.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// Purpose of random numbers; numbers of two streams are independent.
enum class RandomStream : std::uint32_t {
  monte_carlo,
  stratum_order,
  stratum_place,
  digital_shift,
  trajectory_start,
  trajectory_order,
  bootstrap
};

/// Returns 64 random bits that depend on the arguments alone.
std::uint64_t random_bits(std::uint64_t seed, RandomStream stream, std::uint64_t sample,
                          std::uint32_t factor);

/// Returns the middle of the bits' interval on a grid of 2^52: inside (0, 1), never 0 or 1, symmetric about
/// 0.5.
double unit_interval(std::uint64_t bits);

/// Random order of 0 ... n-1, evaluated one place at a time in memory that does not grow with n. It is a
/// Feistel network on the next even number of bits, walked along its cycle until the value is below n (Black,
/// Rogaway, "Ciphers with arbitrary finite domains", CT-RSA 2002). It takes at most 4 passes on average for n
/// above 16, and 32 for n = 2.
class RandomOrder {
 public:
  /// @param n 1 to 2^62   @param key selects the order; any bits
  RandomOrder(std::uint64_t n, std::uint64_t key);

  /// @param i below n   @return the number at place i, below n; each number occurs once
  std::uint64_t operator()(std::uint64_t i) const;

 private:
  std::uint64_t pass(std::uint64_t i) const;

  std::uint64_t n_, mask_;
  int half_bits_;
  std::array<std::uint64_t, 6> keys_;
};

}  // namespace kinetix::optim
