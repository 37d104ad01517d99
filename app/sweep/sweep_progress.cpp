#include "app/sweep/sweep_progress.hpp"

#include <fmt/format.h>

#include <string>

namespace kinetix::app {
namespace {

constexpr double between_shows_s = 0.2;  // s: looks continuous, and drawing costs next to nothing

}  // namespace

SweepProgress::SweepProgress(Console& console, std::int64_t total, std::int64_t before)
    : console_(console), total_(total), before_(before) {
  console_.stage("sweep", static_cast<double>(before) / static_cast<double>(total));
  left_.update(0, static_cast<double>(before) / static_cast<double>(total));
}

void SweepProgress::show(std::int64_t count) {
  seconds_ += since_shown_.lap();
  if (seconds_ < next_ || count == before_) return;
  next_ = seconds_ + between_shows_s;
  const double rate = static_cast<double>(count - before_) / seconds_;
  const double done = static_cast<double>(count) / static_cast<double>(total_);
  left_.update(seconds_, done);
  const std::string left = left_.words(seconds_);
  console_.stage(
      "sweep", done,
      fmt::format("{} of {}, {:.3g} a second{}{}", count, total_, rate, left.empty() ? "" : ", ", left));
}

}  // namespace kinetix::app
