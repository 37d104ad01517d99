#pragma once

#include <vector>

#include "optim/doe/analysis.hpp"

namespace kinetix::optim {

/// @throws InvalidInput for as many responses as not rows, no factors, or a factor value that is not finite
void check_table(const SampleMatrix& samples, std::span<const double> responses);

/// Rows whose response is finite, in order.
std::vector<Eigen::Index> usable_rows(std::span<const double> responses);

}  // namespace kinetix::optim
