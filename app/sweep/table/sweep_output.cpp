#include "app/sweep/table/sweep_table.hpp"

#include <nlohmann/json.hpp>

#include "app/io/text_pattern.hpp"
#include "optim/doe/analysis.hpp"
#include "optim/doe/random.hpp"

namespace kinetix::app {
namespace {

constexpr std::size_t piece_bytes = 1 << 20;  // 1 MiB per piece: few calls to write, little memory

/// Quotes the text if CSV requires it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string header(const SweepPlan& plan, const SweepIdentity& identity) {
  std::string text;
  for (const auto& [key, value] : identity)
    if (key != "doe" && key != "base" && key != "factors" && key != "responses")
      text += "# " + key + ": " + value + "\n";
  text += "sample";
  for (const optim::Factor& factor : plan.samples.factors()) text += "," + field(factor.name);
  for (const Metric& metric : plan.responses) text += "," + field(metric.name);
  return text + ",status,reason\n";
}

}  // namespace

std::string csv_line(const SampleRow& row) {
  std::string text = std::to_string(row.sample);
  const auto add = [&](double value) {
    text += "," + (std::isfinite(value) ? targets::shortest_text(value) : "");
  };
  for (const double value : row.factors) add(value);
  for (const double value : row.responses) add(value);
  return text + "," + to_string(row.status) + "," + field(row.reason);
}

void write_csv(const std::string& folder, const SweepTable& table, const SweepPlan& plan,
               const SweepIdentity& identity) {
  write_file(folder + "/samples.csv", [&](const FileSink& sink) {
    std::string text = header(plan, identity);
    table.read([&](const SampleRow& row) {
      text += csv_line(row) + "\n";
      if (text.size() < piece_bytes) return;
      sink(text);
      text.clear();
    });
    sink(text);
  });
}

