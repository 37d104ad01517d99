#include <pybind11/stl.h>

#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/designs.hpp"
#include "python/bindings/documents.hpp"
#include "python/bindings/interruptible.hpp"
#include "python/bindings/results.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

/// A goal that was read, and its file.
struct PythonTarget {
  app::Target target;
  std::string file;  ///< empty: a dict
};

/// Hands progress on to Python. What Python raises stops the run and is raised once that has ended.
class Listener {
 public:
  Listener(py::object callable, std::stop_source stop)
      : callable_(std::move(callable)), stop_(std::move(stop)) {}

  void operator()(const std::string& stage, double done, const std::string& words) {
    const py::gil_scoped_acquire mine;
    if (raised_) return;
    try {
      callable_(stage, done >= 0 ? py::object(py::float_(done)) : py::object(py::none()), words);
    } catch (py::error_already_set& e) {
      raised_.emplace(e);
      stop_.request_stop();
    }
  }

  void throw_again() {
    if (raised_) throw py::error_already_set(*raised_);
  }

 private:
  py::object callable_;
  std::stop_source stop_;
  std::optional<py::error_already_set> raised_;
};

app::Run located_run(const RunFunction& run, const std::string& file, const app::RunOptions& options) {
  try {
    return run(options);
  } catch (const InvalidInput& e) {
    if (file.empty() || !e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file, 0, 0, e.place().key});
  }
}

void check_options(const RunChoice& choice) {
  const auto& [options, limit, progress, keeps] = choice;
  model::threads_of(options.threads);
  require("prints", options.prints, options.prints >= 0 && options.prints <= 1000000, "0 to 1000000");
  if (limit) require("time_limit_s", *limit, *limit > 0 && *limit <= 1e9, "above 0 and at most 1e9 s");
}

std::shared_ptr<app::Run> optimise(const PythonTarget& target, RunChoice choice) {
  return run_in_python([&](const app::RunOptions& options) { return run_goal(*target.target.goal, options); },
                       target.file, std::move(choice));
}

std::shared_ptr<app::Run> simulate(const PythonDesign& design, const std::string& file,
                                   const std::string& model, RunChoice choice) {
  choice.keeps_best = false;
  const std::string known = model == "rigid_body" ? "bullet" : model;  // the current and the earlier name
  const app::Model of = known == "bullet"        ? app::Model::bullet
                        : known == "equilibrium" ? app::Model::equilibrium
                                                 : app::Model::exact;
  if (known != to_string(of))
    throw InvalidInput("model `" + model + "` is not known; allowed: exact, equilibrium, rigid_body");
  const app::Design asked = design.file();
  return run_in_python([&](const app::RunOptions& options) { return run_design(asked, of, options); }, file,
                       std::move(choice));
}

RunChoice choice_of(int threads, std::uint64_t seed, bool verify, int prints, bool fidelity,
                    std::optional<double> time_limit_s, py::object progress) {
  return {{.threads = threads, .seed = seed, .verify = verify, .prints = prints, .fidelity = fidelity},
          time_limit_s,
          std::move(progress)};
}

}  // namespace

std::shared_ptr<app::Run> run_in_python(const RunFunction& function, const std::string& file,
                                        RunChoice choice) {
  check_options(choice);
  std::shared_ptr<app::Run> run;
  std::unique_ptr<Listener> listener;
  const auto work = [&](const std::stop_source& stop) {
    app::RunOptions options = choice.options;
    options.stop = stop.get_token();
    options.printable = app::answer_of_export;
    options.printable_size = app::find_printable_size;
    options.seeks_remedy = true;
    if (listener)
      options.progress = [&](const std::string& stage, double done, const std::string& words) {
        (*listener)(stage, done, words);
      };
    run = std::make_shared<app::Run>(located_run(function, file, options));
  };
  run_interruptibly(
      [&](const std::stop_source& stop) {
        if (!choice.progress.is_none()) {
          const py::gil_scoped_acquire mine;
          listener = std::make_unique<Listener>(choice.progress, stop);
        }
        work(stop);
      },
      choice.time_limit_s, choice.keeps_best);
  if (listener) listener->throw_again();
  return run;
}

void add_runs(py::module_& core) {
  core.def("read_target", [](const std::string& file) { return PythonTarget{app::read_target(file), file}; });
  core.def("parse_target", [](const std::string& text, const std::string& file) {
    return PythonTarget{
        read_dict(text, file, [](const targets::Node& root) { return app::read_target(root); }), ""};
  });
  py::class_<PythonTarget>(core, "Target")
      .def_property_readonly("name", [](const PythonTarget& t) { return t.target.goal->name; })
      .def_property_readonly("kind", [](const PythonTarget& t) { return std::string(t.target.kind->name); });
  py::class_<RunChoice>(core, "RunChoice");
  core.def("choice", choice_of);
  core.def("optimise", optimise);
  core.def("simulate", simulate);
}

}  // namespace kinetix::python
