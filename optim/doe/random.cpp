#include "optim/doe/random.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

namespace kinetix::optim {
namespace {

constexpr int fewest_half_bits = 3;  // bits: halves of one or two mix too little; 64 places are fast to walk

struct Product {
  std::uint32_t high, low;
};

Product multiply(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t product = std::uint64_t{a} * b;
  return {static_cast<std::uint32_t>(product >> 32), static_cast<std::uint32_t>(product)};
}

std::uint32_t low_word(std::uint64_t bits) { return static_cast<std::uint32_t>(bits); }
std::uint32_t high_word(std::uint64_t bits) { return static_cast<std::uint32_t>(bits >> 32); }

/// The finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014, variant 13 of Stafford).
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> x, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const Product a = multiply(0xd2511f53u, x[0]), b = multiply(0xcd9e8d57u, x[2]);
    x = {b.high ^ x[1] ^ key[0], b.low, a.high ^ x[3] ^ key[1], a.low};
    key[0] += 0x9e3779b9u;
    key[1] += 0xbb67ae85u;
  }
  return x;
}

std::uint64_t random_bits(std::uint64_t seed, RandomStream stream, std::uint64_t sample,
                          std::uint32_t factor) {
  const auto words = philox({low_word(sample), high_word(sample), factor, static_cast<std::uint32_t>(stream)},
                            {low_word(seed), high_word(seed)});
  return std::uint64_t{words[1]} << 32 | words[0];
}

double unit_interval(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

RandomOrder::RandomOrder(std::uint64_t n, std::uint64_t key)
    : n_(n), half_bits_(std::max(fewest_half_bits, (static_cast<int>(std::bit_width(n - 1)) + 1) / 2)) {
  assert(n >= 1 && n <= std::uint64_t{1} << 62);
  mask_ = (std::uint64_t{1} << half_bits_) - 1;
  for (std::uint64_t& round : keys_) round = mixed(key += 0x9e3779b97f4a7c15u);
}

std::uint64_t RandomOrder::pass(std::uint64_t i) const {
  std::uint64_t left = i >> half_bits_, right = i & mask_;
  for (const std::uint64_t key : keys_) {
    const std::uint64_t next = left ^ (mixed(right ^ key) & mask_);
    left = right;
    right = next;
  }
  return left << half_bits_ | right;
}

std::uint64_t RandomOrder::operator()(std::uint64_t i) const {
  assert(i < n_);
  do i = pass(i);
  while (i >= n_);
  return i;
}

}  // namespace kinetix::optim