namespace {

using Json = nlohmann::ordered_json;
using Method = optim::SamplingMethod;

constexpr std::int64_t max_scatter = 2000;        // points: more would only overlap in the report
constexpr std::size_t histogram_bars = 24;        // equal parts of a response's range: the page shows no more
constexpr std::size_t max_failures = 100;         // listed one by one: more would hide their common causes
constexpr std::int64_t max_numbers = 40'000'000;  // factors and responses in memory at once: 320 MB

/// Factors that differ only in a number of their path.
struct Family {
  std::string name;  ///< their common path, with [*] for the number
  std::vector<std::size_t> factors;
};

std::vector<Family> families_of(const SweepPlan& plan) {
  std::vector<Family> families;
  const auto& factors = plan.samples.factors();
  for (std::size_t f = 0; f < factors.size(); ++f) {
    const std::string name = with_matches_replaced(factors[f].name, R"(\[\d+\])", "[*]");
    const auto known =
        std::find_if(families.begin(), families.end(), [&](const Family& x) { return x.name == name; });
    if (known == families.end())
      families.push_back({name, {f}});
    else
      known->factors.push_back(f);
  }
  for (Family& family : families)
    if (family.factors.size() == 1) family.name = factors[family.factors.front()].name;
  return families;
}

/// Table in the form that the analysis needs.
struct Numbers {
  Eigen::MatrixXd factors;
  std::vector<std::vector<double>> responses;
};

Numbers numbers_of(const SweepPlan& plan, const SweepTable& table) {
  Numbers numbers;
  numbers.factors.resize(plan.size(), static_cast<Eigen::Index>(plan.samples.factors().size()));
  numbers.responses.assign(plan.responses.size(), std::vector<double>(static_cast<std::size_t>(plan.size())));
  table.read([&](const SampleRow& row) {
    for (std::size_t f = 0; f < row.factors.size(); ++f)
      numbers.factors(row.sample, static_cast<Eigen::Index>(f)) = row.factors[f];
    for (std::size_t r = 0; r < row.responses.size(); ++r)
      numbers.responses[r][static_cast<std::size_t>(row.sample)] = row.responses[r];
  });
  return numbers;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json estimate_json(const optim::Estimate& e) { return {number(e.value), number(e.lower), number(e.upper)}; }

/// @param entry of the file that defines the factor
Json factor_json(const optim::Factor& factor, const DoeFactor& entry) {
  Json out = {{"name", factor.name}};
  if (entry.scale) out["scale"] = true;
  if (entry.add) out["add"] = true;
  if (const auto* range = std::get_if<optim::UniformRange>(&factor.distribution))
    out["range"] = {range->lower, range->upper};
  else if (const auto* normal = std::get_if<optim::NormalSpread>(&factor.distribution))
    out["normal"] = {{"mean", normal->mean}, {"sd", normal->sd}};
  else
    out["values"] = std::get<optim::ValueList>(factor.distribution).values;
  return out;
}

std::vector<double> sorted_numbers(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::sort(values.begin(), values.end());
  return values;
}

/// @param values sorted
Json spread_json(const std::vector<double>& values) {
  if (values.empty()) return {{"count", 0}};
  const auto count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / count) * (v - sum / count);
  const auto at = [&](double share) { return optim::sample_quantile(values, share); };
  return {{"count", values.size()},  {"mean", sum / count},  {"sd", number(std::sqrt(squares / (count - 1)))},
          {"least", values.front()}, {"p05", at(0.05)},      {"median", at(0.5)},
          {"p95", at(0.95)},         {"most", values.back()}};
}

/// Counts the values in equal parts of their range; the largest value belongs to the last part.
/// @param values sorted
Json histogram_json(const std::vector<double>& values) {
  std::vector<std::int64_t> bars(histogram_bars);
  const double range = values.empty() ? 0 : values.back() - values.front();
  const bool is_wide = range > 0 && std::isfinite(range);
  for (const double v : values) {
    const double part = is_wide ? (v - values.front()) / range : 0;
    ++bars[std::min(static_cast<std::size_t>(part * histogram_bars), histogram_bars - 1)];
  }
  return bars;
}

Json main_effect_json(const optim::MainEffect& effect) {
  Json levels = Json::array();
  for (const optim::EffectLevel& level : effect.levels)
    levels.push_back({{"range", {level.lower, level.upper}},
                      {"mean", number(level.mean)},
                      {"error", number(level.standard_error)},
                      {"used", level.used},
                      {"failed", level.failed}});
  return {{"levels", levels},
          {"binned", effect.binned},
          {"variance_share", number(effect.variance_share)},
          {"variance_interval", {number(effect.share_lower), number(effect.share_upper)}}};
}

optim::TableRows rows_of(Method method) {
  if (method == Method::factorial) return optim::TableRows::grid;
  return method == Method::saltelli || method == Method::morris ? optim::TableRows::related
                                                                : optim::TableRows::independent;
}

Json main_effects_json(Method method, const Numbers& numbers, const std::vector<double>& response) {
  const auto effects = method == Method::one_factor
                           ? optim::one_factor_effects(numbers.factors, response)
                           : optim::main_effects(numbers.factors, response, {.rows = rows_of(method)});
  Json out = Json::array();
  for (const optim::MainEffect& effect : effects) out.push_back(main_effect_json(effect));
  return out;
}

Json linear_json(const optim::LinearModel& model) {
  Json factors = Json::array();
  for (const optim::LinearEffect& e : model.factors)
    factors.push_back({{"correlation", number(e.correlation)},
                       {"rank_correlation", number(e.rank_correlation)},
                       {"slope", number(e.slope)},
                       {"slope_error", number(e.slope_error)},
                       {"standardised", number(e.standardised)}});
  return {{"r_squared", number(model.r_squared)},
          {"used", model.used},
          {"failed", model.failed},
          {"factors", factors}};
}

Json sobol_json(const optim::SobolIndices& indices) {
  Json out = Json::array();
  for (const optim::SobolIndex& index : indices.factors)
    out.push_back({{"first", estimate_json(index.first)}, {"total", estimate_json(index.total)}});
  return out;
}

Json morris_json(const std::vector<optim::MorrisEffect>& effects) {
  Json out = Json::array();
  for (const optim::MorrisEffect& e : effects)
    out.push_back({{"mu", estimate_json(e.mu)},
                   {"mu_star", estimate_json(e.mu_star)},
                   {"sigma", estimate_json(e.sigma)}});
  return out;
}

/// Returns the variance share of one factor with its interval: Sobol's index, or its main effect. Null if the
/// samples give no share.
Json factor_share_json(const Json& response, std::size_t factor) {
  if (response.contains("sobol")) return response["sobol"][factor]["first"];
  if (!response.contains("linear")) return nullptr;
  const Json &effect = response["main_effects"][factor], &interval = effect["variance_interval"];
  return {effect["variance_share"], interval[0], interval[1]};
}

/// Sums the separate shares of a family's factors, without an interval. Null if one of them is not known.
Json sum_of_shares_json(const Json& response, const Family& family) {
  double sum = 0;
  for (const std::size_t f : family.factors) {
    const Json share = factor_share_json(response, f);
    if (!share.is_array() || !share[0].is_number()) return nullptr;
    sum += share[0].get<double>();
  }
  return {sum, nullptr, nullptr};
}

/// Returns the variance share of a family's linear effects, with its interval.
Json linear_share_json(const Json& response, const Family& family) {
  std::vector<double> correlations;
  for (const std::size_t f : family.factors)
    if (const Json& r = response["linear"]["factors"][f]["correlation"]; r.is_number())
      correlations.push_back(r.get<double>());
  return estimate_json(optim::linear_share(correlations, response["linear"]["used"].get<std::int64_t>()));
}

/// Lists the share of the variance of each family. Null if the samples give none.
Json family_shares_json(Method method, const std::vector<Family>& families, const Json& response) {
  Json out = Json::array();
  for (const Family& family : families)
    if (family.factors.size() == 1)
      out.push_back(factor_share_json(response, family.factors.front()));
    else if (method == Method::factorial || !response.contains("linear"))
      out.push_back(sum_of_shares_json(response, family));
    else
      out.push_back(linear_share_json(response, family));
  return out;
}

/// Returns the flat sheet from above: the two vertices that each wall joins, mm. Null if the base is a target
/// or imported bodies.
Json layout_json(const SweepPlan& plan) {
  if (!plan.base.design || plan.base.has_bodies()) return nullptr;
  const model::Linkage linkage = plan.base.design->structure;
  Json walls = Json::array();
  for (const model::RestHinge& hinge : linkage.hinges) {
    const Eigen::Vector3d a = linkage.rest_position(hinge.lower), b = linkage.rest_position(hinge.upper);
    walls.push_back({a.x(), a.y(), b.x(), b.y()});
  }
  return {{"walls_mm", std::move(walls)}};
}

Json response_json(const SweepPlan& plan, const Numbers& numbers, std::size_t r) {
  const Method method = plan.samples.options().method;
  const std::vector<double>& response = numbers.responses[r];
  const optim::ConfidenceOptions confidence{.seed = plan.seed};
  const std::vector<double> sorted = sorted_numbers(response);
  Json out = {{"name", plan.responses[r].name},
              {"spread", spread_json(sorted)},
              {"histogram", histogram_json(sorted)}};
  out["main_effects"] = main_effects_json(method, numbers, response);
  if (method == Method::saltelli)
    out["sobol"] = sobol_json(sobol_indices(response, static_cast<int>(numbers.factors.cols()), confidence));
  else if (method == Method::morris)
    out["morris"] = morris_json(morris_effects(numbers.factors, response, confidence));
  else if (method != Method::one_factor)
    out["linear"] = linear_json(optim::linear_effects(numbers.factors, response));
  return out;
}

/// Returns all samples, or `max_scatter` of them chosen at random, ascending. Every k-th sample of a grid
/// would show only a few levels of the factors that vary fastest.
std::vector<std::int64_t> shown_samples(std::int64_t samples) {
  const optim::RandomOrder order(static_cast<std::uint64_t>(samples), 0);
  std::vector<std::int64_t> shown(static_cast<std::size_t>(std::min(samples, max_scatter)));
  for (std::size_t k = 0; k < shown.size(); ++k) shown[k] = static_cast<std::int64_t>(order(k));
  std::sort(shown.begin(), shown.end());
  return shown;
}

Json scatter_json(const SweepPlan& plan, const Numbers& numbers) {
  Json rows = Json::array();
  for (const std::int64_t sample : shown_samples(plan.size())) {
    Json row = Json::array();
    for (Eigen::Index f = 0; f < numbers.factors.cols(); ++f) row.push_back(numbers.factors(sample, f));
    for (const auto& response : numbers.responses)
      row.push_back(number(response[static_cast<std::size_t>(sample)]));
    rows.push_back(std::move(row));
  }
  return rows;
}

void add_counts(Json& out, const SweepTable& table) {
  Json failures = Json::array();
  std::array<std::int64_t, 4> counts{};
  table.read([&](const SampleRow& row) {
    ++counts[static_cast<std::size_t>(row.status)];
    if (row.status == SampleStatus::ok || failures.size() >= max_failures) return;
    failures.push_back({{"sample", row.sample},
                        {"status", to_string(row.status)},
                        {"factors", row.factors},
                        {"reason", row.reason}});
  });
  out["counts"] = Json::object();
  for (const auto status :
       {SampleStatus::ok, SampleStatus::missed, SampleStatus::disagrees, SampleStatus::failed})
    out["counts"][to_string(status)] = counts[static_cast<std::size_t>(status)];
  out["failures"] = std::move(failures);
}

}  // namespace

