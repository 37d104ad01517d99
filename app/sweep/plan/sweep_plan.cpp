#include "app/sweep/plan/sweep_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

#include "app/goals/registry.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

constexpr std::size_t most_columns = 1900;  // SQLite allows a table 2000

optim::Factor as_factor(const DoeFile& doe, const DoeFactor& from, const std::string& name) {
  optim::Factor factor = from.values;
  factor.name = name;
  if (factor.levels == 0)
    factor.levels = doe.method.levels.value_or(static_cast<int>(optim::Factor{}.levels));
  from.node.located([&] { factor.validate(); });
  return factor;
}

/// Factors as columns of the table, and the edits of each.
struct Columns {
  std::vector<optim::Factor> factors;
  std::vector<Edit> edits;
  std::vector<std::size_t> entries;  ///< per factor: its index in DoeFile::factors
  std::vector<targets::Node> nodes;  ///< per factor, for messages
  std::vector<double> bases;         ///< per factor: the base's value, NaN if there is none
};

/// Returns the value of a factor that leaves the base unchanged; NaN if there is none.
double neutral(const SweepBase& base, const targets::DocumentEditor& document, const DoeFactor& factor,
               const std::vector<Edit>& edits) {
  double value = std::nan("");
  for (const Edit& edit : edits) {
    const auto own = factor.add     ? std::optional(0.0)
                     : factor.scale ? std::optional(1.0)
                                    : base_value(base, document, edit);
    const double needed = own ? (*own - edit.plus) / edit.times : std::nan("");
    if (!std::isnan(value) && !(std::abs(needed - value) <= 1e-12)) return std::nan("");
    value = needed;
  }
  return value;
}

void add_column(Columns& columns, const SweepBase& base, const targets::DocumentEditor& document,
                const DoeFile& doe, const DoeFactor& factor, const std::string& name,
                std::vector<Edit> edits) {
  for (Edit& edit : edits) {
    edit.factor = static_cast<int>(columns.factors.size());
    if (!factor.add && !factor.scale) continue;
    const auto own = base_value(base, document, edit);
    if (!own)
      throw factor.node.error(
          factor.add ? "`add: true` needs a number in the base, which omits this one. Add it to the base"
                     : "`scale: true` needs a number in the base, which omits this one. Add it to the base");
    (factor.add ? edit.base : edit.unit) = *own;
  }
  columns.bases.push_back(neutral(base, document, factor, edits));
  columns.factors.push_back(as_factor(doe, factor, name));
  columns.entries.push_back(static_cast<std::size_t>(&factor - doe.factors.data()));
  columns.nodes.push_back(factor.node);
  columns.edits.insert(columns.edits.end(), edits.begin(), edits.end());
}

void add_factor(Columns& columns, const SweepBase& base, targets::DocumentEditor& document,
                const DoeFile& doe, const DoeFactor& factor) {
  std::vector<Edit> together;
  for (const FactorPath& path : factor.paths)
    factor.node.located([&] {
      for (Match& match : find_matches(base, document, path.path)) {
        for (Edit& edit : match.edits) {
          edit.times = path.times;
          edit.plus = path.plus;
        }
        if (factor.each)
          add_column(columns, base, document, doe, factor, match.path, std::move(match.edits));
        else
          together.insert(together.end(), match.edits.begin(), match.edits.end());
      }
    });
  if (!factor.each) add_column(columns, base, document, doe, factor, factor.name, std::move(together));
}

void check_names(const Columns& columns) {
  for (std::size_t k = 0; k < columns.factors.size(); ++k)
    for (const char* reserved : {"sample", "status", "reason", "row_sha256"})
      if (targets::lower_case(columns.factors[k].name) == reserved)
        throw columns.nodes[k].error("the table already has a column of this name. Give another `name`");
  for (std::size_t k = 0; k < columns.factors.size(); ++k)
    for (std::size_t n = 0; n < k; ++n)
      if (targets::lower_case(columns.factors[n].name) == targets::lower_case(columns.factors[k].name))
        throw columns.nodes[k].error("two factors have the name " +
                                     targets::in_ticks(columns.factors[k].name) +
                                     ". Give one of them another `name`");
}

/// Returns whether a factor would change a sample's cells, theta or drive.
bool moves_goal(const targets::DocumentEditor& document, const Edit& edit) {
  if (edit.kind == Edit::Kind::theta_deg) return true;
  if (edit.kind != Edit::Kind::document) return false;
  const std::string path = document.path(edit.index);
  return path.starts_with("structure.cell") || path.starts_with("drive.");
}

/// Returns whether samples have other bodies than the base.
bool changes_cells(const targets::DocumentEditor& document, const Edit& edit) {
  return edit.kind == Edit::Kind::document && document.path(edit.index).starts_with("structure.cells");
}

