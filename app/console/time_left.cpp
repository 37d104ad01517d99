#include "app/console/time_left.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace kinetix::app {
namespace {

constexpr double min_share_for_estimate = 0.02;  // of a stage: a smaller share is too little for an estimate
constexpr double about_ratio = 1.25, about_s = 1;  // ratio and s by which "about" may be too short

}  // namespace

void TimeLeft::update(double seconds, double done) {
  if (done < 0 || done == done_) return;
  if (began_ < 0) {
    began_ = seconds;
    before_ = done;
  }
  done_ = done;
  if (done - before_ > min_share_for_estimate && done < 1)
    total_ = seconds + (seconds - began_) * (1 - done) / (done - before_);
}

std::optional<double> TimeLeft::at(double seconds) {
  const double left = total_ - seconds;
  if (!is_known() || !(left > 0)) return std::nullopt;
  told_ = std::min(told_, left);
  return left <= about_ratio * told_ + about_s ? std::optional(told_) : std::nullopt;
}

std::string TimeLeft::words(double seconds) {
  if (!is_known() || done_ >= 1) return "";
  const auto left = at(seconds);
  return left ? "about " + duration_text(*left) + " left" : "takes longer than it seemed";
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace kinetix::app
