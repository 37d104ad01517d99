#pragma once

#include "model/hinge/element.hpp"
#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {

/// Adds |gap|^2 of a mismatch times `weight`, with its derivatives by the turns of the two bodies.
void add_turning(const Mismatch& mismatch, double weight, Element& element);
/// Adds the derivatives of a point's |gap|^2 that involve the shifts of the bodies.
void add_shifts(const Mismatch& mismatch, double weight, Element& element);

}  // namespace kinetix::model
