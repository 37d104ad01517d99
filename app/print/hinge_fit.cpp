#include "app/print/hinge_fit.hpp"

#include "app/exports/design_export.hpp"
#include "app/print/fit.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {

PrintAnswer answer_of_export(const Run& run) {
  try {
    return answer_as_fits(written_design(run), run.process);
  } catch (const InvalidInput& e) {
    return {false, {}, e.reason()};
  }
}

}  // namespace kinetix::app
