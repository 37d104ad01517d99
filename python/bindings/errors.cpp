#include "model/base/invalid_input.hpp"
#include "python/bindings/bindings.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

/// A file's name may hold bytes that are no UTF-8.
py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "replace"));
}

void raise_in_python(const InvalidInput& error) {
  const Place& place = error.place();
  const py::object type = py::module_::import("kinetix.errors").attr("InvalidInput");
  const py::object raised = type(text(error.what()), text(error.reason()), text(place.file), place.line,
                                 place.column, text(place.key));
  PyErr_SetObject(type.ptr(), raised.ptr());
}

}  // namespace

void add_errors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InvalidInput& e) {
      raise_in_python(e);
    }
  });
}

}  // namespace kinetix::python
