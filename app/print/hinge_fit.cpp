#include "app/print/hinge_fit.hpp"

#include "app/exports/design_export.hpp"
#include "app/print/fit.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {

std::optional<std::string> why_hinges_do_not_fit(const Run& run) {
  if (!run.plan.exact) return std::nullopt;
  const DesignFile design = written_design(run);
  const bool are_open = leaves_hinges_open(design);
  if (are_open && run.hinge.model == HingeSection::Model::elastic) return std::nullopt;
  const std::string who = are_open ? "hinges, left open, do not fit as blocks: " : "its hinges do not fit: ";
  try {
    const auto why = why_unprepared(design, run.process, {.kind = model::HingeKind::block});
    return why ? std::optional(who + *why) : std::nullopt;
  } catch (const InvalidInput& e) {
    return who + e.reason();
  }
}

}  // namespace kinetix::app
