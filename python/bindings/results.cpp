#include "python/bindings/results.hpp"

#include <pybind11/stl.h>

#include "app/exports/exporters.hpp"
#include "app/result/result_json.hpp"
#include "app/result/summary.hpp"
#include "app/result/verdict.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/sensitivities.hpp"
#include "python/bindings/states.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

using SharedRun = std::shared_ptr<app::Run>;

/// Returns the only file of an exporter that writes one for every run.
std::string content_of(const app::Exporter& exporter, const app::Run& run) {
  return exporter.write(run, result_json(run)).front().content;
}

/// Whether the drive in elastic hinges reached its goal; empty without an equilibrium.
std::optional<bool> reached(const app::Run& run) {
  return run.equilibrium ? std::optional(run.equilibrium->reached()) : std::nullopt;
}

/// Returns one number per step of the equilibrium path.
template <class Number>
py::array of_path(const app::Run& run, Number number) {
  std::vector<double> out;
  for (const model::EquilibriumStep& step : run.equilibrium->path.steps) out.push_back(number(step));
  const auto count = static_cast<py::ssize_t>(out.size());
  return array_of(std::move(out), {count});
}

py::object path_of(const app::Run& run) {
  if (!run.equilibrium) return py::none();
  using Step = model::EquilibriumStep;
  py::dict out;
  out["theta"] = of_path(run, [](const Step& s) { return s.theta; });
  out["drive"] = of_path(run, [](const Step& s) { return s.drive; });
  out["load"] = of_path(run, [](const Step& s) { return s.load; });
  out["energy"] = of_path(run, [](const Step& s) { return s.energy; });
  out["gap"] = of_path(run, [](const Step& s) { return s.gap; });
  out["contacts"] = of_path(run, [](const Step& s) { return s.contacts; });
  out["stable"] = of_path(run, [](const Step& s) { return s.stable; });
  return out;
}

void write(const app::Run& run, const std::string& where) {
  app::OutputFolder folder(where);
  write_results(run, folder.path());
  folder.keep();
}

}  // namespace

void add_results(py::module_& core) {
  py::class_<app::Run, SharedRun>(core, "Run")
      .def_property_readonly("name", [](const app::Run& r) { return r.design.name; })
      .def_property_readonly("theta", [](const app::Run& r) { return r.theta; })
      .def_property_readonly("exit_code",
                             [](const app::Run& r) { return static_cast<int>(exit_code(verdict_of(r))); })
      .def("verdict", [](const app::Run& r) { return verdict_json(verdict_of(r)).dump(); })
      .def_property_readonly("reached", reached)
      .def_property_readonly("stopped", [](const app::Run& r) { return r.stopped; })
      .def_property_readonly("violations", [](const app::Run& r) { return r.violations; })
      .def_property_readonly("states",
                             [](const SharedRun& r) {
                               std::vector<std::shared_ptr<RunState>> out;
                               for (std::size_t k = 0; k < r->states.size(); ++k)
                                 out.push_back(std::make_shared<RunState>(r, k));
                               return out;
                             })
      .def_property_readonly("path", path_of)
      .def("sensitivity", sensitivity_of)
      .def("json", [](const app::Run& r) { return result_json(r).dump(1); })
      .def("metrics", [](const app::Run& r) { return metrics_json(r).dump(); })
      .def("summary",
           [](const app::Run& r, bool verbose) {
             app::ShortForm form = app::short_form(r);
             form.details = "with verbose=True";
             return verbose ? summary(r) : app::format_short(form);
           })
      .def("design_text", [](const app::Run& r) { return content_of(app::design_export, r); })
      .def("report", [](const app::Run& r) { return content_of(app::report_export, r); })
      .def("write", write);
}

}  // namespace kinetix::python
