#include "optim/doe/sampling.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <set>

#include "model/base/invalid_input.hpp"
#include "optim/doe/samplers.hpp"

namespace kinetix::optim {
namespace {

constexpr std::int64_t max_levels = 1'000'000'000;  // levels of one factor: more is a mistyped number
constexpr double min_probability = 1e-300;          // of the whole: near 1e-308, doubles lose their digits
const double root_2 = std::sqrt(2.0);               // standard deviations to a unit of erfc's argument

/// Promotion to long double would make the bits depend on the machine.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

double standard_probability(double z) { return 0.5 * boost::math::erfc(-z / root_2, InDouble()); }
double standard_quantile(double p) { return -root_2 * boost::math::erfc_inv(2 * p, InDouble()); }

/// Cut [a, b] in standard deviations. It is mirrored so that the longer tail is below, where probabilities
/// keep their digits.
struct StandardCut {
  double a, b;
  bool mirrored;
  double below, inside;
};

StandardCut standard_cut(const NormalSpread& normal) {
  const double a = (normal.lower - normal.mean) / normal.sd, b = (normal.upper - normal.mean) / normal.sd;
  const bool mirrored = a + b > 0;
  StandardCut cut{mirrored ? -b : a, mirrored ? -a : b, mirrored, 0, 0};
  cut.below = standard_probability(cut.a);
  cut.inside = standard_probability(cut.b) - cut.below;
  return cut;
}

double normal_quantile(const NormalSpread& normal, double u) {
  const StandardCut cut = standard_cut(normal);
  const double z = standard_quantile(cut.below + (cut.mirrored ? 1 - u : u) * cut.inside);
  return std::clamp(normal.mean + normal.sd * (cut.mirrored ? -z : z), normal.lower, normal.upper);
}

double list_quantile(const ValueList& list, double u) {
  const std::size_t n = list.values.size();
  return list.values[std::min(n - 1, static_cast<std::size_t>(u * static_cast<double>(n)))];
}

void check(const UniformRange& range, const std::string& name) {
  if (std::isfinite(range.lower) && std::isfinite(range.upper - range.lower) && range.lower < range.upper)
    return;
  throw InvalidInput(
      fmt::format("factor {}: range is [{}, {}], must be [lower, upper] with lower < upper, finite", name,
                  range.lower, range.upper));
}

void check(const NormalSpread& normal, const std::string& name) {
  if (!std::isfinite(normal.mean))
    throw InvalidInput(fmt::format("factor {}: mean is {}, must be finite", name, normal.mean));
  if (!(normal.sd > 0 && std::isfinite(normal.sd)))
    throw InvalidInput(fmt::format("factor {}: sd is {}, must be above 0 and finite", name, normal.sd));
  if (!(normal.lower < normal.upper))
    throw InvalidInput(fmt::format("factor {}: normal distribution cut to [{}, {}], must be lower < upper",
                                   name, normal.lower, normal.upper));
  if (!(standard_cut(normal).inside >= min_probability))
    throw InvalidInput(
        fmt::format("factor {}: normal distribution of mean {} and sd {} has nothing in [{}, {}]", name,
                    normal.mean, normal.sd, normal.lower, normal.upper));
}

void check(const ValueList& list, const std::string& name) {
  if (list.values.empty()) throw InvalidInput(fmt::format("factor {}: no values, must be one or more", name));
  std::vector<double> sorted = list.values;
  for (const double value : sorted)
    if (!std::isfinite(value))
      throw InvalidInput(fmt::format("factor {}: value {}, must be finite", name, value));
  std::sort(sorted.begin(), sorted.end());
  const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
  if (twin != sorted.end())
    throw InvalidInput(fmt::format("factor {}: value {} is listed twice, must be there once", name, *twin));
}

}  // namespace

void Factor::validate() const {
  if (name.empty()) throw InvalidInput("a factor has no name");
  std::visit([&](const auto& kind) { check(kind, name); }, distribution);
  if (!(levels >= 2 && levels <= max_levels))
    throw InvalidInput(fmt::format("factor {}: levels is {}, must be 2 to {}", name, levels, max_levels));
}

double quantile(const Factor& factor, double u) {
  return std::visit(Cases{[&](const UniformRange& range) { return std::lerp(range.lower, range.upper, u); },
                          [&](const NormalSpread& normal) { return normal_quantile(normal, u); },
                          [&](const ValueList& list) { return list_quantile(list, u); }},
                    factor.distribution);
}

std::int64_t level_count(const Factor& factor) {
  const auto* list = std::get_if<ValueList>(&factor.distribution);
  return list ? static_cast<std::int64_t>(list->values.size()) : factor.levels;
}

double level_value(const Factor& factor, std::int64_t k) {
  const double place = static_cast<double>(k), count = static_cast<double>(factor.levels);
  return std::visit(
      Cases{
          [&](const UniformRange& range) { return std::lerp(range.lower, range.upper, place / (count - 1)); },
          [&](const NormalSpread& normal) { return normal_quantile(normal, (place + 0.5) / count); },
          [&](const ValueList& list) { return list.values[k]; }},
      factor.distribution);
}

double even_level_value(const Factor& factor, std::int64_t k) {
  if (!std::holds_alternative<NormalSpread>(factor.distribution)) return level_value(factor, k);
  const std::int64_t last = factor.levels - 1;
  return std::lerp(level_value(factor, 0), level_value(factor, last),
                   static_cast<double>(k) / static_cast<double>(last));
}

namespace {

// Limit of the samples: the range of RandomOrder. Indices of rows are then well within 64 bits.
constexpr std::uint64_t max_samples = std::uint64_t{1} << 62;

void check(const std::vector<Factor>& factors, const SamplingOptions& options) {
  if (factors.empty()) throw InvalidInput("no factors, must be one or more");
  std::set<std::string> names;
  for (const Factor& factor : factors) {
    factor.validate();
    if (!names.insert(factor.name).second)
      throw InvalidInput(fmt::format("two factors are called {}, names must differ", factor.name));
  }
  if (options.samples < 1 || options.samples > max_samples)
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
