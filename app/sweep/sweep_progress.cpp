#include "app/sweep/sweep_progress.hpp"

#include <fmt/format.h>

namespace kinetix::app {
namespace {

constexpr double between_shows_s = 0.2;  // s: looks continuous, and drawing costs next to nothing

}  // namespace

SweepProgress::SweepProgress(Console& console, std::int64_t total, std::int64_t before)
    : console_(console), total_(total), before_(before) {
  console_.stage("sweep", static_cast<double>(before) / static_cast<double>(total));
}

void SweepProgress::show(std::int64_t count) {
  seconds_ += since_shown_.lap();
  if (seconds_ < next_ || count == before_) return;
  next_ = seconds_ + between_shows_s;
  const double rate = static_cast<double>(count - before_) / seconds_;
  const double left = static_cast<double>(total_ - count) / rate;
  console_.stage("sweep", static_cast<double>(count) / static_cast<double>(total_),
                 fmt::format("{} of {}, {:.3g} a second, {} left", count, total_, rate, duration_text(left)));
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace kinetix::app
