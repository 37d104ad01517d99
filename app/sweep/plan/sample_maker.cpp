#include "app/sweep/plan/sample_maker.hpp"

#include "app/goals/read_target.hpp"

namespace kinetix::app {

SampleMaker::SampleMaker(const SweepPlan& plan)
    : plan_(plan),
      reads_document_(plan.edits_document()),
      document_(plan.document),
      design_(plan.base.design),
      target_(plan.base.target) {}

void SampleMaker::make(std::span<const double> values) {
  if (reads_document_) {
    for (const Edit& edit : plan_.edits)
      if (edit.kind == Edit::Kind::document) document_.set(edit.index, edit.value(values[edit.factor]));
    if (design_) design_ = read_design(document_.root());
    if (target_) target_ = read_target(document_.root());
  }
  for (const Edit& edit : plan_.edits)
    if (edit.kind != Edit::Kind::document) apply(edit, edit.value(values[edit.factor]), *design_);
}

}  // namespace kinetix::app
