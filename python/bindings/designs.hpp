#pragma once

#include "app/files/design_file.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::python {

/// Immutable design with its closed form.
class PythonDesign {
 public:
  explicit PythonDesign(app::Design file);

  const app::Design& file() const { return file_; }
  const model::Lattice& sheet() const { return file_.structure; }
  const model::Linkage& linkage() const { return linkage_; }
  const model::ExactMotion& exact() const { return exact_; }
  /// @throws InvalidInput where the sheet has no closed form
  const model::ExactMotion& needed_exact() const;

 private:
  app::Design file_;
  model::Linkage linkage_;
  model::ExactMotion exact_;
};

}  // namespace kinetix::python
