#include "app/run_target.hpp"

#include "app/run_display.hpp"
#include "app/run_fold.hpp"
#include "app/run_helmet.hpp"

namespace kinetix {

Run run_target(const Target& target, const RunOptions& options) {
  if (const auto* display = std::get_if<DisplayFile>(&target)) return run_display(*display, options);
  if (const auto* fold = std::get_if<FoldFile>(&target)) return run_fold(*fold, options);
  if (const auto* helmet = std::get_if<HelmetFile>(&target)) return run_helmet(*helmet, options);
  return run_curve(std::get<TargetFile>(target), options);
}

std::vector<std::string> misses_of(const Run& run) {
  if (run.curve && !run.curve->met) return run.curve->why_missed;
  if (run.display && !run.display->met()) return run.display->why_missed;
  if (run.fold && !run.fold->met()) return run.fold->why_missed;
  if (run.helmet && !run.helmet->met()) return run.helmet->why_missed;
  return {};
}

}  // namespace kinetix
