#include "optim/doe/sample_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {

void check_table(const SampleMatrix& samples, std::span<const double> responses) {
  if (samples.cols() == 0) throw InvalidInput("the table has no factors, must have one or more");
  if (samples.rows() != static_cast<Eigen::Index>(responses.size()))
    throw InvalidInput(
        fmt::format("{} responses for {} samples, must be one for each", responses.size(), samples.rows()));
  for (Eigen::Index j = 0; j < samples.cols(); ++j)
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
      if (!std::isfinite(samples(i, j)))
        throw InvalidInput(fmt::format("factor {} of sample {} is {}, must be finite", j, i, samples(i, j)));
}

std::vector<Eigen::Index> usable_rows(std::span<const double> responses) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < responses.size(); ++i)
    if (std::isfinite(responses[i])) rows.push_back(static_cast<Eigen::Index>(i));
  return rows;
}

}  // namespace kinetix::optim
