#include <pybind11/stl.h>

#include "app/print/export_command.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/designs.hpp"
#include "python/bindings/interruptible.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

/// @return names of the files, and print.json
py::tuple export_files(const Design& design, const std::string& folder, const app::PrintRequest& request) {
  app::Exported out;
  run_interruptibly(
      [&](const std::stop_source&) { out = app::export_design(design.file(), request, folder); }, {}, false);
  return py::make_tuple(out.files, out.json);
}

}  // namespace

void add_exports(py::module_& core) {
  using app::PrintRequest;
  py::class_<PrintRequest>(core, "PrintRequest")
      .def(py::init<>())
      .def_readwrite("formats", &PrintRequest::formats)
      .def_readwrite("process", &PrintRequest::process)
      .def_readwrite("hinge", &PrintRequest::hinge)
      .def_readwrite("clearance_mm", &PrintRequest::clearance_mm)
      .def_readwrite("cell_mm", &PrintRequest::cell_mm)
      .def_readwrite("bed_mm", &PrintRequest::bed_mm)
      .def_readwrite("loose_rods", &PrintRequest::loose_rods)
      .def_readwrite("caps", &PrintRequest::caps)
      .def_readwrite("folded", &PrintRequest::folded)
      .def_readwrite("orient", &PrintRequest::orient)
      .def_readwrite("slice", &PrintRequest::slice);
  core.def("export_files", export_files);
}

}  // namespace kinetix::python
