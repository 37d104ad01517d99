#include "app/sweep/plan/sweep_base.hpp"

#include "app/goals/registry.hpp"

namespace kinetix::app {

SweepBase read_base(const std::string& file) {
  SweepBase base{.root = targets::read_document(file, max_design_bytes), .design = {}, .target = {}};
  if (base.root.kind() == targets::Node::Kind::map && base.root.optional("target"))
    base.target = read_target(base.root);
  else
    base.design = read_design(base.root);
  return base;
}

}  // namespace kinetix::app
