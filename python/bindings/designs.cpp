#include "python/bindings/designs.hpp"

#include <pybind11/stl.h>

#include "app/pipeline/drive_loads.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/documents.hpp"
#include "python/bindings/exact_jacobian.hpp"
#include "python/bindings/many_folds.hpp"
#include "python/bindings/pose_table.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

using HingeField = double model::HingeParameters::*;

constexpr double within = pi / 2;  // rad, of theta: beyond it bodies have turned through one another

void check_theta(const std::string& field, double theta) {
  require(field, theta, theta > -within && theta < within, "within (-pi/2, pi/2) rad");
}

/// Returns one number per hinge. @param scale factor from the unit of the model to that of the numbers
py::array hinge_numbers(const PythonDesign& design, HingeField field, double scale = 1) {
  std::vector<double> out;
  for (int h = 0; h < design.sheet().hinges(); ++h) out.push_back(design.sheet().hinge(h).*field * scale);
  return read_only(std::move(out), {design.sheet().hinges()});
}

void set_hinges(model::Lattice& sheet, HingeField field, const std::string& name,
                const std::optional<Numbers>& numbers, double scale = 1) {
  if (!numbers) return;
  if (numbers->ndim() != 1 || numbers->shape(0) != sheet.hinges())
    throw InvalidInput(name + " must be one number per hinge, " + std::to_string(sheet.hinges()) + " in all");
  for (int h = 0; h < sheet.hinges(); ++h) sheet.hinge(h).*field = numbers->data()[h] / scale;
}

PythonDesign with_hinges(const PythonDesign& design, const std::optional<Numbers>& t,
                         const std::optional<Numbers>& alpha, const std::optional<Numbers>& beta,
                         const std::optional<Numbers>& offset_mm) {
  app::Design file = design.file();
  const double edge = file.structure.size().edge_mm;
  set_hinges(file.structure, &model::HingeParameters::t, "t", t);
  set_hinges(file.structure, &model::HingeParameters::alpha, "alpha", alpha);
  set_hinges(file.structure, &model::HingeParameters::beta, "beta", beta);
  set_hinges(file.structure, &model::HingeParameters::offset, "offset_mm", offset_mm, edge);
  validate_hinges(file.structure);
  return PythonDesign(std::move(file));
}

/// Returns the design for another theta, whatever drove it.
PythonDesign with_theta(const PythonDesign& design, double theta) {
  check_theta("theta", theta);
  app::Design file = design.file();
  file.theta = theta;
  file.drive.reset();
  return PythonDesign(std::move(file));
}

/// Returns rows of three numbers. @param row of index k
template <class Row>
py::array rows_of_three(int count, Row row) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d v = row(k);
    out.insert(out.end(), v.data(), v.data() + 3);
  }
  return read_only(std::move(out), {count, 3});
}

py::array rest_positions(const PythonDesign& design) {
  return rows_of_three(design.sheet().bodies(), [&](int b) { return design.sheet().rest_position(b); });
}

py::array hinge_points(const PythonDesign& design) {
  const double edge = design.sheet().size().edge_mm;
  return rows_of_three(design.sheet().hinges(), [&](int h) -> Eigen::Vector3d {
    const model::RestHinge& hinge = design.linkage().hinges[h];
    return edge * (design.linkage().bodies[hinge.lower].position + hinge.lower_arm);
  });
}

py::array hinge_axes(const PythonDesign& design) {
  return rows_of_three(design.sheet().hinges(), [&](int h) { return design.linkage().hinges[h].axis; });
}

std::vector<std::array<int, 2>> hinge_bodies(const PythonDesign& design) {
  std::vector<std::array<int, 2>> out;
  for (const model::RestHinge& hinge : design.linkage().hinges) out.push_back({hinge.lower, hinge.upper});
  return out;
}

std::vector<std::string> wall_names(const PythonDesign& design) {
  std::vector<std::string> out;
  for (int h = 0; h < design.sheet().hinges(); ++h) out.push_back(wall_name(design.sheet(), h));
  return out;
}

/// Returns theta to which the design's drive takes its closed form.
double custom_theta(const PythonDesign& design) {
  return app::exact_theta_of(design.file(), design.needed_exact());
}

