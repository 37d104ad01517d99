#pragma once

#include <vector>

#include "optim/doe/analysis.hpp"

namespace kinetix::optim {

/// @throws InvalidInput if responses and rows differ in number, without factors, and for a value that is not
/// finite
void check_table(const SampleMatrix& samples, std::span<const double> responses);

/// Returns the rows whose response is finite, in order.
std::vector<Eigen::Index> usable_rows(std::span<const double> responses);

}  // namespace kinetix::optim
