#include "app/sweep/doe_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "app/file_header.hpp"

namespace kinetix {
namespace {

constexpr int most_levels = 1'000'000;

std::string path_beside(const Node& node, const std::string& what) {
  const std::filesystem::path path = node.text(what);
  return path.is_absolute() ? path.string() : (std::filesystem::path(node.folder()) / path).string();
}

Model read_model(const Node& root) {
  const auto node = root.optional("model");
  if (!node) return Model::exact;
  return node->choice<Model>(
      {{"exact", Model::exact}, {"equilibrium", Model::equilibrium}, {"bullet", Model::bullet}});
}

bool read_start(const Node& root, Model model) {
  const auto node = root.optional("start");
  if (!node) return false;
  if (model != Model::equilibrium) throw node->error("goes with `model: equilibrium`, which follows a load");
  return node->choice<bool>({{"flat", false}, {"base", true}});
}

std::int64_t read_count(const Node& node) {
  const double count = node.number(from_to(1, static_cast<double>(most_samples), "samples"));
  if (count != std::floor(count)) throw node.error("is not a whole number of samples");
  return static_cast<std::int64_t>(count);
}

DoeMethod read_method(const Node& root) {
  using Kind = DoeMethod::Kind;
  const Node node = root.required("method", "e.g. `method: {kind: sobol, samples: 1024}`");
  DoeMethod method{.node = node};
  node.reject_unknown_keys({"kind", "samples", "levels", "seed"});
  method.kind = node.required("kind", "factorial, lhs, sobol, saltelli, monte_carlo, one_at_a_time or morris")
                    .choice<Kind>({{"factorial", Kind::factorial},
                                   {"lhs", Kind::lhs},
                                   {"sobol", Kind::sobol},
                                   {"saltelli", Kind::saltelli},
                                   {"monte_carlo", Kind::monte_carlo},
                                   {"one_at_a_time", Kind::one_at_a_time},
                                   {"morris", Kind::morris}});
  if (const auto samples = node.optional("samples")) method.samples = read_count(*samples);
  if (const auto levels = node.optional("levels")) method.levels = levels->integer(2, most_levels);
  if (const auto seed = node.optional("seed"))
    method.seed = static_cast<std::uint64_t>(seed->integer(0, std::numeric_limits<int>::max()));
  return method;
}

FactorPath read_path(const Node& node) {
  if (node.kind() != Node::Kind::map)
    return {node.located([&] { return parse_path(node.text("a path into the base file")); })};
  node.reject_unknown_keys({"path", "times", "plus"});
  FactorPath path = read_path(node.required("path", "a path into the base file"));
  if (const auto times = node.optional("times")) path.times = times->number();
  if (const auto plus = node.optional("plus")) path.plus = plus->number();
  if (path.times == 0) throw node.error("`times: 0` leaves nothing of the factor");
  return path;
}

std::vector<FactorPath> read_paths(const Node& factor) {
  const Node node = factor.required("path", "a path into the base file, e.g. `path: design.theta_deg`");
  if (node.kind() != Node::Kind::list) return {read_path(node)};
  std::vector<FactorPath> paths;
  for (const Node& entry : node.list("paths into the base file")) paths.push_back(read_path(entry));
  if (paths.empty()) throw node.error("is empty; give at least one path");
  return paths;
}

std::vector<double> read_list(const Node& node) {
  std::vector<double> values;
  for (const Node& entry : node.list("a list of numbers")) values.push_back(entry.number());
  if (values.empty()) throw node.error("is empty; give at least one number");
  return values;
}

FactorValues read_values(const Node& factor) {
  FactorValues values;
  const auto range = factor.optional("range"), normal = factor.optional("normal"),
             list = factor.optional("values");
  if (range.has_value() + normal.has_value() + list.has_value() != 1)
    throw factor.error(
        "needs exactly one of `range: [lower, upper]`, `normal: {mean: m, sd: s}` and `values: [...]`");
  if (const auto levels = factor.optional("levels")) {
    if (list) throw levels->error("a list of values has as many levels as values; leave this out");
    values.levels = levels->integer(2, most_levels);
  }
  if (range) {
    const auto [lower, upper] = range->range({});
    values.lower = lower;
    values.upper = upper;
  } else if (normal) {
    values.kind = FactorValues::Kind::normal;
    normal->reject_unknown_keys({"mean", "sd"});
    values.mean = normal->required("mean", "the mean of the normal distribution").number();
    values.sd = normal->required("sd", "the standard deviation, above 0").number(above(0));
  } else {
    values.kind = FactorValues::Kind::list;
    values.list = read_list(*list);
  }
  return values;
}

DoeFactor read_factor(const Node& node) {
  node.reject_unknown_keys({"path", "name", "range", "levels", "normal", "values", "each", "add"});
  DoeFactor factor{.name = {}, .paths = read_paths(node), .values = read_values(node), .node = node};
  factor.name = to_string(factor.paths[0].path);
  if (const auto name = node.optional("name")) factor.name = name->text("a heading for the factor's column");
  if (const auto each = node.optional("each")) factor.each = each->boolean();
  if (const auto add = node.optional("add")) factor.add = add->boolean();
  if (factor.each && factor.paths.size() > 1)
    throw node.error("`each: true` goes with one path, not with several that vary together");
  return factor;
}

std::vector<DoeFactor> read_factors(const Node& root) {
  const Node node = root.required("factors", "e.g. `- {path: design.theta_deg, range: [5, 40], levels: 8}`");
  std::vector<DoeFactor> factors;
  for (const Node& entry : node.list("a list of factors")) factors.push_back(read_factor(entry));
  if (factors.empty()) throw node.error("is empty; a sweep needs at least one factor");
  return factors;
}

std::vector<Node> read_responses(const Node& root) {
  const Node node = root.required("responses", "the metrics to record, e.g. `responses: [area_ratio]`");
  std::vector<Node> responses = node.list("a list of metrics");
  if (responses.empty()) throw node.error("is empty; a sweep needs at least one response");
  std::vector<std::string> names;
  for (const Node& entry : responses) {
    names.push_back(entry.text("the name of a metric"));
    if (std::count(names.begin(), names.end(), names.back()) > 1) throw entry.error("is given twice");
  }
  return responses;
}

void check_kind_of_file(const Node& root) {
  if (root.kind() == Node::Kind::map && !root.optional("factors")) {
    if (root.optional("design")) throw root.error("this is a design, not a design of experiments");
    if (root.optional("target")) throw root.error("this is a target, not a design of experiments");
  }
  root.reject_unknown_keys(
      {"kinetix", "name", "base", "goal", "model", "start", "method", "factors", "responses"});
}

}  // namespace

DoeFile read_doe(const std::string& file) {
  const Node root = read_document(file);
  check_kind_of_file(root);
  check_version(root);
  constexpr const char* a_base = "the path of a design.yaml or a target.yaml";
  DoeFile doe{.name = read_name(root),
              .base = path_beside(root.required("base", a_base), a_base),
              .goal = {},
              .model = read_model(root),
              .method = read_method(root),
              .factors = read_factors(root),
              .responses = read_responses(root),
              .root = root};
  doe.from_base = read_start(root, doe.model);
  if (const auto goal = root.optional("goal")) doe.goal = path_beside(*goal, "the path of a curve target");
  return doe;
}

}  // namespace kinetix
