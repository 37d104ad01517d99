#include <pybind11/stl.h>

#include "app/files/file_header.hpp"
#include "app/files/structure_section.hpp"
#include "app/pipeline/pipeline.hpp"
#include "model/base/invalid_input.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/custom_goal.hpp"
#include "python/bindings/documents.hpp"
#include "python/bindings/interruptible.hpp"
#include "python/bindings/results.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

template <class Value>
Value word(const std::string& name, const std::string& given,
           const std::vector<std::pair<std::string_view, Value>>& allowed) {
  std::vector<std::string_view> names;
  for (const auto& [known, value] : allowed) {
    if (known == given) return value;
    names.push_back(known);
  }
  throw InvalidInput(name + " " + targets::in_ticks(given) + " is not known" +
                     targets::did_you_mean(given, names) + "; allowed: " + targets::joined(names));
}

optim::SolverName solver_of(const std::string& name) {
  std::vector<std::string> texts;
  for (const optim::SolverName solver : optim::all_solvers()) texts.push_back(to_string(solver));
  std::vector<std::pair<std::string_view, optim::SolverName>> all;
  for (std::size_t k = 0; k < texts.size(); ++k) all.emplace_back(texts[k], optim::all_solvers()[k]);
  return word("solver", name, all);
}

using Range = std::pair<double, double>;

/// A name as files may give it. @param document a dict with the key
std::string checked_name(const std::string& document) {
  static const targets::KeyTable keys = app::file_keys({});
  return read_dict(document, "own_goal.yaml",
                   [](const targets::Node& root) { return app::read_name(targets::Section(root, keys)); });
}

/// @param wall_mm thickness and height; what is too thick closes the cells, which CustomGoal::fit refuses
model::CellSize walls_of(double cell_mm, const Range& wall_mm) {
  const auto& [thickness, height] = wall_mm;
  require("wall_mm[0]", thickness, thickness > 0 && std::isfinite(thickness), "above 0 mm");
  require("wall_mm[1]", height, height > 0 && height <= 1e4, "above 0 and at most 10000 mm");
  return {cell_mm, thickness, height};
}

/// @param least that it may begin at, rad, and the same in words
optim::AngleRange angles(const std::string& name, const Range& range, double least, const char* describe) {
  const auto& [lower, upper] = range;
  require(name + "[0]", lower, lower > least && lower < upper,
          std::string("above ") + describe + " and below " + name + "[1], rad");
  require(name + "[1]", upper, upper < pi / 2, "below pi/2 rad");
  return {lower, upper};
}

std::shared_ptr<CustomGoal> make_goal(const std::string& named, py::object error, py::object gradient,
                                      double tolerance, int columns, int rows, double cell_mm,
                                      const std::optional<Range>& wall_mm, Range beta, Range theta,
                                      const std::string& per, const std::string& symmetry,
                                      const std::string& solver, int starts, int max_evaluations) {
  using optim::Per, optim::Symmetry;
  require("cell_mm", cell_mm, cell_mm >= 0.001 && cell_mm <= 1e4, "0.001 to 10000 mm");
  auto goal = std::make_shared<CustomGoal>(checked_name(named));
  goal->error = std::make_shared<CustomError>(std::move(error), std::move(gradient));
  goal->size = wall_mm ? walls_of(cell_mm, *wall_mm) : app::default_size(cell_mm);
  const Per tied = word<Per>("per", per, {{"column", Per::column}, {"all", Per::all}});
  const Symmetry kept = word<Symmetry>("symmetry", symmetry,
                                       {{"none", Symmetry::none},
                                        {"mirror_x", Symmetry::mirror_x},
                                        {"mirror_y", Symmetry::mirror_y},
                                        {"rotate_2", Symmetry::rotate_2}});
  goal->starts.starts = starts;
  goal->starts.solver.name = solver_of(solver);
  goal->starts.solver.max_evaluations = max_evaluations;
  require("tolerance", tolerance, tolerance >= 0 && std::isfinite(tolerance), "0 or more, and finite");
  require("columns", columns, columns >= 2 && columns <= 10000, "2 to 10000");
  require("rows", rows, rows >= 1 && rows <= 10000, "1 to 10000");
  goal->tolerance = tolerance;
  const optim::AngleRange turns = angles("theta", theta, 0, "0");
  goal->allowed = {columns, rows, cell_mm, angles("beta", beta, -pi / 2, "-pi/2"), turns, tied, kept};
  goal->fit();
  return goal;
}

/// Largest difference between the gradient given and central differences, at the starts of a search, over the largest
/// derivative.
double gradient_error(const CustomGoal& goal, int starts) {
  if (!goal.error->has_gradient()) throw InvalidInput("the goal has no gradient to compare with differences");
  require("states", starts, starts >= 1, "at least 1");
  const CustomFit fit = goal.fit();
  double largest = 0, off = 0;
  for (int k = 0; k < starts; ++k) {
    Eigen::VectorXd r;
    Eigen::MatrixXd given, differences;
    const Eigen::VectorXd x = fit.start(k + 3, 0);
    const bool known = fit.evaluate(x, r, &given) && fit.differences(x, differences);
    goal.error->throw_again();
    if (!known) throw InvalidInput("the error or its gradient has no finite value at a start of the search");
    largest = std::max(largest, differences.cwiseAbs().maxCoeff());
    off = std::max(off, (given - differences).cwiseAbs().maxCoeff());
  }
  return largest > 0 ? off / largest : off;
}

}  // namespace

void add_custom_goals(py::module_& core) {
  py::class_<CustomGoal, std::shared_ptr<CustomGoal>>(core, "CustomGoal")
      .def_property_readonly("name", [](const CustomGoal& g) { return g.name; })
      .def("gradient_error", gradient_error);
  core.def("make_goal", make_goal);
  core.def("optimise_custom", [](const std::shared_ptr<CustomGoal>& goal, RunChoice choice) {
    return run_in_python([&](const app::RunOptions& options) { return run_goal(*goal, options); }, "",
                         std::move(choice));
  });
}

}  // namespace kinetix::python
