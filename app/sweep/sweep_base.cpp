#include "app/sweep/sweep_base.hpp"

namespace kinetix {

SweepBase read_base(const std::string& file) {
  SweepBase base{.root = read_document(file, max_design_bytes), .design = {}, .target = {}};
  if (base.root.kind() == Node::Kind::map && base.root.optional("target"))
    base.target = read_target(base.root);
  else
    base.design = read_design(base.root);
  return base;
}

}  // namespace kinetix