Json sweep_json(const SweepPlan& plan, const SweepIdentity& identity, const SweepTable& table) {
  Json out;
  for (const auto& [key, value] : identity)
    if (key != "factors" && key != "responses") out[key] = value;
  out["samples"] = plan.size();
  out["seed"] = plan.seed;
  out["factors"] = Json::array();
  const std::vector<optim::Factor>& factors = plan.samples.factors();
  for (std::size_t f = 0; f < factors.size(); ++f)
    out["factors"].push_back(factor_json(factors[f], plan.entry_of(f)));
  const std::vector<Family> families = families_of(plan);
  out["families"] = Json::array();
  for (const Family& family : families)
    out["families"].push_back({{"name", family.name}, {"factors", family.factors}});
  if (Json layout = layout_json(plan); !layout.is_null()) out["layout"] = std::move(layout);
  add_counts(out, table);
  out["responses"] = Json::array();
  const auto columns = static_cast<std::int64_t>(factors.size() + plan.responses.size());
  if (plan.size() * columns > max_numbers) {
    out["not_analysed"] =
        "the table is too large to be analysed in memory; samples.csv and sweep.sqlite hold it all";
    return out;
  }
  const Numbers numbers = numbers_of(plan, table);
  for (std::size_t r = 0; r < plan.responses.size(); ++r)
    out["responses"].push_back(response_json(plan, numbers, r));
  for (Json& response : out["responses"])
    response["families"] = family_shares_json(plan.samples.options().method, families, response);
  out["scatter"] = scatter_json(plan, numbers);
  return out;
}

}  // namespace kinetix::app