/// Rejects edits that would have no effect, or would be ambiguous.
void check_edits(const DoeFile& doe, const Columns& columns, const SweepBase& base,
                 const targets::DocumentEditor& document) {
  std::set<std::pair<Edit::Kind, int>> written;
  const bool cells_change = std::any_of(columns.edits.begin(), columns.edits.end(),
                                        [&](const Edit& edit) { return changes_cells(document, edit); });
  for (const Edit& edit : columns.edits) {
    const targets::Node& node = columns.nodes[edit.factor];
    if (edit.kind == Edit::Kind::theta_deg && base.design->drive)
      throw node.error(
          "the `drive` of the base sets the fold angle. Vary the drive, or remove it from the base");
    if (doe.from_base && moves_goal(document, edit))
      throw node.error(
          "cannot vary if samples start from the base's state. Vary hinges and stiffnesses, or remove "
          "`start: base`");
    const auto kind = edit.kind == Edit::Kind::t_mm ? Edit::Kind::t : edit.kind;
    if (!written.emplace(kind, edit.index).second)
      throw node.error(
          "another factor already varies this number of the base. Remove one of the two factors");
    const bool structural = edit.kind != Edit::Kind::document && edit.kind != Edit::Kind::theta_deg;
    if (structural && cells_change)
      throw node.error(
          "single hinges cannot vary together with `structure.cells`. Remove one of the two factors");
  }
}

/// Rejects responses that compare bodies one by one with the base's if `structure.cells` changes.
void check_moved(const DoeFile& doe, const Columns& columns, const targets::DocumentEditor& document,
                 const std::vector<Metric>& responses) {
  if (std::none_of(columns.edits.begin(), columns.edits.end(),
                   [&](const Edit& edit) { return changes_cells(document, edit); }))
    return;
  for (std::size_t r = 0; r < responses.size(); ++r)
    if (responses[r].needs_nominal)
      throw doe.responses[r].error(
          "compares bodies with those of the base, and their number varies with `structure.cells`. Remove "
          "the "
          "response, or that factor");
}

/// Returns the values of the factors that reproduce the base.
std::vector<double> base_of(const Columns& columns) {
  for (std::size_t k = 0; k < columns.factors.size(); ++k)
    if (std::isnan(columns.bases[k]))
      throw columns.nodes[k].error(
          "`one_at_a_time` starts from the base, which has no single value here. Add the number to the base, "
          "or "
          "give `add: true` or `scale: true`");
  return columns.bases;
}

optim::SamplePlan make_samples(const DoeFile& doe, const Columns& columns, std::uint64_t seed) {
  optim::SamplingOptions options = doe.method.options;
  options.seed = seed;
  if (options.method == optim::SamplingMethod::one_factor) options.base = base_of(columns);
  optim::SamplePlan samples =
      doe.method.node.located([&] { return optim::SamplePlan(columns.factors, options); });
  if (samples.size() > static_cast<std::uint64_t>(max_samples))
    throw doe.method.node.error(fmt::format("{:.3g} samples are too many. Give at most {}",
                                            static_cast<double>(samples.size()), max_samples));
  return samples;
}

std::vector<Metric> find_responses(const DoeFile& doe, const SweepBase& base, const Target& goal) {
  const MetricContext context{doe.model, base.target.has_value(), goal.kind, base.has_bodies()};
  std::vector<Metric> responses;
  for (const targets::Node& node : doe.responses)
    responses.push_back(node.located([&] { return find_metric(node.text("a metric"), context); }));
  return responses;
}

void check_count(const DoeFile& doe, std::size_t factors, std::size_t responses) {
  if (factors + responses > most_columns)
    throw doe.root.error(fmt::format("{} factors and {} responses are too many for a table. Give at most {}",
                                     factors, responses, most_columns));
}

void check_columns(const DoeFile& doe, const Columns& columns, const std::vector<Metric>& responses) {
  for (std::size_t r = 0; r < responses.size(); ++r)
    for (const optim::Factor& factor : columns.factors)
      if (targets::lower_case(factor.name) == targets::lower_case(responses[r].name))
        throw doe.responses[r].error("a factor has the same name. Give the factor another `name`");
}

void check_model(const DoeFile& doe, const SweepBase& base) {
  if (!base.target || doe.model == Model::bullet || doe.model == base.target->kind->model) return;
  throw doe.root.error(
      fmt::format("a search for a {} needs another model. Give `model: {}`, or `rigid_body` for the "
                  "simulation",
                  base.target->kind->name, to_string(base.target->kind->model)));
}

/// Rejects keys of the sweep that only designs allow.
void refuse_for_targets(const DoeFile& doe, const SweepBase& base) {
  if (!base.target) return;
  if (doe.goal)
    throw doe.root.optional("goal")->error(
        "only applies to designs, and the base is a target, which has a goal. Remove the key");
  if (doe.from_base)
    throw doe.root.optional("start")->error(
        "only applies to designs, and the base is a target. Remove the key");
}