py::array exact_poses(const PythonDesign& design, std::optional<double> theta) {
  if (theta) check_theta("theta", *theta);
  const model::State state = design.needed_exact().at(theta ? *theta : custom_theta(design));
  std::vector<double> rows(state.size() * pose_numbers);
  write_poses(state, rows.data());
  return array_of(std::move(rows), {static_cast<py::ssize_t>(state.size()), pose_numbers});
}

/// Returns one state for each theta.
py::array fold_all(const PythonDesign& design, const Numbers& thetas, int threads) {
  if (thetas.ndim() != 1) throw InvalidInput("theta must be a list of angles");
  for (py::ssize_t k = 0; k < thetas.shape(0); ++k)
    check_theta("theta[" + std::to_string(k) + "]", thetas.data()[k]);
  const model::ExactMotion& exact = design.needed_exact();
  const py::ssize_t bodies = design.sheet().bodies();
  py::array out = unwritten({thetas.shape(0), bodies, py::ssize_t(pose_numbers)});
  auto* const rows = static_cast<double*>(out.mutable_data());
  const double* const at = thetas.data();
  many_folds_in_python(thetas.shape(0), bodies, threads, [&](std::int64_t k, model::State& state) {
    state = exact.at(at[k]);
    write_poses(state, rows + k * bodies * pose_numbers);
  });
  return out;
}

}  // namespace

PythonDesign::PythonDesign(app::Design file)
    : file_(std::move(file)), linkage_(file_.structure), exact_(exact_motion(file_.structure)) {}

const model::ExactMotion& PythonDesign::needed_exact() const {
  if (!exact_)
    throw InvalidInput(exact_.why +
                       ". Simulate with model=\"equilibrium\" or \"rigid_body\", which need no exact family");
  return exact_;
}

void add_designs(py::module_& core) {
  using py::arg;
  core.def("read_design", [](const std::string& file) { return PythonDesign(app::read_design(file)); });
  core.def("parse_design", [](const std::string& text, const std::string& file) {
    return read_dict(text, file,
                     [](const targets::Node& root) { return PythonDesign(app::read_design(root)); });
  });
  py::class_<PythonDesign, std::shared_ptr<PythonDesign>>(core, "Design")
      .def_property_readonly("name", [](const PythonDesign& d) { return d.file().name; })
      .def_property_readonly("theta", [](const PythonDesign& d) { return d.file().theta; })
      .def_property_readonly("bodies", [](const PythonDesign& d) { return d.sheet().bodies(); })
      .def_property_readonly("hinges", [](const PythonDesign& d) { return d.sheet().hinges(); })
      .def_property_readonly("cells", [](const PythonDesign& d) { return d.sheet().cells(); })
      .def_property_readonly("cell_mm", [](const PythonDesign& d) { return d.sheet().size().edge_mm; })
      .def_property_readonly("is_exact", [](const PythonDesign& d) { return static_cast<bool>(d.exact()); })
      .def_property_readonly("family", [](const PythonDesign& d) { return d.exact().name; })
      .def_property_readonly("why", [](const PythonDesign& d) { return d.exact().why; })
      .def_property_readonly(
          "t", [](const PythonDesign& d) { return hinge_numbers(d, &model::HingeParameters::t); })
      .def_property_readonly(
          "alpha", [](const PythonDesign& d) { return hinge_numbers(d, &model::HingeParameters::alpha); })
      .def_property_readonly(
          "beta", [](const PythonDesign& d) { return hinge_numbers(d, &model::HingeParameters::beta); })
      .def_property_readonly("offset_mm",
                             [](const PythonDesign& d) {
                               return hinge_numbers(d, &model::HingeParameters::offset,
                                                    d.sheet().size().edge_mm);
                             })
      .def_property_readonly("rest_positions", rest_positions)
      .def_property_readonly("hinge_points", hinge_points)
      .def_property_readonly("hinge_axes", hinge_axes)
      .def_property_readonly("hinge_bodies", hinge_bodies)
      .def_property_readonly("walls", wall_names)
      .def("with_hinges", with_hinges, arg("t"), arg("alpha"), arg("beta"), arg("offset_mm"))
      .def("with_theta", with_theta)
      .def("text", [](const PythonDesign& d) { return app::design_text(d.file()); })
      .def("poses", exact_poses)
      .def("fold", fold_all)
      .def("derivatives", [](const PythonDesign& d, std::optional<double> theta) {
        if (theta) check_theta("theta", *theta);
        return exact_jacobian(d, theta ? *theta : custom_theta(d));
      });
}

}  // namespace kinetix::python
