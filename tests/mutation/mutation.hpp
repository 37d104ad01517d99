#pragma once

#include <array>
#include <atomic>
#include <cstdlib>

/// Errors that are built in and chosen at run time by a number in the environment variable KINETIX_MUTANT, or none.
/// mutate.py adds calls of these functions to copies of the sources.
namespace kinetix::mutation {

constexpr int most = 1000;  // mutants in one build: several times what mutate.py asks for

inline int chosen_mutant() {
  const char* number = std::getenv("KINETIX_MUTANT");
  return number ? std::atoi(number) : -1;
}

/// The mutant of this process; -1: none.
inline const int chosen = chosen_mutant();

/// Places that were executed, by their numbers.
inline std::array<std::atomic<bool>, most> reached{};

inline bool on(int number) {
  reached[number].store(true, std::memory_order_relaxed);
  return number == chosen;
}

/// Returns 1, or -1 in this mutant.
inline int sign(int number) { return on(number) ? -1 : 1; }

/// Returns the index, or the wrong one in this mutant.
inline int other(int number, int index, int wrong) { return on(number) ? wrong : index; }

/// Returns the index, or the one before it in this mutant. 0 does not change.
template <class Index>
Index before(int number, Index index) {
  return on(number) && index > 0 ? static_cast<Index>(index - 1) : index;
}

}  // namespace kinetix::mutation
