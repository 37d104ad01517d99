#include <pybind11/stl.h>

#include "app/print/export_command.hpp"
#include "model/base/invalid_input.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/designs.hpp"
#include "python/bindings/interruptible.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

/// Checks lengths by the limits of the command line. @throws InvalidInput for lengths out of range
void check_lengths(const app::PrintRequest& request) {
  const auto check = [](const char* name, double mm, double least, double most, const char* allowed) {
    require(name, mm, mm == 0 || (mm >= least && mm <= most), allowed);
  };
  check("clearance_mm", request.clearance_mm, 0.01, 10, "0.01 to 10 mm, or 0: the process's");
  check("cell_mm", request.cell_mm, 0.1, 1e4, "0.1 to 10000 mm, or 0: the design's own");
  if (!request.bed_mm.empty() && request.bed_mm.size() != 2)
    throw InvalidInput("bed_mm must be two lengths, x and y");
  for (const double side : request.bed_mm)
    require("bed_mm", side, side >= 1 && side <= 1e5, "two lengths of 1 to 100000 mm");
}

/// @return names of the files, and print.json
py::tuple export_files(const PythonDesign& design, const std::string& folder,
                       const app::PrintRequest& request) {
  check_lengths(request);
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
      .def_readwrite("slicer", &PrintRequest::slicer)
      .def_readwrite("slice", &PrintRequest::slice);
  core.def("export_files", export_files);
}

}  // namespace kinetix::python
