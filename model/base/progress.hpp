#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <utility>

namespace kinetix {

/// Receiver of progress reports of a long task. A report has the stage, its completed share from 0 to 1
/// (negative: unknown), and a text with the results so far. Calls may come from any thread. Without a
/// function, reports are dropped.
class Progress {
 public:
  using ProgressCallback =
      std::function<void(const std::string& stage, double done, const std::string& so_far)>;

  Progress() = default;
  template <std::convertible_to<ProgressCallback> Function>
  requires(!std::same_as<Function, Progress>) Progress(Function callback)
      : callback_(std::move(callback)) {}  // NOLINT: lambdas are given as they are

  void operator()(const std::string& stage, double done, const std::string& so_far = {}) const {
    if (callback_) callback_(stage, done, so_far);
  }

 private:
  ProgressCallback callback_;
};

}  // namespace kinetix
