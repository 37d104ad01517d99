#include "model/elastic/path/step_length.hpp"

#include <algorithm>
#include <cmath>

namespace kinetix::model {
namespace {

constexpr double most_growth = 2;      // times the last step: one small error is not enough for more
constexpr double least_growth = 0.25;  // times the last step: a large error does not tell how much less
constexpr double aimed_jump = 0.4;    // ratio to longest_jump: near 1 more steps fail, near 0 more are needed
constexpr double least_jump = 1e-12;  // rad: below is rounding, and most_growth is reached long before
constexpr double rounding = 1e-9;     // fraction of a step or of the remaining path: less is rounding

}  // namespace

StepLength::StepLength(const EquilibriumPathOptions& options, double goal)
    : options_(options), goal_(goal), step_(options.first_step) {}

NextStep StepLength::next(double from) const {
  const double left = std::abs(goal_ - from);
  return to(step_ >= left * (1 - rounding) ? goal_ : from + std::copysign(step_, goal_), from);
}

NextStep StepLength::next_beyond(double from) const { return to(from + std::copysign(step_, goal_), from); }

NextStep StepLength::landing(double from, double length) const {
  const double left = std::abs(goal_ - from);
  NextStep step = to(length >= left ? goal_ : from + std::copysign(length, goal_), from);
  step.is_short = step.leaves = true;
  step.is_shortest = length <= options_.least_step;
  return step;
}

NextStep StepLength::to(double theta, double from) const {
  NextStep next;
  next.theta = theta;
  next.length = std::abs(theta - from);
  next.to_goal = theta == goal_;
  next.is_shortest = step_ <= options_.least_step || step_ < rounding * std::abs(goal_ - from);
  next.is_short = next.is_shortest || next.length <= options_.longest_step_touching * (1 + rounding);
  return next;
}

double StepLength::growth(double jump, int order) const {
  if (!std::isfinite(jump)) return least_growth;
  const double room = aimed_jump * options_.longest_jump / std::max(jump, least_jump);
  return std::clamp(std::pow(room, 1.0 / (order + 1)), least_growth, most_growth);
}

void StepLength::change(double growth, bool touching) {
  const double longest =
      touching ? std::min(options_.longest_step, options_.longest_step_touching) : options_.longest_step;
  step_ = std::clamp(step_ * growth, options_.least_step, longest);
}

void StepLength::shorten(const NextStep& refused, double growth) {
  step_ = std::max(refused.length * std::min(0.5, growth), options_.least_step);
}

}  // namespace kinetix::model
