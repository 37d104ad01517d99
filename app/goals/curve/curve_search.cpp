#include "app/goals/curve/curve_search.hpp"

#include <fmt/format.h>

#include "app/run/search_words.hpp"

namespace kinetix::app {

optim::CurveVariables curve_variables(const CurveFile& file) {
  optim::CurveVariables v;
  v.columns = file.columns;
  v.rows = file.rows;
  v.cell_mm = file.size.edge_mm;
  v.beta = file.beta;
  v.theta = file.theta;
  v.per = file.per;
  v.symmetry = file.symmetry;
  return v;
}

optim::MultiStartOptions curve_search(const CurveFile& file, const RunOptions& options) {
  optim::MultiStartOptions search;
  search.starts = file.solver.starts.value_or(search.starts);
  search.solver.name = file.solver.name.value_or(search.solver.name);
  search.solver.max_evaluations = file.solver.max_evaluations.value_or(search.solver.max_evaluations);
  return followed(search, options, [mm = file.curve.diagonal()](double least) {
    return fmt::format("best {:.2g} mm off", least * mm);
  });
}

}  // namespace kinetix::app