/// Rejects keys of the sweep that only sheets allow.
void check_bodies(const DoeFile& doe, const SweepBase& base) {
  if (!base.has_bodies()) return;
  if (doe.goal)
    throw doe.root.optional("goal")->error(
        "only applies to sheets, and the base is a design of bodies. Remove the key");
  if (doe.from_base)
    throw doe.root.optional("start")->error(
        "only applies to sheets, and the base is a design of bodies. Remove the key");
}

/// Reads a goal that measures the distance of any state from it.
Target read_goal(const std::string& file) {
  Target goal = read_target(file);
  if (!goal.kind->measures.empty()) return goal;
  std::vector<std::string_view> kinds;
  for (const GoalKind* kind : goal_kinds())
    if (!kind->measures.empty()) kinds.push_back(kind->name);
  throw InvalidInput(
      fmt::format("the goal of a sweep has another kind. Give a target of kind {}", fmt::join(kinds, " or ")),
      {file, 0, 0, "target.kind"});
}

/// Returns the ends of a factor's values; for a normal distribution its mean.
std::vector<double> extremes(const optim::Factor& factor) {
  if (const auto* range = std::get_if<optim::UniformRange>(&factor.distribution))
    return {range->lower, range->upper};
  if (const auto* list = std::get_if<optim::ValueList>(&factor.distribution)) {
    const auto [least, most] = std::minmax_element(list->values.begin(), list->values.end());
    return {*least, *most};
  }
  return {std::get<optim::NormalSpread>(factor.distribution).mean};
}

void check_values(const SweepPlan& plan, const Columns& columns) {
  SampleMaker maker(plan);
  std::vector<double> values;
  for (const optim::Factor& factor : columns.factors) values.push_back(quantile(factor, 0.5));
  for (std::size_t k = 0; k < columns.factors.size(); ++k)
    for (const double value : extremes(columns.factors[k])) {
      const double middle = std::exchange(values[k], value);
      try {
        maker.make(values);
      } catch (const InvalidInput& e) {
        throw columns.nodes[k].error(fmt::format("{} = {:.6g}: {}{}", columns.factors[k].name, value,
                                                 e.place().key.empty() ? "" : e.place().key + ": ",
                                                 e.reason()));
      }
      values[k] = middle;
    }
}

/// Rejects a sweep if its first, middle and last sample have no closed form. Single samples without one are
/// failures.
void check_exact(const SweepPlan& plan) {
  if (!plan.base.design || plan.base.has_bodies() || plan.doe.model != Model::exact) return;
  SampleMaker maker(plan);
  std::string why;
  for (const std::int64_t sample : {std::int64_t{0}, plan.size() / 2, plan.size() - 1}) {
    try {
      maker.make(plan.samples.sample(static_cast<std::uint64_t>(sample)));
    } catch (const InvalidInput&) {
      continue;
    }
    const model::ExactMotion exact = exact_motion(maker.design().structure);
    if (exact) return;
    why = exact.why;
  }
  if (!why.empty())
    throw plan.doe.root.error(why +
                              ". Give `model: equilibrium` or `rigid_body`, which need no exact family");
}

SweepBase read_base_of(const DoeFile& doe, const targets::DocumentChanges& changes) {
  const targets::HiddenQuotes hidden(doe.base, doe.root.folder());
  return read_base(doe.base, changes);
}

Target read_goal_of(const DoeFile& doe) {
  if (!doe.goal) return {};
  const targets::HiddenQuotes hidden(*doe.goal, doe.root.folder());
  return read_goal(*doe.goal);
}

}  // namespace

bool SweepPlan::edits_document() const {
  return std::any_of(edits.begin(), edits.end(),
                     [](const Edit& edit) { return edit.kind == Edit::Kind::document; });
}

SweepPlan make_sweep_plan(const std::string& file, std::optional<std::uint64_t> seed,
                          const targets::DocumentChanges& changes) {
  DoeFile doe = read_doe(file);
  SweepBase base = read_base_of(doe, changes);
  check_model(doe, base);
  refuse_for_targets(doe, base);
  check_bodies(doe, base);
  targets::DocumentEditor document(base.root);
  Columns columns;
  for (const DoeFactor& factor : doe.factors) add_factor(columns, base, document, doe, factor);
  check_count(doe, columns.factors.size(), doe.responses.size());
  check_names(columns);
  check_edits(doe, columns, base, document);
  Target goal = read_goal_of(doe);
  std::vector<Metric> responses = find_responses(doe, base, goal);
  check_columns(doe, columns, responses);
  check_moved(doe, columns, document, responses);
  const std::uint64_t used = seed.value_or(doe.method.options.seed);
  optim::SamplePlan samples = make_samples(doe, columns, used);
  SweepPlan plan{
      std::move(doe),     std::move(base),      std::move(document), columns.edits, columns.entries,
      std::move(samples), std::move(responses), std::move(goal),     used,          changes};
  check_values(plan, columns);
  check_exact(plan);
  return plan;
}

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
