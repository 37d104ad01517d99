#include "app/result/effort.hpp"

#include <cmath>

namespace kinetix::app {
namespace {

struct Limit {
  double most;
  const char* words;
};

// N: two fingers pinch with 40 to 100, a hand grips with 200 to 500, body weight on two arms gives 300 and more.
constexpr Limit forces[] = {{20, "fingers"}, {100, "a hand"}, {300, "both arms"}};
// N mm: fingers turn a knob with 500 to 1500, a hand opens a jar with 4000 to 6000.
constexpr Limit moments[] = {{500, "fingers"}, {3000, "a hand"}, {10000, "both arms"}};

template <std::size_t N>
std::string words(const Limit (&limits)[N], double value) {
  for (const Limit& limit : limits)
    if (std::abs(value) <= limit.most) return limit.words;
  return "a vice";
}

}  // namespace

std::string effort_of_force(double newtons) { return words(forces, newtons); }

std::string effort_of_moment(double newton_mm) { return words(moments, newton_mm); }

std::string effort_of(const Equilibrium& equilibrium) {
  if (!equilibrium.drive.acts_from_outside()) return "its own springs";
  const double load = largest_load(equilibrium.path);
  return equilibrium.drive.has_force() ? effort_of_force(load) : effort_of_moment(load);
}

std::string effort_of(const AssumedHinges& taken) {
  return taken.is_force ? effort_of_force(*taken.load) : effort_of_moment(*taken.load);
}

}  // namespace kinetix::app
