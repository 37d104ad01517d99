#include "python/bindings/states.hpp"

#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/pose_table.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

py::ssize_t bodies(const RunState& state) { return static_cast<py::ssize_t>(state.poses().size()); }

/// Part of every pose as it lies in the state. @param from of the first body
py::array part(const py::object& self, const double* from, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides) {
  shape.insert(shape.begin(), bodies(self.cast<const RunState&>()));
  strides.insert(strides.begin(), sizeof(model::Pose));
  return view_of(from, std::move(shape), std::move(strides), self);
}

py::array table(const py::object& self) {
  auto& state = self.cast<RunState&>();
  constexpr py::ssize_t number = sizeof(double);
  return view_of(state.table().data(), {bodies(state), pose_numbers}, {pose_numbers * number, number}, self);
}

py::array positions(const py::object& self) {
  const auto& poses = self.cast<const RunState&>().poses();
  return part(self, poses.front().p.data(), {3}, {sizeof(double)});
}

/// Matrices lie column by column.
py::array rotations(const py::object& self) {
  const auto& poses = self.cast<const RunState&>().poses();
  return part(self, poses.front().R.data(), {3, 3}, {sizeof(double), 3 * sizeof(double)});
}

}  // namespace

const std::vector<double>& RunState::table() {
  if (table_.empty()) {
    table_.resize(poses().size() * pose_numbers);
    write_poses(poses(), table_.data());
  }
  return table_;
}

void add_states(py::module_& core) {
  py::class_<RunState, std::shared_ptr<RunState>>(core, "State")
      .def_property_readonly("name", [](const RunState& s) { return s.named().name; })
      .def_property_readonly("model", [](const RunState& s) { return s.named().model; })
      .def_property_readonly("theta", [](const RunState& s) { return s.named().theta; })
      .def_property_readonly("gap_max", [](const RunState& s) { return s.named().gaps.max; })
      .def_property_readonly("gap_rms", [](const RunState& s) { return s.named().gaps.rms; })
      .def_property_readonly("poses", table)
      .def_property_readonly("positions", positions)
      .def_property_readonly("rotations", rotations);
}

}  // namespace kinetix::python
