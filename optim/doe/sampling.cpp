#include "optim/doe/sampling.hpp"

#include <fmt/format.h>

#include <limits>
#include <set>

#include "model/base/invalid_input.hpp"
#include "optim/doe/samplers.hpp"

namespace kinetix::optim {
namespace {

// Limit of the samples: the range of RandomOrder. Indices of rows are then well within 64 bits.
constexpr std::uint64_t most_samples = std::uint64_t{1} << 62;

void check(const std::vector<Factor>& factors, const SamplingOptions& options) {
  if (factors.empty()) throw InvalidInput("no factors, must be one or more");
  std::set<std::string> names;
  for (const Factor& factor : factors) {
    factor.validate();
    if (!names.insert(factor.name).second)
      throw InvalidInput(fmt::format("two factors are called {}, names must differ", factor.name));
  }
  if (options.samples < 1 || options.samples > most_samples)
    throw InvalidInput(fmt::format("samples is {}, must be 1 to 2^62", options.samples));
}

std::unique_ptr<const Sampler> make_sampler(SharedFactors factors, const SamplingOptions& options) {
  switch (options.method) {
    case SamplingMethod::lhs:
    case SamplingMethod::sobol:
    case SamplingMethod::monte_carlo:
    case SamplingMethod::saltelli:
      return make_unit_sampler(std::move(factors), options);
    case SamplingMethod::factorial:
    case SamplingMethod::one_factor:
    case SamplingMethod::morris:
      return make_level_sampler(std::move(factors), options);
  }
  throw InvalidInput("unknown sampling method");
}

}  // namespace

std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > largest / b ? largest : a * b;
}

SamplePlan::SamplePlan(std::vector<Factor> factors, SamplingOptions options) : options_(std::move(options)) {
  check(factors, options_);
  factors_ = std::make_shared<const std::vector<Factor>>(std::move(factors));
  sampler_ = make_sampler(factors_, options_);
}

std::uint64_t SamplePlan::size() const { return sampler_->size(); }

void SamplePlan::sample(std::uint64_t i, std::span<double> values) const {
  if (i >= size()) throw InvalidInput(fmt::format("row {} is past the end, must be below {}", i, size()));
  if (values.size() != factors().size())
    throw InvalidInput(
        fmt::format("{} values for {} factors, must be as many", values.size(), factors().size()));
  sampler_->sample(i, values);
}

std::vector<double> SamplePlan::sample(std::uint64_t i) const {
  std::vector<double> values(factors().size());
  sample(i, values);
  return values;
}

}  // namespace kinetix::optim
